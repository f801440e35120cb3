"""Dimensionless groups of a rough scene, from which the ratio of 1D over 3D is predicted."""

from dataclasses import dataclass, replace
from math import erf, hypot, inf, log, pi, sqrt
from typing import Any

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import Scene, Topography
from scene.scales import elastic_contact
from scene.surfaces.isotropic import Isotropic

from ..models.exact.full_contact import complex_stiffness
from ..models.law import bands as surface
from ..models.law.parts import LawParts
from ..models.law.smooth import SmoothContact

# Solvers of the smooth body, which answer in a few hundredths of a second.
LINE, SPACE = MDR(points=2000), BEM(points=64)
# Loss over the relaxed modulus below which a flow is as slow as at rest, and stiffening that is as good as none.
LEAST_LOSS, MOST_STIFFENING = 1e-3, 1e5
FLAT = 100.0  # pressure over the pressure in full contact, beyond which nothing changes
# Contributions of these numbers to the expected misfit of the law, which is the root of their sum of squares. The
# misfit is the unit in which the map learns ratios of friction, no interval: that follows from scenes left out.
AT_LEAST, BY_ROUGHNESS, BY_LIGHTNESS, BY_HEIGHT, BY_RIDDEN = 0.0088, 0.104, 0.154, 1.06, 2.0
MOST_MISFIT = 7.0  # a factor of a thousand: a larger one says no more


