"""Friction that a user measured at several loads and speeds, shifted onto one curve: `crosscheck mastercurve`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isfinite, nan
from typing import Any

import xarray
from pandas import DataFrame

from scene.files.reading import InvalidInput
from scene.printable import brief
from scene.quantities import BARE, argument

from ...figures import collapse as collapsed
from ...figures import temperature_shifts
from ...report.page import Block, Findings, Table, Text
from ...solving.task import Batch, Outcome, Task
from ...solving.words import sentences
from ...statistics import eq23
from ...statistics.collapse import Alignment, Collapse, collapse
from ...statistics.finding import REPORTED
from ..study import Judgement, Study
from . import temperatures
from .measuredcurves import CURVE, WARMTH, Pooled, check, curves_of, in_order, pooled
from .measurements import MeasuredFriction, Measurements
from .temperatures import Constants, points_table, shifts_table
from .temperatureshifts import TemperatureShifts

TOLERANCE = (
    0.05  # relative: loads within it are one, and speeds; wider than devices scatter, less than people step
)
WIDEST = 0.5
MEASURED = "measured"

# Claims of Eq. 23 in the words of a measurement, by their own names.
CLAIMS = {
    eq23.COLLAPSE.id: ("mastercurve.horizontal", "Shifts along the load bring the curves onto one"),
    eq23.VERTICAL.id: ("mastercurve.vertical", "No shift along friction is needed in addition"),
    eq23.UNSHIFTED.id: ("mastercurve.unshifted", "Misfit to one curve before shifting"),
    eq23.VERTICAL_ALONE.id: ("mastercurve.vertical-alone", "Misfit to one curve with shifts along friction alone"),
    eq23.BOTH.id: ("mastercurve.both", "Misfit to one curve with both shifts"),
    eq23.ALONE.id: ("mastercurve.exponent", "Exponent of the shift along the load as a power of the speed"),
    eq23.JOINT.id: ("mastercurve.exponent-beside-vertical", eq23.JOINT.sentence),
    eq23.NOT_SHIFTED.id: (
        "mastercurve.vertical-exponent",
        "Exponent of the shift along friction as a power of the speed, with a shift along the load too",
    ),
}
NOT_REPEATED = "no point was measured more than once: the scatter is not known, and part of a misfit"
EXPONENTS = (eq23.ALONE.id, eq23.JOINT.id, eq23.NOT_SHIFTED.id)


@dataclass(frozen=True, eq=False)
class Mastercurve(Study):
    """Shifts of measured friction.

    friction : measurements
    tolerance : relative; loads that differ by less count as equal, and so do speeds
    constants : of WLF, as stated
    """

    friction: MeasuredFriction
    tolerance: float = TOLERANCE
    constants: Constants = field(default_factory=Constants)

    command = "mastercurve"

    @classmethod
    def of(
        cls,
        table: Measurements,
        tolerance: float = TOLERANCE,
        c1: Any = None,
        c2: Any = None,
        reference: Any = None,
        **stated: Any,
    ) -> "Mastercurve":
        """The study of a table. Raises InvalidInput naming the table, the place and what is allowed.

        c1, c2, reference : constants of WLF, where they are known
        stated : what differs of the table from the documented form, see `scene.files.stated.TableFormat`
        """
        try:
            tolerance = argument("tolerance", tolerance, BARE.value)
            if not 0 <= tolerance <= WIDEST:
                raise ValueError(f"tolerance = {tolerance:g}: it must lie between 0 and {WIDEST:g}")
        except ValueError as error:
            raise InvalidInput(str(error)) from error
        friction, constants = MeasuredFriction.of(table, **stated), Constants(c1, c2, reference)
        if constants.given and "temperature" not in friction.data:
            raise InvalidInput(
                f"{friction.name}: {', '.join(constants.given)} ask for a column of temperature, as T [degC]"
            )
        study = cls(friction, tolerance, constants)
        try:
            study.collapse  # noqa: B018
        except InvalidInput:
            raise
        except ValueError as error:
            message, name = str(error), brief(friction.source)
            raise InvalidInput(message if message.startswith(name) else f"{name}: {message}") from error
        return study

    @property
    def title(self) -> str:  # type: ignore[override]
        return f"Friction of {self.friction.name} on one curve"

    @property
    def inputs(self) -> Mapping[str, Any]:
        return {"table": self.friction.source, "tolerance": self.tolerance, **self.constants.given}

    @property
    def data(self) -> xarray.Dataset:
        """The table as a Dataset with a measurement a row."""
        return self.friction.data

    @cached_property
    def pooled(self) -> Pooled:
        """Measurements as points."""
        data = self.data
        warmth = data["temperature"].values if "temperature" in data else None
        friction, load, speed = (data[name].values for name in ("friction_coefficient", "normal_force", "speed"))
        found = pooled(friction, load, speed, warmth, self.tolerance)
        check(found)
        return found

    @cached_property
    def shifts(self) -> TemperatureShifts | None:
        """Shifts of temperatures along the speed; None where there are fewer than two temperatures."""
        return temperatures.shifts_of(self.pooled, self.constants)

    @cached_property
    def collapse(self) -> Collapse:
        """Shifts of the curves."""
        return collapse(curves_of(self.pooled, self.shifts))

    def batches(self) -> Sequence[Batch]:
        return ()

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        return xarray.DataTree.from_dict({f"/{MEASURED}": self.data})

    @cached_property
    def lead(self) -> Alignment:
        """Alignment that is the answer: by both shifts where friction itself is shifted, else along the load."""
        return self.collapse.both if eq23.needs_vertical_shift(self.collapse) else self.collapse.horizontal

    def judge(self, answers: xarray.DataTree) -> Judgement:
        findings = self._findings()
        tables: list[Block] = [Findings(findings)]
        caption = "Natural logarithms of the shifts, with intervals of 95 %."
        shifts = self.collapse.shifts(self.lead)
        if self.shifts is not None:
            first = [own.iloc[0] for own in in_order(self.pooled, self.shifts)]
            warm = DataFrame(first, columns=[*CURVE]).reset_index(drop=True)  # in the order of the collapse
            shifts = warm.join(shifts.rename(columns={"speed": "reduced_speed"}))
            tables.append(Table("time-shifts", shifts_table(self.shifts), caption))
        tables.append(Table("shifts", shifts, caption))
        return Judgement(findings, self._answer(findings), [*self._plots(findings), *tables], self.setting)

    def _findings(self):
        """Whether horizontal shifts suffice, or vertical ones are needed, the exponents of both; temperatures."""
        found = self.collapse
        warm = list(temperatures.findings(self.shifts, self.friction.name)) if self.shifts else []
        raw = {
            eq23.COLLAPSE.id: found.horizontal.rms,
            eq23.UNSHIFTED.id: found.unshifted.rms,
            eq23.VERTICAL_ALONE.id: found.vertical.rms,
        }
        findings = []
        for each in eq23.findings(found, None, MEASURED, every=True, where=self.friction.name, draws=0):
            name, sentence = CLAIMS[each.claim.id]
            if each.claim.id in EXPONENTS and (why := temperatures.unshifted(self.shifts, warm)):
                each = replace(each, value=nan, scatter=(nan, nan), reason=why)
            elif not isfinite(found.scatter):
                known = each.value if each.claim is eq23.ALONE else raw.get(each.claim.id, nan)
                each = replace(each, value=known, reason=NOT_REPEATED)
            findings.append(replace(each, claim=replace(each.claim, id=name, sentence=sentence)))
        return [*findings, *warm]

    def _answer(self, findings):
        """Sentences on claims, and on the exponents of the fit that is the answer."""
        both = self.lead is self.collapse.both
        powers = {CLAIMS[claim.id][0] for claim in (eq23.ALONE, *(eq23.JOINT, eq23.NOT_SHIFTED)[: 2 * both])}
        return sentences([each for each in findings if each.verdict != REPORTED or each.claim.id in powers])

    @property
    def notes(self) -> tuple[str, ...]:
        """Lines on what the table has and the study does not use."""
        if "temperature" not in self.data or self.shifts is not None:
            return self.friction.notes
        return (*self.friction.notes, temperatures.ONE.format(self.pooled.points["temperature"].iloc[0]))

    def _plots(self, findings):
        named = {each.claim.id: each for each in findings}
        own = {claim: named[name] for claim, (name, _) in CLAIMS.items() if name in named}
        shown = collapsed.ShiftedCurves(self.friction.name, self.collapse, own, lead=self.lead)
        speed = "speed" if self.shifts is None else "speed times $a_T$"
        plots = [collapsed.plot([shown], speed=speed)]
        if self.shifts is not None:
            tables = points_table(self.pooled, self.shifts), shifts_table(self.shifts)
            plots.append(temperature_shifts.plot(*tables, "found" if self.shifts.found else "stated"))
        return [each for each in plots if each]

    @property
    def setting(self) -> Sequence[Block]:
        """Number and range of the measurements, and what counts as one point."""
        loads, speeds = self.data["normal_force"].values, self.data["speed"].values
        reach = [f"{each.min():.3g} to {each.max():.3g}" for each in (speeds, loads)]
        points = self.pooled.points
        counts = (
            f"{loads.size} measurements of {len(points)} points at {len(self.collapse.speeds)} speeds from "
            f"{self.friction.source}: speeds of {reach[0]} m/s, loads of {reach[1]} N."
        )
        if not self.tolerance:
            return [Text(f"{counts} Only equal loads and speeds are one.")]
        warm = f", temperatures within {WARMTH:g} K" if "temperature" in self.data else ""
        return [
            Text(
                f"{counts} Loads that differ by less than {100 * self.tolerance:.3g} % count as equal, and so do "
                "speeds"
                f"{warm}: the mean of each point and its friction there count."
            )
        ]
