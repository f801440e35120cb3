"""Stored laws: the accuracy of the one-dimensional answer in numbers, ratios to 3D and to closed forms."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from math import isfinite, nan
from pathlib import Path
from typing import NamedTuple

import numpy as np
from pydantic.dataclasses import dataclass as validated

from bem3d import BEM
from mdr1d import MDR, draw, equations
from scene import Indent, Scene, SelfAffine, Slide, StandardLinearSolid
from scene.files.reading import read
from scene.quantities import CLOSED, Finite
from scene.scales import elastic_contact

from ...solving.folders import write
from ...solving.task import draws_of
from ...statistics.finding import FAILS, HOLDS, UNDECIDED, Finding
from .closed_forms import BODIES, LOSSY, ROUND, founded, pressed
from .law import STORED, Law, stated
from .ordinary import KELVIN, PACE, RADIUS, TIME, deep

SHIPPED = Path(__file__).with_name("baseline.toml")
NEW = "not in the file of stored numbers"
HEADING = "# Numbers as they were found, by `crosscheck regress --update` or `pytest --mdr-regen`."
DIGITS = 10  # of a stored value: no tolerance is less than these leave
# Three dimensions are solved closer than by default, so that what is seen is their discretisation.
SPACE, LINE = BEM(points=128, tolerance=1e-7), MDR(points=2000)
# Of the paper: the roughness of Fig. 4, and the Hurst exponents of Fig. 1.
ROUGH = SelfAffine(hurst=0.4, rms_height=5e-5, longest=1e-2)
HURST = {"cone": 0.1, "sphere": 0.2}
PROFILES, SURFACES, PAPER_PROFILES, PAPER_POINTS = 20, 8, 50, 5000
DECADES = {"1e-2": 0.01, "1": 1.0, "1e2": 100.0}
# Tolerances by the first part of the id, each with its reason; measured by solving everything again in those ways.
TOLERANCES = {
    "rest": (1e-6, "solving 3D to 1e-9 for 1e-7 moves it by 2e-8 at most, 120 points for 128 by 2e-6 to 4e-5"),
    "slide": (1e-5, "solving 3D to 1e-9 for 1e-7 moves it by 6e-7 at most, 120 points for 128 by up to 2e-3"),
}
ROUNDING = 1e-8, "rounding alone: 1D is exact on its grid, loads are met to 1e-10"


class Ratio(NamedTuple):
    """A ratio of means over draws: of a number of the scene in 1D over a known one, or over that in 3D."""

    id: str
    number: str
    scene: Scene
    known: float | None = None
    solver: MDR = LINE
    draws: int = PROFILES


def laws() -> Iterator[Law]:
    """Laws that each ratio equals the stored value of its id; NaN for a ratio that is not stored."""
    values = read_values(SHIPPED)
    for part in (_at_rest, _smooth, _rough, _paper, _withdrawal, _foundation):
        for each in part():
            yield _law(each, f"{part.__doc__}: {each.number} in {each.id}", values.get(each.id, nan))


def tolerance(id: str) -> tuple[float, str]:
    """Relative tolerance of a ratio, and its reason."""
    return TOLERANCES.get(id.partition(".")[0], ROUNDING)


def _law(asked: Ratio, sentence: str, value: float) -> Law:
    above = draws_of(asked.scene, asked.draws)
    below = draws_of(asked.scene, SURFACES) if asked.known is None else ()
    solvers = (asked.solver,) * len(above) + (SPACE,) * len(below)

    def misfit(answers):
        found = [answer[asked.number] for answer in answers]
        return np.mean(found[: len(above)]) / (asked.known or np.mean(found[len(above) :]))

    share, why = tolerance(asked.id)
    bound = stated(share * abs(value), f"{share:g}: {why}")
    return Law(asked.id, STORED, sentence, above + below, misfit, bound, models=lambda _: solvers, expected=value)


def _at_rest() -> Iterator[Ratio]:
    """At rest, 1D/3D"""
    for name, shape in (ROUND | {"quartic": BODIES["r^4"]}).items():
        yield Ratio(f"rest.{name}.force", "normal_force", deep(shape, KELVIN))


def _smooth() -> Iterator[Ratio]:
    """Smooth sliding at the load whose static contact has the radius a, 1D/3D"""
    for solid, name, (label, pace) in product(LOSSY, ROUND, DECADES.items()):
        still = deep(ROUND[name], LOSSY[solid])
        scene = replace(still, motion=Slide(speed=pace * PACE, load=elastic_contact(still).load))
        yield Ratio(f"slide.{name}.{solid}.{label}.friction", "friction_force", scene)
        if pace >= 1:
            yield Ratio(f"slide.{name}.{solid}.{label}.depth", "depth", scene)


def _rough() -> Iterator[Ratio]:
    """The paper's contacts with a shortest wave that both resolve, 1D/3D"""
    for name, shape in ROUND.items():
        rough = SelfAffine(hurst=HURST[name], rms_height=5e-5, longest=1e-2, shortest=5e-4, seed=1)
        scene = Scene(shape, KELVIN, Slide(speed=0.1, load=1.0), rough)
        still = replace(scene, motion=Indent(depth=elastic_contact(scene).depth))
        yield Ratio(f"rest.rough-{name}.force", "normal_force", still)
        for label, speed in {"1e-2": 0.01, "1e-1": 0.1, "1e1": 10.0}.items():
            moved = replace(scene, motion=Slide(speed=speed, load=1.0))
            yield Ratio(f"slide.rough-{name}.{label}.friction", "friction_force", moved)


