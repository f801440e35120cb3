"""Friction that a user measured at several loads and speeds, shifted onto one curve: `crosscheck mastercurve`."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import isfinite, nan, sqrt
from pathlib import Path

import numpy as np
import xarray

from scene.printable import brief
from scene.quantities import NEWTON, SPEED
from scene.reading import InvalidInput
from scene.table import read_rows

from ..declaration import Study
from ..finding import Finding, claimed, sentences
from ..outcome import Outcome
from ..page import Block, Findings, Plot, Table, Text
from ..plots import shifted_curves
from ..statistics import eq23
from ..statistics.collapse import Alignment, Collapse, collapse
from ..statistics.frictioncurves import Curve, MeasuredCurves
from ..task import Batch, Task
from ..vocabulary import attributes

COLUMNS = ("mu", "F_N", "v")
# Names of the columns that a heading may have, in lower case.
CALLED = {
    "mu": ("mu", "µ", "μ", "friction", "friction_coefficient", "cof"),
    "F_N": ("f_n", "fn", "load", "normal_force", "force"),
    "v": ("v", "speed", "velocity", "sliding_speed"),
}
UNITS = {"F_N": NEWTON, "v": SPEED}  # mu has none
PLAIN = ("1", "-")  # written for none
# "F_N [mN]", "F_N (mN)", "F_N / mN", or a name alone.
_NAMED = re.compile(r"(?P<name>[^\[(/]*?)\s*(?:\[(?P<a>[^\]]*)\]|\((?P<b>.*)\)|/\s*\(?(?P<c>[^()]+)\)?)?")
LEAST_LOADS = 2
MOST_SPEEDS, MOST_POINTS = 100, 5_000
MOST_ROWS = 100_000  # of a table: measurements, repeated ones too
MEASURED = "measured"
VARIABLES = dict(zip(COLUMNS, ("friction_coefficient", "normal_force", "speed"), strict=True))

# Claims of Eq. 23 in the words of a measurement, by their own names.
CLAIMS = {
    eq23.COLLAPSE.id: ("mastercurve.horizontal", "Shifts along the load bring the curves onto one"),
    eq23.VERTICAL.id: ("mastercurve.vertical", "No shift along friction is needed beside them"),
    eq23.UNSHIFTED.id: ("mastercurve.unshifted", "Misfit to one curve before shifting"),
    eq23.VERTICAL_ALONE.id: ("mastercurve.vertical-alone", "Misfit to one curve with shifts along friction alone"),
    eq23.BOTH.id: ("mastercurve.both", "Misfit to one curve with both shifts"),
    eq23.ALONE.id: ("mastercurve.exponent", "Exponent of the shift along the load as a power of the speed"),
    eq23.BESIDE.id: ("mastercurve.exponent-beside-vertical", eq23.BESIDE.sentence),
    eq23.NOT_SHIFTED.id: (
        "mastercurve.vertical-exponent",
        "Exponent of the shift along friction, beside that along the load, as a power of the speed",
    ),
}
NOT_REPEATED = "no point was measured more than once: the scatter is not known, and part of a misfit"


@dataclass(frozen=True)
class Mastercurve(Study):
    """Shifts of measured friction.

    path : of a table of friction, load and speed, a row a measurement
    """

    path: Path

    command = "mastercurve"

    @classmethod
    def of(cls, table: str | Path) -> "Mastercurve":
        """The study of a table. Raises InvalidInput naming file, line and what is allowed."""
        study = cls(Path(table))
        try:
            study.data  # noqa: B018
            study.collapse  # noqa: B018
        except ValueError as error:
            said, name = str(error), brief(str(table))
            raise InvalidInput(said if said.startswith(name) else f"{name}: {said}") from error
        return study

    @property
    def title(self) -> str:  # type: ignore[override]
        return f"Friction of {self.path.stem} on one curve"

    @property
    def inputs(self) -> Mapping[str, str]:
        return {"table": str(self.path)}

    @cached_property
    def data(self) -> xarray.Dataset:
        """The table as a Dataset with a measurement a row."""
        return read_measured(self.path)

    @cached_property
    def collapse(self) -> Collapse:
        """Shifts of the curves."""
        return collapse(curves_of(self.data))

    def batches(self) -> Sequence[Batch]:
        return ()

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        return xarray.DataTree.from_dict({f"/{MEASURED}": self.data})

    @cached_property
    def lead(self) -> Alignment:
        """Alignment that is the answer: by both shifts where friction itself is shifted, else along the load."""
        return self.collapse.both if eq23.raised(self.collapse) else self.collapse.horizontal

    def findings(self, answers: xarray.DataTree) -> list[Finding]:
        """Whether horizontal shifts suffice, whether vertical ones are needed, and the exponents of both."""
        found, plots = self.collapse, (shifted_curves.NAME,) * 2
        raw = {
            eq23.COLLAPSE.id: found.horizontal.rms,
            eq23.UNSHIFTED.id: found.unshifted.rms,
            eq23.VERTICAL_ALONE.id: found.vertical.rms,
        }
        findings = []
        for each in eq23.findings(found, None, MEASURED, where=self.path.stem, draws=0, plots=plots, every=True):
            name, sentence = CLAIMS[each.claim.id]
            if not isfinite(found.scatter):
                known = each.value if each.claim is eq23.ALONE else raw.get(each.claim.id, nan)
                each = replace(each, value=known, reason=NOT_REPEATED)
            findings.append(replace(each, claim=replace(each.claim, id=name, sentence=sentence)))
        return findings

    def answer(self, findings: Sequence[Finding]) -> Sequence[str]:
        named = {each.claim.id: each for each in findings}
        across, along, alone, collapsed = (
            named[CLAIMS[claim.id][0]] for claim in (eq23.NOT_SHIFTED, eq23.BESIDE, eq23.ALONE, eq23.COLLAPSE)
        )
        told = sentences(claimed(findings))
        if self.lead is self.collapse.both:
            return [eq23.answer(across, along, alone, collapsed).capitalize(), *told]
        return [*told, *sentences([alone])]

    def plots(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> list[Plot]:
        row = shifted_curves.ShiftedCurves(self.path.stem, self.collapse, findings[0], lead=self.lead)
        plot = shifted_curves.plot([row])
        return [plot] if plot else []

    def blocks(
        self, answers: xarray.DataTree, findings: Sequence[Finding], plots: Sequence[Plot]
    ) -> Sequence[Block]:
        told = "Natural logarithms of the shifts, with intervals of 95 %."
        return [*plots, Findings(findings), Table("shifts", self.collapse.shifts(self.lead), told)]

    def setting(self, answers: xarray.DataTree) -> Sequence[Block]:
        """Number and range of the measurements."""
        loads, speeds = self.data["normal_force"].values, self.data["speed"].values
        reach = [f"{each.min():.3g} to {each.max():.3g}" for each in (speeds, loads)]
        counts = f"{loads.size} measurements at {np.unique(speeds).size} speeds from {self.path.name}"
        return [Text(f"{counts}: speeds of {reach[0]} m/s, loads of {reach[1]} N.")]


def read_measured(path: str | Path) -> xarray.Dataset:
    """Table of friction coefficient mu, normal force F_N and speed v, a row a measurement, in SI.

    Columns stand in this order, or as a heading names them, and are in [N] and [m/s], or in the units that the
    heading gives: "v [mm/s], F_N [mN], mu". Raises ValueError naming file and line.
    """
    heading, rows = read_rows(path, COLUMNS, MOST_ROWS)
    order, units = _order_and_units(heading)
    columns = (np.array(rows, float).reshape(-1, len(COLUMNS)) * units)[:, order].T
    variables = {
        name: ("measurement", column, attributes(name))
        for name, column in zip(VARIABLES.values(), columns, strict=True)
    }
    return xarray.Dataset(variables)


def curves_of(data: xarray.Dataset) -> MeasuredCurves:
    """Curves of measurements.

    Rows of equal load and speed are measurements of one point: their mean counts. Its standard error is that of a
    scatter which, relative to friction, is the same everywhere: two or three measurements say too little of their
    own. Where no point was measured twice, it is not known. Raises ValueError with too few or too many points.
    """
    points: dict[float, dict[float, list[float]]] = {}
    columns = (data[name].values.tolist() for name in VARIABLES.values())
    for friction, load, speed in zip(*columns, strict=True):
        points.setdefault(speed, {}).setdefault(load, []).append(friction)
    if not 2 <= len(points) <= MOST_SPEEDS:
        raise ValueError(f"{len(points):,} speeds: 2 to {MOST_SPEEDS} are shifted onto one curve")
    if (count := sum(map(len, points.values()))) > MOST_POINTS:
        raise ValueError(f"{count:,} loads at all speeds: at most {MOST_POINTS:,} are shifted onto one curve")
    for speed, loads in points.items():
        if len(loads) < LEAST_LOADS:
            raise ValueError(f"v = {speed:g} has {len(loads)} load: at least {LEAST_LOADS} are needed for a curve")
    scatter, freedom = pooled_scatter([each for loads in points.values() for each in loads.values()])
    return MeasuredCurves(tuple(_curve(speed, points[speed], scatter) for speed in sorted(points)), freedom)


def pooled_scatter(repeated: Sequence[Sequence[float]]) -> tuple[float, int]:
    """Standard deviation of a measurement relative to the mean of its point, and its degrees of freedom."""
    freedom = sum(len(each) - 1 for each in repeated)
    squares = sum(float(np.sum(np.square(np.array(each) / np.mean(each) - 1))) for each in repeated)
    return (sqrt(squares / freedom), freedom) if freedom else (nan, 0)


def _curve(speed, loads, scatter):
    ordered = [loads[load] for load in sorted(loads)]
    friction, error = zip(*((np.mean(each), scatter / sqrt(len(each))) for each in ordered), strict=True)
    return Curve(speed, np.log(sorted(loads)), np.log(friction), np.array(error))


def _order_and_units(heading):
    """Columns of mu, F_N and v, and the units of all columns in SI, in the order of the heading."""
    if not heading:
        return list(range(len(COLUMNS))), np.ones(len(COLUMNS))
    cells = [_NAMED.fullmatch(cell) for cell in heading]
    names = [
        "_".join(found["name"].lower().split()) if found else cell
        for cell, found in zip(heading, cells, strict=True)
    ]
    meant = [next((column for column in COLUMNS if name in CALLED[column]), name) for name in names]
    if sorted(meant) != sorted(COLUMNS):
        allowed = "; ".join(f"{name} as {', '.join(called)}" for name, called in CALLED.items())
        raise ValueError(
            f"the heading {brief(repr(heading))} must name each of {', '.join(COLUMNS)} once: {allowed}"
        )
    stated = [next(filter(None, found.group("a", "b", "c")), "").strip() for found in cells]
    units = [_unit(column, unit) for column, unit in zip(meant, stated, strict=True)]
    return [meant.index(name) for name in COLUMNS], np.array(units)


def _unit(column, stated):
    """The unit of a column in SI. Raises ValueError for a unit of anything else."""
    if not stated or (column not in UNITS and stated in PLAIN):
        return 1.0
    needed = "no unit" if column not in UNITS else f"the unit of {UNITS[column].kind}, as {UNITS[column].symbol},"
    try:
        return UNITS[column].value(f"1 {stated}")
    except (KeyError, ValueError) as error:
        raise ValueError(f"the heading gives {column} in {brief(repr(stated))}: {needed} is needed") from error