@dataclass(frozen=True)
class SmoothReference:
    """The body without its roughness, in both dimensionalities.

    friction, depth, force : 1D over 3D; friction is 1 at rest
    line_friction_coefficient, friction_coefficient : in 1D and in 3D
    radius, sunk, load : radius, depth and load of the contact in 3D, over those at rest
    line_radius : half the length of the contact in 1D, over the radius at rest
    contact : in 3D
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
    contact: SmoothContact

    @classmethod
    def of(cls, scene: Scene, line: Any = None, space: Any = None) -> "SmoothReference":
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
            contact=SmoothContact.of_answer(space),
        )


@dataclass(frozen=True)
class Waves:
    """Waves of any roughness: its spectrum and its heights.

    bands : its waves
    slope : rms of the full gradient [1]
    steep, curved : wave numbers [rad/m], rms slope over rms height, and rms curvature over rms slope
    side : of a map [m], inf of a spectrum that is drawn again and again
    directed : rms slope along the direction in which it is greatest, over that across, of a map; 1 of a spectrum
    skewness, tails : of the heights above the elastomer of a map: third moment, and log of the fourth over 3
    """

    bands: surface.Bands
    slope: float
    steep: float
    curved: float
    side: float = inf
    directed: float = 1.0
    skewness: float = 0.0
    tails: float = 0.0

    @classmethod
    def of(cls, rough: Isotropic | Topography) -> "Waves":
        """Waves of a roughness that is not flat."""
        bands = surface.Bands.of(rough)
        square = np.square(bands.q)
        heights, slopes, curvatures = (float(np.sum(bands.power * square**k)) for k in range(3))
        found = cls(bands, bands.unit * sqrt(slopes), sqrt(slopes / heights), sqrt(curvatures / slopes))
        if isinstance(rough, Isotropic):
            return found
        z = rough.relief / rough.relief.std()
        z = z - z.mean()
        return replace(
            found,
            side=sqrt(rough.size[0] * rough.size[1]),
            directed=surface.directed(rough),
            skewness=float(np.mean(z**3)),
            tails=log(float(np.mean(z**4)) / 3),
        )


@dataclass(frozen=True)
class FullContact:
    """Friction and rms pressure of the roughness over the load, if all of the smooth contact touched.

    Each wave for itself: on the line friction sum_q |q| |h_q|^2 Im E*(q v) a length and mean square force
    sum_q |E*(q v)|^2 |h_q|^2, on the surface those of `surface.FullContact`.
    """

    line_friction: float
    line_pressure: float
    friction: float
    pressure: float

    @classmethod
    def of(cls, scene: Scene, smooth: SmoothReference, bands: surface.Bands) -> "FullContact":
        """Full contact of a rough scene."""
        speed, rest = scene.motion.speed, elastic_contact(scene)
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
    """Dimensionless groups of a rough scene; logarithms except for shape, prescribed, shares and moments.

    a, d, p : radius, depth and mean pressure of the smooth contact at rest
    h0, h', h'' : rms height, slope and curvature of the roughness
    q_c : h'' / h', the wave number of its short waves
    smooth, sliding : of the smooth body, in both dimensionalities and in 3D
    """

    shape: float  # 1/n of the body r^n
    prescribed: float  # 0 load, 1 depth
    height: float  # h0 / d
    waves: float  # a q_c / (2 pi)
    breadth: float  # h0 h'' / h'^2
    pressure: float  # p / (E* h')
    slope: float  # slope of the body at a, over h'
    stored_waves: float  # G'(v q_c) / G_0
    lost_waves: float  # G''(v q_c) / G_0
    stored_contact: float  # G'(v / a) / G_0
    lost_contact: float  # G''(v / a) / G_0; of Kelvin v tau / a
    stiffening: float  # E_g / E_r
    smooth_friction: float  # friction 1D over 3D
    smooth_depth: float  # depth 1D over 3D
    smooth_force: float  # force 1D over 3D
    sliding_radius: float  # radius of the contact / a
    sliding_height: float  # h0 / depth
    sliding_waves: float  # radius of the contact q_c / (2 pi)
    sliding_pressure: float  # p / rms pressure of the waves in full contact
    line_pressure: float  # the same on the line
    full_friction: float  # friction 1D over 3D, if all of the smooth contact touched
    full_share: float  # of the roughness in that friction in 3D
    riding: float  # share of the mean square height on which the sliding contact rides as a whole
    nominal: float  # p / rms pressure of the waves it does not ride on, of the law
    friction: float  # friction 1D over 3D, in 1D as much of it touching as Persson's area does, in 3D by the law
    share: float  # of the roughness in friction by the law
    side: float  # radius of the sliding contact / side of a map, 0 of a spectrum
    directed: float  # rms slopes of a map along and across
    skewness: float  # of its heights
    tails: float  # of its heights
    gaussian: float  # 1 of a spectrum whose surfaces differ in height
    doubt: float  # expected misfit of ln mu of the law, the unit in which ratios of friction are learned

    @classmethod
    def of(cls, scene: Scene, smooth: SmoothReference, law: LawParts) -> "DimensionlessGroups":
        """Groups of a rough scene, from its smooth body and the parts of its law of friction."""
        rest, solid, waves = elastic_contact(scene), scene.solid, Waves.of(_roughness(scene))
        speed, a, n = scene.motion.speed, rest.radius, scene.indenter.exponent
        modulus = complex_stiffness(solid, speed * np.array([waves.curved, 1 / a])) / solid.indentation_modulus
        (stored_waves, stored_contact), (lost_waves, lost_contact) = (
            np.log(np.maximum(part, LEAST_LOSS)).tolist() for part in (modulus.real, modulus.imag)
        )
        full = FullContact.of(scene, smooth, waves.bands)
        smooth_line, smooth_space = smooth.line_friction_coefficient, smooth.friction_coefficient
        line, space = smooth_line + full.line_friction, smooth_space + full.friction
        # A / A_0 = erf(p / (sqrt(2) rms pressure)); Persson, J. Chem. Phys. 115, 3840 (2001).
        line_touching = full.line_friction * erf(1 / (sqrt(2) * full.line_pressure))
        by_law, height = law.friction_coefficient, waves.bands.rms_height
        return cls(
            shape=1 / n,
            prescribed=float(scene.motion.pressed_by == "depth"),
            height=log(height / rest.depth),
            waves=log(a * waves.curved / (2 * pi)),
            breadth=log(waves.curved / waves.steep),
            pressure=log(rest.load / (pi * a**2) / solid.indentation_modulus / waves.slope),
            slope=log(n * rest.depth / a / waves.slope),
            stored_waves=stored_waves,
            lost_waves=lost_waves,
            stored_contact=stored_contact,
            lost_contact=lost_contact,
            stiffening=log(min(solid.glassy_modulus / solid.static_modulus, MOST_STIFFENING)),
            smooth_friction=log(smooth.friction),
            smooth_depth=log(smooth.depth),
            smooth_force=log(smooth.force),
            sliding_radius=log(smooth.radius),
            sliding_height=log(height / (smooth.sunk * rest.depth)),
            sliding_waves=log(smooth.radius * a * waves.curved / (2 * pi)),
            sliding_pressure=-log(full.pressure),
            line_pressure=-log(full.line_pressure),
            full_friction=log(line / space) if space else 0.0,
            full_share=full.friction / space if space else 0.0,
            riding=1 - (waves.bands.beneath(smooth.radius * a).rms_height / height) ** 2,
            nominal=log(min(law.x, FLAT)),
            friction=log((smooth_line + line_touching) / by_law) if by_law else 0.0,
            share=law.rough / by_law if by_law else 0.0,
            side=smooth.radius * a / waves.side,
            directed=log(waves.directed),
            skewness=waves.skewness,
            tails=waves.tails,
            gaussian=float(getattr(scene.roughness, "amplitudes", "") == "gaussian"),
            doubt=log(_misfit(law)),
        )


def _misfit(law: LawParts) -> float:
    """Expected misfit of ln mu of the law."""
    of_it = law.rough / law.friction_coefficient if law.rough else 0.0
    light = BY_LIGHTNESS * min(law.x, 1.0) ** -0.25
    parts = AT_LEAST, of_it * BY_ROUGHNESS, of_it * light, BY_HEIGHT * law.height, BY_RIDDEN * law.ridden
    return min(hypot(*parts), MOST_MISFIT)


def _roughness(scene: Scene) -> Isotropic | Topography:
    """Roughness that has groups. Raises TypeError for a scene without."""
    if not isinstance(scene.roughness, Isotropic | Topography):
        raise TypeError(f"roughness = {scene.roughness!r} has no groups: SelfAffine, Spectrum and Topography have")
    return scene.roughness
