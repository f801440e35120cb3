"""Tables of measured friction at several temperatures, and of its shifts along the speed."""

import numpy as np
from pandas import DataFrame, concat

from ...statistics.intervals import student
from .pooling import Pooled
from .shiftlaws import ShiftLaw
from .temperatureshifts import TemperatureShifts


def points_table(pooled: Pooled, shifts: TemperatureShifts) -> DataFrame:
    """Every point with the speed to which its temperature shifts it, and the mean load of its curve."""
    names = {
        "temperature": "temperature",
        "speed": "speed",
        "load": "normal_force",
        "friction": "friction_coefficient",
    }
    frame = DataFrame({name: [getattr(each, of) for each in pooled.points] for of, name in names.items()})
    by = dict(zip(shifts.temperatures.tolist(), shifts.shifts.value.tolist(), strict=True))
    frame.insert(2, "reduced_speed", frame["speed"] * np.exp(frame["temperature"].map(by)))
    frame.insert(3, "load", frame.groupby(pooled.presses)["normal_force"].transform("mean"))
    width = np.array([pooled.error(each) for each in pooled.points]) * student(0.95, pooled.dof)
    for end, by_end in (("low", -width), ("high", width)):
        frame[f"friction_coefficient_{end}"] = frame["friction_coefficient"] * np.exp(by_end)
    return frame.sort_values(["load", "temperature", "speed"])


def shifts_table(shifts: TemperatureShifts) -> DataFrame:
    """Shift ln a_T of each temperature with its interval of 95 %."""
    low, high = shifts.shifts.interval()
    names = ("temperature", "log_time_shift", "log_time_shift_low", "log_time_shift_high")
    return DataFrame(dict(zip(names, (shifts.temperatures, shifts.shifts.value, low, high), strict=True)))


def laws_table(shifts: TemperatureShifts, law: ShiftLaw | None) -> DataFrame:
    """The laws that found shifts allow, on lines."""
    kelvins = np.linspace(shifts.temperatures[0], shifts.temperatures[-1], 101)
    names = () if law is None else law.allowed
    found = [
        DataFrame({"law": each, "temperature": kelvins, "log_time_shift": law.log_shift(kelvins, each)})
        for each in names
    ]
    return concat(found) if found else DataFrame(columns=["law", "temperature", "log_time_shift"])
