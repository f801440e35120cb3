"""A rubber of finite thickness under a sphere: stiffness and friction on both sides of the paper's force F*."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from math import log
from typing import Literal

import numpy as np
from scipy.optimize import brentq

from bem3d import BEM
from compare.models.exact import layer as reference
from compare.models.exact import mean_lag
from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask as Task
from compare.solving.task import Task as AnyTask
from mdr1d.estimates import layer_force
from scene import Elastic, Indent, Layer, Scene, SelfAffine, Slide, Sphere, StandardLinearSolid

from .chapter import Chapter, Rows
from .figures import layer as drawing
from .means import MEANING, mean

NAME, TITLE = "layer", "A layer of finite thickness"
SOLVER, SLIDING, ROUGH = BEM(points=128, tolerance=1e-7), BEM(points=64), BEM(points=128)
MODULUS = 3e6  # G_0 [Pa]
THICKNESS, SPHERE = 10e-3, Sphere(radius=50e-3)
GEOMETRIES = ((THICKNESS, SPHERE), (5e-3, Sphere(radius=25e-3)))
FORCES = tuple(float(force) for force in np.geomspace(1e-2, 1e4, 13))  # [N]
APART = 0.05  # of a load, to either side: for a stiffness
SLOPE = 0.3  # radius of the contact over that of the sphere up to which slopes are called small
STIFFENING = 9.0  # glassy over rubbery modulus, less one
CREEP = 1e-3  # [s]
MEMORIES = (0.01, 0.1, 1.0)  # length that the sphere slides in that time, over the thickness
OVER_F = (1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0)
ROUGHNESS = SelfAffine(hurst=0.8, rms_height=30e-6, longest=8e-3, shortest=2e-3)
ROUGH_MEMORY, ROUGH_OVER_F = 0.2, (0.1, 1.0, 10.0)  # length over the shortest wave
SURFACES = 3
TEXT = """A sphere of R = {radius:g} mm on rubber of G₀ = {modulus:g} MPa and D = {thickness:g} mm. The paper has a
force F* = (2/3) G₀ D³/R, here {force:.0f} N, beyond which the layer is felt and the stiffness k = dF/dd goes as
F^(1/2) in place of F^(1/3). Below, F* has E*/4 in place of G₀: the half-space of any Poisson ratio then has
2a = D at it. Everything is a function of F/F*. With D = 5 mm and R = 25 mm F* is {other:.0f} N, and there k/(E* D)
is that of the first pair at its own to {same:.0e}.

**Stiffness.** In three dimensions k is within {off:.1e} of an integral equation that knows no grid
(`compare.models.exact.layer`), on all layers and from {least:g} to {most:g} N. On the layer bonded at ν = 1/2 the
exponent of k is {at_force:.2f} at F*, where it is {stiffer:.2f} times as stiff as the half-space at the same
load; it passes 1/2 at {half:.2f} F*, is {last:.2f} at {last_over:.0f} F*, and tends to 2/3. With ν = 0.45 it
rises above 1/2 as well, to {bump:.2f}, and comes back; with ν = 0.3 and on a frictionless base it goes to 1/2
and stays there. So k ~ F^(1/2) is the law of a layer that yields to an even pressure, and what a bonded
incompressible one shows in passing. The change is slow: at F*/1000 the exponent of the
bonded layer is {early:.3f}. From {steep:.0f} N on the contact is wider than {slope:g} R: there the exponents
are those of the linear equations, not of a rubber.

**Friction of the smooth sphere** on a standard linear solid, E_g/E_r = {stiffening:g}, is drawn over that at
low speed, v τ/R with the mean lag τ of the elastomer. That limit is the same on every layer and is met within
{slow:.1%} at {heavy:g} F* and v τ_c = {slowest:g} D. Where the sphere slides faster, v τ_c > a, friction
depends on the size of the contact, which grows slower on the layer (panels c, d): at {heavy:g} F* and v τ_c
= D the layer bonded at ν = 1/2 has {ratio:.2f} of the friction of the half-space at the same load, the one with
ν = 0.3 {ratio_even:.2f}; at F* they have {ratio_at:.2f} and {ratio_even_at:.2f}.

**Rough sphere**, {surfaces} surfaces with waves from {longest:g} to {shortest:g} mm, rms height {rms:g} µm, v
τ_c a fifth of the shortest. On the layer bonded at ν = 1/2 friction under the same surfaces is {rough} times
that on the half-space: a layer five times as thick as the shortest wave is a half-space to that wave, and is
felt through the pressure alone.