def _paper() -> Iterator[Ratio]:
    """Fig. 4 of the paper at three xi, 1D/Eq. 19"""
    slope, load, line = draw(ROUGH, PAPER_POINTS).rms_slope, 10.0, MDR(points=PAPER_POINTS)
    for (name, shape), (label, xi) in product(ROUND.items(), DECADES.items()):
        body = shape.mdr_coefficient, shape.exponent
        unit = equations.similarity_variable(load, KELVIN.modulus, TIME, 1.0, slope, *body)
        scene = Scene(shape, KELVIN, Slide(speed=xi / unit, load=load), ROUGH)
        known = equations.plateau(slope) * equations.interpolation(xi)
        yield Ratio(f"law.{name}.{label}.friction", "friction_coefficient", scene, known, line, PAPER_PROFILES)


def _withdrawal() -> Iterator[Ratio]:
    """Pressed in at a constant rate for 2 s and drawn back as fast, on a solid that relaxes in 1 s, 1D/Ting"""
    solid, rate = StandardLinearSolid(1e6, 5e6, 1.0), RADIUS / 40
    for (name, shape), time in product(ROUND.items(), (2.2, 2.5)):
        scene, force = pressed(shape, solid, (2.0, 2 * rate), (time - 2, (4 - time) * rate))
        id = f"withdrawal.{name}.{1e3 * time:.0f}ms.force"
        yield Ratio(id, "normal_force", scene, force["normal_force"], MDR(points=400, steps=20))


def _foundation() -> Iterator[Ratio]:
    """Sliding on a foundation at v tau/a = 1, 1D/exact"""
    for solid, name in product(LOSSY, ROUND):
        scene, forces = founded(ROUND[name], LOSSY[solid], 1.0)
        for number, force in forces.items():
            id = f"foundation.{name}.{solid}.{number.removesuffix('_force')}"
            yield Ratio(id, number, scene, force, MDR(points=400))


def held(found: Finding, value: float, share: float) -> Finding:
    """A finding held against a stored value, within a share of it; undecided where either is not known."""
    claim = replace(found.claim, expected=value, tolerance=share * abs(value))
    distance = abs(found.value - value)
    if isfinite(distance):
        stated = HOLDS if distance <= claim.tolerance else FAILS
        return replace(found, claim=claim, stated=stated, reason="", remedy="")
    new = f"{NEW}: {found.value:.{DIGITS}g}"
    return replace(found, claim=claim, stated=UNDECIDED, reason=found.reason or new)


@dataclass(frozen=True, kw_only=True)
class Stored:
    """Base of studies whose numbers are held against a file.

    path : of the file; values : those in it; update : whether what has moved is stored afterwards
    """

    path: Path = SHIPPED
    values: Mapping[str, float] = field(default_factory=dict)
    update: bool = False

    def failed(self, findings: Sequence[Finding]) -> bool:
        """Whether anything asks for somebody's attention; after an update, whether something is not stored."""
        return any(each.stated != HOLDS and not (self.update and isfinite(each.value)) for each in findings)

    def store(self, findings: Sequence[Finding]) -> None:
        """Store what has moved or is new, and nothing else; what has failed keeps its value.

        What moved within its tolerance stays as it is stored: many small steps do not pass unseen.
        """
        moved = {
            each.claim.id.removeprefix("regress."): each.value
            for each in findings
            if each.stated != HOLDS and isfinite(each.value)
        }
        if moved:
            write_values(self.path, {**self.values, **moved})


@validated(frozen=True, config=CLOSED)
class _Stored:
    values: dict[str, Finite]


def read_values(path: Path, begin: bool = False) -> dict[str, float]:
    """Stored values by id; none of a file that is to be begun. Raises InvalidInput if the file is none."""
    return {} if begin and not path.exists() else read(path, _Stored).values


def write_values(path: Path, values: Mapping[str, float]) -> None:
    """Write one line a number, in the order of their ids; printable JSON strings are TOML strings."""
    rounded = {id: float(f"{values[id]:.{DIGITS}g}") for id in sorted(values)}
    lines = (f"{json.dumps(id, ensure_ascii=False)} = {value!r}" for id, value in rounded.items())
    text = "\n".join([HEADING, "", "[values]", *lines, ""])
    write(path, lambda file: file.write(text.encode()))
