"""Dimensionless groups of a rough scene, from which the ratio of 1D over 3D is predicted."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import erf, log, pi, sqrt
from typing import Protocol

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import Scene, SelfAffine
from scene.scales import elastic_contact

from ..models.exact.full_contact import complex_stiffness
from ..models.law import bands as surface

# Solvers of the smooth body, which answer in a few hundredths of a second.
LINE, SPACE = MDR(points=2000), BEM(points=64)
# Loss over the relaxed modulus below which a flow is as slow as at rest, and stiffening that is as good as none.
LEAST_LOSS, MOST_STIFFENING = 1e-3, 1e5


class Answer(Protocol):
    """Answer to a smooth scene, as far as groups need it: a Result, or a row of an outcome."""

    @property
    def normal_force(self) -> float: ...

    @property
    def depth(self) -> float: ...

    @property
    def friction_coefficient(self) -> float: ...

    @property
    def measures(self) -> Mapping[str, float]: ...


@dataclass(frozen=True)
class SmoothReference:
    """The body without its roughness, in both dimensionalities.

    friction, depth, force : 1D over 3D; friction is 1 at rest
    line_friction_coefficient, friction_coefficient : in 1D and in 3D
    radius, sunk, load : radius, depth and load of the contact in 3D, over those at rest
    line_radius : half the length of the contact in 1D, over the radius at rest
    """

    friction: float
    depth: float
    force: float
    line_friction_coefficient: float
    friction_coefficient: float
    radius: float
    sunk: float
    load: float
    line_radius: float

    @classmethod
    def of(cls, scene: Scene, line: Answer | None = None, space: Answer | None = None) -> "SmoothReference":
        """Smooth body of a scene; line, space : its answers, solved here if absent. Raises SolveError."""
        smooth = replace(scene, roughness=None)
        line = LINE.solve(smooth) if line is None else line
        space = SPACE.solve(smooth) if space is None else space
        rest, moved = elastic_contact(smooth), space.friction_coefficient
        return cls(
            friction=line.friction_coefficient / moved if moved else 1.0,
            depth=line.depth / space.depth,
            force=line.normal_force / space.normal_force,
            line_friction_coefficient=line.friction_coefficient,
            friction_coefficient=moved,
            radius=sqrt(space.measures["contact_area"] / pi) / rest.radius,
            sunk=space.depth / rest.depth,
            load=space.normal_force / rest.load,
            line_radius=line.measures["contact_length"] / 2 / rest.radius,
        )


@dataclass(frozen=True)
class FullContact:
    """Friction and rms pressure of the roughness over the load, if all of the smooth contact touched.

    Each wave for itself: on the line friction sum_q |q| |h_q|^2 Im E*(q v) a length and mean square force
    sum_q |E*(q v)|^2 |h_q|^2, on the surface sum_q (|q| |q_x| / 2) |h_q|^2 Im E*(q_x v) an area and mean square
    pressure sum_q (q / 2)^2 |E*(q_x v)|^2 |h_q|^2.
    """

    line_friction: float
    line_pressure: float
    friction: float
    pressure: float

    @classmethod
    def of(cls, scene: Scene, smooth: SmoothReference) -> "FullContact":
        """Full contact of a rough scene."""
        speed, rest = scene.motion.speed, elastic_contact(scene)
        bands = surface.Bands.of(_roughness(scene))
        along = complex_stiffness(scene.solid, speed * bands.q)
        around = surface.FullContact.of(bands, scene.solid, speed)
        load = rest.load * smooth.load
        line_load = load * smooth.force / (2 * smooth.line_radius * rest.radius)
        pressure = load / (pi * (smooth.radius * rest.radius) ** 2)
        return cls(
            line_friction=float(bands.unit**2 * np.sum(bands.power * bands.q * along.imag) / line_load),
            line_pressure=bands.unit * sqrt(np.sum(bands.power * abs(along) ** 2)) / line_load,
            friction=float(around.friction.sum() / pressure),
            pressure=float(around.pressure[-1] / pressure),
        )


@dataclass(frozen=True)
class DimensionlessGroups:
    """Dimensionless groups of a rough scene; logarithms except for shape, prescribed, hurst and shares.

    a, d, p : radius, depth and mean pressure of the smooth contact at rest
    q_s, h0, h' : highest wave number, rms height and rms slope of the roughness
    smooth, sliding : of the smooth body, in both dimensionalities and in 3D
    """

    shape: float  # 1/n of the body r^n
    prescribed: float  # 0 load, 1 depth
    height: float  # h0 / d
    waves: float  # a / lambda_s
    hurst: float
    period: float  # longest wave / a
    rolloff: float  # roll-off / lambda_s
    pressure: float  # p / (E* h')
    slope: float  # slope of the body at a, over h'
    stored_waves: float  # G'(v q_s) / G_0
    lost_waves: float  # G''(v q_s) / G_0; of Kelvin v tau q_s
    stored_contact: float  # G'(v / a) / G_0
    lost_contact: float  # G''(v / a) / G_0; of Kelvin v tau / a
    stiffening: float  # E_g / E_r
    smooth_friction: float  # friction 1D over 3D
    smooth_depth: float  # depth 1D over 3D
    smooth_force: float  # force 1D over 3D
    sliding_radius: float  # radius of the contact / a
    sliding_height: float  # h0 / depth
    sliding_waves: float  # radius of the contact / lambda_s
    sliding_pressure: float  # p / rms pressure of the waves in full contact
    line_pressure: float  # the same on the line
    full_friction: float  # friction 1D over 3D, if all of the smooth contact touched
    full_share: float  # of the roughness in that friction in 3D
    friction: float  # friction 1D over 3D, if as much of it touched as Persson's area does
    share: float  # of the roughness in that friction in 3D

    @classmethod
    def of(cls, scene: Scene, smooth: SmoothReference) -> "DimensionlessGroups":
        """Groups of a rough scene."""
        rough, rest, solid = _roughness(scene), elastic_contact(scene), scene.solid
        speed, a, n = scene.motion.speed, rest.radius, scene.indenter.exponent
        q_s = rough.q_max(0.0)
        slope = rough.rms_slope(q_s)
        modulus = complex_stiffness(solid, speed * np.array([q_s, 1 / a])) / solid.indentation_modulus
        (stored_waves, stored_contact), (lost_waves, lost_contact) = (
            np.log(np.maximum(part, LEAST_LOSS)).tolist() for part in (modulus.real, modulus.imag)
        )
        full = FullContact.of(scene, smooth)
        smooth_line, smooth_space = smooth.line_friction_coefficient, smooth.friction_coefficient
        line, space = smooth_line + full.line_friction, smooth_space + full.friction
        # A / A_0 = erf(p / (sqrt(2) rms pressure)); Persson, J. Chem. Phys. 115, 3840 (2001).
        line_touching = full.line_friction * erf(1 / (sqrt(2) * full.line_pressure))
        touching = full.friction * erf(1 / (sqrt(2) * full.pressure))
        return cls(
            shape=1 / n,
            prescribed=float(scene.motion.pressed_by == "depth"),
            height=log(rough.rms_height / rest.depth),
            waves=log(a * q_s / (2 * pi)),
            hurst=rough.hurst,
            period=log(rough.longest / a),
            rolloff=log(q_s / rough.q_rolloff),
            pressure=log(rest.load / (pi * a**2) / solid.indentation_modulus / slope),
            slope=log(n * rest.depth / a / slope),
            stored_waves=stored_waves,
            lost_waves=lost_waves,
            stored_contact=stored_contact,
            lost_contact=lost_contact,
            stiffening=log(min(solid.glassy_modulus / solid.static_modulus, MOST_STIFFENING)),
            smooth_friction=log(smooth.friction),
            smooth_depth=log(smooth.depth),
            smooth_force=log(smooth.force),
            sliding_radius=log(smooth.radius),
            sliding_height=log(rough.rms_height / (smooth.sunk * rest.depth)),
            sliding_waves=log(smooth.radius * a * q_s / (2 * pi)),
            sliding_pressure=-log(full.pressure),
            line_pressure=-log(full.line_pressure),
            full_friction=log(line / space) if space else 0.0,
            full_share=full.friction / space if space else 0.0,
            friction=log((smooth_line + line_touching) / (smooth_space + touching)) if space else 0.0,
            share=touching / (smooth_space + touching) if space else 0.0,
        )


def _roughness(scene: Scene) -> SelfAffine:
    """Roughness that has groups. Raises TypeError for a scene without."""
    if not isinstance(scene.roughness, SelfAffine):
        raise TypeError(f"roughness = {scene.roughness!r} has no groups, SelfAffine has")
    return scene.roughness