{meaning}
"""


@dataclass(frozen=True)
class Rubber:
    """Body that is pressed: base of the layer, None of a half-space, and Poisson ratio."""

    base: Literal["bonded", "frictionless"] | None
    poisson_ratio: float

    @property
    def name(self) -> str:
        """For people."""
        if self.base is None:
            return "half-space"
        return f"{self.base}, ν = {self.poisson_ratio:g}"

    def layer(self, thickness=THICKNESS) -> Layer | None:
        """As a scene states it."""
        return None if self.base is None else Layer(thickness=thickness, base=self.base)

    @property
    def modulus(self) -> float:
        """E* [Pa]."""
        return 2 * MODULUS / (1 - self.poisson_ratio)

    def force(self, thickness=THICKNESS, sphere=SPHERE) -> float:
        """F* [N] of this E*."""
        return float(layer_force(self.modulus / 4, thickness, sphere.mdr_coefficient, sphere.exponent))

    def known(self, load, thickness=THICKNESS, sphere=SPHERE) -> reference.Contact:
        """By the integral equation; a half-space is a layer of a million times the thickness."""
        layer = self.layer(thickness) or Layer(thickness=1e6 * thickness)
        return reference.of_load(sphere, layer, self.modulus, self.poisson_ratio, load)

    def exponent(self, load) -> float:
        """d ln k / d ln F there, as known."""
        below, above = (self.known(load * by).stiffness for by in (1 - APART, 1 + APART))
        return log(above / below) / log((1 + APART) / (1 - APART))


HALF_SPACE, FILM = Rubber(None, 0.5), Rubber("bonded", 0.5)
RUBBERS = (HALF_SPACE, FILM, Rubber("bonded", 0.45), Rubber("bonded", 0.3), Rubber("frictionless", 0.5))
SLID = (HALF_SPACE, FILM, Rubber("bonded", 0.3))


def tasks() -> list[Task]:
    """Pairs of loads for stiffness, sliding at several speeds, and rough surfaces."""
    pairs = (task for rubber in RUBBERS for force in FORCES for task in _pair(rubber, force))
    at_force = (task for geometry in GEOMETRIES for task in _pair(FILM, FILM.force(*geometry), *geometry))
    return [*pairs, *at_force, *_slid().values(), *_rough().values()]


def chapter(outcomes: Mapping[AnyTask, Outcome]) -> Chapter:
    """What becomes of both sides of F*."""
    found = [_stiffness(rubber, force, outcomes) for rubber in RUBBERS for force in FORCES]
    slid = [_friction(*asked, outcomes[task]) for asked, task in _slid().items()]
    rows = [*found, *_exponents(found), *slid]
    tables = {"Exponents of the stiffness": _table(rows), "Friction of the rough sphere": _means(outcomes)}
    figures = {drawing.NAME: drawing.figure(rows)}
    return Chapter(_said(outcomes, found, slid), tables, figures, {drawing.NAME: rows})


def _pair(rubber, force, thickness=THICKNESS, sphere=SPHERE):
    solid = Elastic(MODULUS, poisson_ratio=rubber.poisson_ratio)
    scene = Scene(sphere, solid, Indent(load=force), layer=rubber.layer(thickness))
    return [
        Task(SOLVER, (replace(scene, motion=Indent(load=force * by)),), work=3.0) for by in (1 - APART, 1 + APART)
    ]


def _solid(rubber):
    return StandardLinearSolid(
        MODULUS, (1 + STIFFENING) * MODULUS, CREEP / (1 + STIFFENING), poisson_ratio=rubber.poisson_ratio
    )


def _sliding(rubber, memory, over, roughness=None):
    motion = Slide(speed=memory / CREEP, load=over * rubber.force())
    return Scene(SPHERE, _solid(rubber), motion, roughness, rubber.layer())


def _slid() -> dict[tuple[Rubber, float, float], Task]:
    """By rubber, memory and load over F*."""
    return {
        (rubber, memory, over): Task(SLIDING, (_sliding(rubber, memory * THICKNESS, over),), work=10.0)
        for rubber in SLID
        for memory in MEMORIES
        for over in OVER_F
    }


def _rough():
    """By rubber, load over F* and surface."""
    memory = ROUGH_MEMORY * ROUGHNESS.shortest
    return {
        (rubber, over, seed): Task(
            ROUGH, (_sliding(rubber, memory, over, replace(ROUGHNESS, seed=seed)),), work=40.0
        )
        for rubber in SLID
        for over in ROUGH_OVER_F
        for seed in range(SURFACES)
    }


def _slope(outcomes, pair):
    """dF/dd between two loads [N/m]."""
    below, above = (outcomes[task].rows[0] for task in pair)
    return (above.normal_force - below.normal_force) / (above.depth - below.depth)


def _stiffness(rubber, force, outcomes):
    """Stiffness at a load, of the solver and as known, in the same difference."""
    known = [rubber.known(force * by) for by in (1 - APART, 1 + APART)]
    unit = 2 * rubber.modulus * THICKNESS / 2
    return {
        "quantity": "stiffness",
        "rubber": rubber.name,
        "x": force / rubber.force(),
        "force": force,
        "found": _slope(outcomes, _pair(rubber, force)) / unit,
        "known": (known[1].load - known[0].load) / (known[1].depth - known[0].depth) / unit,
        "radius": rubber.known(force).radius,
    }


def _exponents(found) -> Rows:
    """Between neighbours of the same rubber."""
    rows = []
    for one, other in pairwise(found):
        if one["rubber"] != other["rubber"]:
            continue
        step = log(other["x"] / one["x"])
        rows.append(
            {
                "quantity": "exponent",
                "rubber": one["rubber"],
                "x": float(np.sqrt(one["x"] * other["x"])),
                "force": float(np.sqrt(one["force"] * other["force"])),
                "found": float(np.log(other["found"] / one["found"]) / step),
                "known": float(np.log(other["known"] / one["known"]) / step),
                "radius": other["radius"],
            }
        )
    return rows


def _friction(rubber, memory, over, outcome):
    """Friction over that at low speed."""
    slow = memory * THICKNESS / CREEP * mean_lag(_solid(rubber)) / SPHERE.radius
    return {
        "quantity": f"friction {memory:g}",
        "rubber": rubber.name,
        "x": over,
        "force": over * rubber.force(),
        "found": outcome.rows[0].friction_coefficient / slow,
        "known": 1.0,
        "radius": float("nan"),
    }


def _means(outcomes) -> Rows:
    """Friction of the rough sphere."""
    rows, tasks = [], _rough()
    for rubber in SLID:
        row = {"rubber": rubber.name}
        for over in ROUGH_OVER_F:
            values = [outcomes[tasks[rubber, over, k]].rows[0].friction_coefficient for k in range(SURFACES)]
            row[f"μ at {over:g} F*"] = mean(values)
        rows.append(row)
    return rows


def _table(rows) -> Rows:
    """A row a rubber, a column a load."""
    table = []
    for rubber in RUBBERS:
        own = [row for row in rows if row["quantity"] == "exponent" and row["rubber"] == rubber.name]
        cells = {
            f"{float(format(row['force'], '.2g')):g} N": f"{row['found']:.3f} ({row['known']:.3f})"
            for row in own[1::2]
        }
        table.append({"3D (integral equation)": rubber.name} | cells)
    return table


def _said(outcomes, found, slid):
    """The text, with its numbers."""
    stiffness = {
        geometry: _slope(outcomes, _pair(FILM, FILM.force(*geometry), *geometry)) for geometry in GEOMETRIES
    }
    unlike = [stiffness[geometry] / geometry[0] for geometry in GEOMETRIES]
    friction = {(row["quantity"], row["rubber"], row["x"]): row["found"] for row in slid}
    force, heavy, fast = FILM.force(), OVER_F[-1], f"friction {MEMORIES[-1]:g}"
    over = {
        (rubber, at): friction[fast, rubber.name, at] / friction[fast, HALF_SPACE.name, at]
        for rubber in SLID[1:]
        for at in (1.0, heavy)
    }
    nearly = [rubber.exponent(load) for rubber in RUBBERS[2:3] for load in FORCES]
    steep = [row["force"] for row in found if row["rubber"] == FILM.name and row["radius"] > SLOPE * SPHERE.radius]
    return TEXT.format(
        radius=SPHERE.radius * 1e3,
        modulus=MODULUS / 1e6,
        thickness=THICKNESS * 1e3,
        force=force,
        other=FILM.force(*GEOMETRIES[1]),
        same=max(abs(unlike[1] / unlike[0] - 1), 1e-14),
        off=max(abs(row["found"] / row["known"] - 1) for row in found),
        least=FORCES[0],
        most=FORCES[-1],
        at_force=FILM.exponent(force),
        stiffer=FILM.known(force).stiffness / HALF_SPACE.known(force).stiffness,
        half=brentq(lambda at: FILM.exponent(at * force) - 0.5, 0.1, 10.0, xtol=1e-3),
        last=FILM.exponent(FORCES[-1]),
        last_over=FORCES[-1] / force,
        bump=max(nearly),
        early=FILM.exponent(force / 1000),
        steep=min(steep),
        slope=SLOPE,
        stiffening=1 + STIFFENING,
        slow=max(abs(friction[f"friction {MEMORIES[0]:g}", rubber.name, heavy] - 1) for rubber in SLID),
        slowest=MEMORIES[0],
        heavy=heavy,
        ratio=over[FILM, heavy],
        ratio_even=over[SLID[2], heavy],
        ratio_at=over[FILM, 1.0],
        ratio_even_at=over[SLID[2], 1.0],
        surfaces=SURFACES,
        longest=ROUGHNESS.longest * 1e3,
        shortest=ROUGHNESS.shortest * 1e3,
        rms=ROUGHNESS.rms_height * 1e6,
        rough=", ".join(_compared(outcomes, at) for at in ROUGH_OVER_F),
        meaning=MEANING,
    )


def _compared(outcomes, over):
    """Friction of the rough sphere over that on the half-space, surface by surface."""
    tasks = _rough()
    on_film, on_half_space = (
        np.array([outcomes[tasks[rubber, over, seed]].rows[0].friction_coefficient for seed in range(SURFACES)])
        for rubber in (FILM, HALF_SPACE)
    )
    return f"{mean(on_film / on_half_space)} at {over:g} F*"
