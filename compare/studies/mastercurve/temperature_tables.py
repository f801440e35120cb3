"""Tables of measured friction at several temperatures, and of its shifts along the speed."""

import numpy as np
from pandas import DataFrame, Series, concat

from ...statistics.intervals import student
from .pooling import Pooled
from .shiftlaws import ShiftLaw
from .temperatureshifts import TemperatureShifts


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


def laws_table(shifts: TemperatureShifts, law: ShiftLaw | None) -> DataFrame:
    """The laws that found shifts allow, on lines."""
    kelvins = np.linspace(shifts.temperatures[0], shifts.temperatures[-1], 101)
    names = () if law is None else law.allowed
    found = [
        DataFrame({"law": each, "temperature": kelvins, "log_time_shift": law.log_shift(kelvins, each)})
        for each in names
    ]
    return concat(found) if found else DataFrame(columns=["law", "temperature", "log_time_shift"])
