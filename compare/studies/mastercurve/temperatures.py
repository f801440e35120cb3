"""What measured friction at several temperatures says of their shifts along the speed."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from pandas import DataFrame, Series

from scene.effects.temperature import WLF
from scene.files.reading import InvalidInput

from ...statistics import eq23
from ...statistics.finding import FAILS, Claim, Finding
from ...statistics.intervals import student
from .measuredcurves import Pooled, isotherms
from .measurements import COLDEST
from .temperatureshifts import TemperatureShifts, found, stated

TOGETHER = Claim(
    id="mastercurve.temperatures",
    sentence="Shifts along the speed bring the temperatures together",
    expected=0.0,
    tolerance=eq23.TOLERANCE,
    meaning="rms of ln μ about one function of load and shifted speed, without what scatter adds. Each "
    "temperature has one shift along the logarithm of the speed.",
    percent=True,
)
APART = Claim(
    "mastercurve.temperatures-unshifted",
    "Misfit of the temperatures before shifting along the speed",
    percent=True,
)
NOT_TOGETHER = "none, as no shifts along the speed bring the temperatures together"
ONE = "one temperature, {:.4g} K: nothing is shifted along the speed"


@dataclass(frozen=True)
class Constants:
    """Constants of WLF as a user states them; all or none.

    c1, c2, reference : as `scene.WLF` has them, strings with units too
    """

    c1: Any = None
    c2: Any = None
    reference: Any = None

    @property
    def given(self) -> dict[str, Any]:
        """Constants that the user states, by name."""
        return {each.name: value for each in fields(self) if (value := getattr(self, each.name)) is not None}

    def shifts(self, temperatures: np.ndarray) -> np.ndarray:
        """ln a_T at temperatures [K]. Raises InvalidInput."""
        return np.array([self._at(float(each)).log_shift for each in temperatures])

    def _at(self, temperature):
        law = WLF(temperature=temperature, **{name: _bare(value) for name, value in self.given.items()})
        if law.reference < COLDEST:
            raise InvalidInput(f'reference = {law.reference:g} K: is degC meant? Write "{law.reference:g} degC"')
        return law


def _bare(value):
    """A number out of a command line, where it has no unit; anything else as it is."""
    try:
        return float(value) if isinstance(value, str) else value
    except ValueError:
        return value


def shifts_of(pooled: Pooled, constants: Constants) -> TemperatureShifts | None:
    """Shifts of points at several temperatures, stated or found; None at one. Raises ValueError, InvalidInput."""
    each = isotherms(pooled)
    if len(each) < 2:
        return None
    if constants.given:
        shifts = constants.shifts(np.array([one.temperature for one in each]))
        return stated(each, shifts, pooled.loads, pooled.dof)
    return found(each, pooled.loads, pooled.dof)


def findings(shifts: TemperatureShifts, where: str) -> Iterator[Finding]:
    """Whether the temperatures come together, and how far apart they are before."""
    sentence = TOGETHER.sentence if shifts.found else "The stated shifts of WLF bring the temperatures together"
    place: dict[str, Any] = {"where": where, "dimension": "measured"}
    together = replace(TOGETHER, sentence=sentence)
    yield eq23.finding(together, shifts.misfit, reason=shifts.inseparable, **place)
    yield eq23.finding(APART, shifts.unshifted, **place)


def unshifted(shifts: TemperatureShifts | None, findings: Sequence[Finding]) -> str:
    """Reason why temperature shifts no speed and there is no exponent; empty where there is none."""
    if any(each.claim.id == TOGETHER.id and each.verdict == FAILS for each in findings):
        return NOT_TOGETHER
    return shifts.inseparable if shifts else ""


def points_table(pooled: Pooled, shifts: TemperatureShifts) -> DataFrame:
    """Every point with the speed to which its temperature shifts it, and the mean load of its curve."""
    frame = pooled.points.rename(columns={"load": "normal_force", "friction": "friction_coefficient"})
    by = Series(shifts.shifts.value, shifts.temperatures)
    frame["reduced_speed"] = frame["speed"] * np.exp(frame["temperature"].map(by))
    frame["load"] = frame.groupby("press")["normal_force"].transform("mean")
    columns = ["temperature", "speed", "reduced_speed", "load", "normal_force", "friction_coefficient"]
    width = frame["error"] * student(0.95, pooled.dof)
    for end, by_end in (("low", -width), ("high", width)):
        columns.append(f"friction_coefficient_{end}")
        frame[columns[-1]] = frame["friction_coefficient"] * np.exp(by_end)
    return frame[columns].sort_values(["load", "temperature", "speed"])


def shifts_table(shifts: TemperatureShifts) -> DataFrame:
    """Shift ln a_T of each temperature with its interval of 95 %."""
    return DataFrame({"temperature": shifts.temperatures, **shifts.shifts.columns("log_time_shift")})
