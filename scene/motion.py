"""Motions of the indenter: to rest, sliding steadily, sheared or by a program, under a load or to a depth."""

from dataclasses import dataclass as plain
from functools import cached_property
from math import acos, floor, pi
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, ValidationInfo, field_validator, model_validator
from pydantic.dataclasses import dataclass

from .quantities import (
    CLOSED,
    METRE,
    NEWTON,
    NEWTON_PER_METRE,
    PASCAL,
    Force,
    ForceOrZero,
    Frequency,
    Length,
    LengthOrZero,
    LineLoad,
    LineLoadOrZero,
    NonNegative,
    Pressure,
    PressureOrZero,
    SpeedOrZero,
    Time,
    Unit,
    Velocity,
)

ROUNDING = 1e-12  # of the half periods that have passed: what is closer to a whole number of them is at zero


@plain(frozen=True)
class Oscillation:
    """amplitude * sin(2 pi frequency t), from t = 0 to a duration.

    amplitude > 0, in the unit of what oscillates; frequency [Hz]; duration [s]
    """

    amplitude: float
    frequency: float
    duration: float

    @property
    def periods(self) -> float:
        """Number of periods in the duration; any number."""
        return self.frequency * self.duration

    @property
    def last(self) -> float:
        """Value at the end."""
        return float(self.at(self.duration))

    def at(self, time):
        """Values at times [s], any shape; exactly zero after whole half periods."""
        halves = 2 * self.frequency * np.asarray(time, float)
        nearest = np.rint(halves)
        beyond = halves - nearest
        beyond = np.where(np.abs(beyond) <= ROUNDING * np.maximum(nearest, 1.0), 0.0, beyond)
        return self.amplitude * np.where(nearest % 2 == 0, 1.0, -1.0) * np.sin(pi * beyond)

    def beyond_chord(self, time):
        """Values at times [s] less the chord from the start to the end; zero before and after the duration."""
        within = np.clip(time, 0.0, self.duration)
        return self.at(within) - self.last * within / self.duration

    def about(self, start: float, end: float) -> tuple[float, float]:
        """Lowest and highest value of the oscillation on a ramp from `start` to `end`.

        Ends of the duration, and where the slopes of both cancel: on a ramp that does not outrun the oscillation,
        the first and the last crest and trough of those.
        """
        omega, rise = 2 * pi * self.frequency, (end - start) / self.duration
        values = [start, end + self.last]
        steepest = self.amplitude * omega
        if abs(rise) < steepest:
            crest = acos(-rise / steepest)
            for first in (crest, 2 * pi - crest):
                last = first + 2 * pi * floor(self.periods - first / (2 * pi))
                values += [
                    start + rise * phase / omega + float(self.at(phase / omega))
                    for phase in (first, last)
                    if last >= first
                ]
        return min(values), max(values)


PRESSES = {"load": NEWTON, "depth": METRE, "line_load": NEWTON_PER_METRE, "pressure": PASCAL, "gap": METRE}
UNITS = {name: unit.symbol for name, unit in PRESSES.items()}

OF_WHAT_PRESSES = Unit("the unit of what presses, stated in this stage for a string", example="0.3 N")
TANGENTIAL = Unit("N, or N/m of a cylinder", example="0.3 N")


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class _Pressed:
    """Load or depth of the indenter: exactly one of `UNITS`."""

    load: Force | None = None
    depth: Length | None = None
    line_load: LineLoad | None = None
    pressure: Pressure | None = None
    gap: Length | None = None

    @model_validator(mode="after")
    def _exactly_one(self):
        given = [name for name in UNITS if getattr(self, name) is not None]
        if len(given) != 1:
            stated = ", ".join(f"{name} = {getattr(self, name):g}" for name in given) or "none given"
            units = ", ".join(f"{name} [{unit}]" for name, unit in UNITS.items())
            raise ValueError(f"{stated}: give exactly one of {units}")
        return self

    @property
    def pressed_by(self) -> str:
        """Name of what is prescribed, one of `UNITS`."""
        return next(name for name in UNITS if getattr(self, name) is not None)

    @property
    def greatest(self) -> float:
        """The value prescribed, in its unit."""
        return getattr(self, self.pressed_by)


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Indent(_Pressed):
    """Pressed in and held until the elastomer has relaxed: its equilibrium modulus alone counts.

    load [N] or depth [m] of a body of revolution, line_load [N/m] of a cylinder, mean pressure [Pa] or mean
    gap [m] of a plane: one of them.
    """

    type: Literal["indent"] = Field(default="indent", repr=False)

    @property
    def speed(self) -> float:
        return 0.0


def pressed(by: str, value: float) -> Indent:
    """Motion to rest under a value of the named quantity, one of `UNITS`."""
    given: dict[str, Any] = {by: value}
    return Indent(**given)


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Slide(_Pressed):
    """Steady sliding at a speed [m/s] >= 0, pressed in as in `Indent`.

    A speed of zero is the limit of slower and slower sliding: the elastomer loses nothing and nothing is heated,
    and an interface with friction slips.
    """

    speed: SpeedOrZero
    type: Literal["slide"] = Field(default="slide", repr=False)


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Shear(_Pressed):
    """Pressed in and held as in `Indent`, then drawn slowly along the surface against friction in the interface.

    displacement : of the indenter [m], from where it was pressed in, or
    force : tangential [N], less than coefficient * F_N; per length of a cylinder [N/m], on one cell of a plane
    """

    displacement: LengthOrZero | None = None
    force: Annotated[NonNegative, TANGENTIAL] | None = None
    type: Literal["shear"] = Field(default="shear", repr=False)

    @field_validator("force", mode="before")
    @classmethod
    def _force_in_its_unit(cls, force, info: ValidationInfo):
        across = info.data.get("line_load") is not None
        return None if force is None else (NEWTON_PER_METRE if across else NEWTON).value(force)

    @model_validator(mode="after")
    def _drawn_by_one(self):
        if (self.displacement is None) == (self.force is None):
            given = "none given" if self.force is None else "both given"
            raise ValueError(f"displacement, force: {given}, give exactly one of displacement [m], force [N]")
        return self

    @property
    def speed(self) -> float:
        return 0.0


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Stage:
    """One stage of a program: a duration [s] at a constant speed [m/s], backwards where that is below zero.

    load [N], depth [m], line_load [N/m] or pressure [Pa] at the end of the stage, ramped linearly from that at its
    start; absent, it is held.
    amplitude, in the same unit, and frequency [Hz], both or none: amplitude * sin(2 pi frequency t) is added from
    the start of the stage on, for any number of periods; the next one starts from what is reached. Written with a
    unit it needs what presses stated in the same stage.
    """

    duration: Time
    speed: Velocity = 0.0
    load: ForceOrZero | None = None
    depth: LengthOrZero | None = None
    line_load: LineLoadOrZero | None = None
    pressure: PressureOrZero | None = None
    amplitude: Annotated[NonNegative, OF_WHAT_PRESSES] | None = None
    frequency: Frequency | None = None

    @field_validator("amplitude", mode="before")
    @classmethod
    def _amplitude_in_its_unit(cls, amplitude, info: ValidationInfo):
        pressing = [unit for name, unit in PRESSES.items() if info.data.get(name) is not None]
        return pressing[0].value(amplitude) if pressing and amplitude is not None else amplitude

    @model_validator(mode="after")
    def _swings_at_a_frequency(self):
        if (self.amplitude is None) != (self.frequency is None):
            given = "amplitude" if self.frequency is None else f"frequency = {self.frequency:g} Hz"
            raise ValueError(f"{given} alone: an oscillation has an amplitude and a frequency [Hz], give both")
        # Its angles, and those of a second, have to be numbers.
        if self.frequency is not None and not np.isfinite(2 * np.pi * self.frequency * max(self.duration, 1.0)):
            raise ValueError(
                f"frequency = {self.frequency:g} Hz over duration = {self.duration:g} s: more periods than can be "
                "counted, give less of either"
            )
        return self

    @property
    def given(self) -> dict[str, float]:
        """Quantities that the stage prescribes, name -> value at its end."""
        values = {name: getattr(self, name, None) for name in UNITS}
        return {name: value for name, value in values.items() if value is not None}

    @property
    def oscillation(self) -> Oscillation | None:
        """Oscillation that is added to the ramp; None without an amplitude."""
        amplitude, frequency = self.amplitude, self.frequency
        return Oscillation(amplitude, frequency, self.duration) if amplitude and frequency else None


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Program:
    """A history in time: stages one after the other, from zero load or depth on an undisturbed elastomer.

    One quantity is prescribed throughout, never below zero. Surfaces separate at zero load, and where the indenter
    is lifted faster than the elastomer recovers. A mean gap has no zero to start from: a Plane is pressed by its
    pressure.

    >>> from scene import Program, Stage
    >>> program = Program(stages=(Stage(duration=1.0, load=2.0), Stage(duration=3.0, speed=-0.1)))
    >>> print(f"{program.prescribed(0.5):g} N, {program.path(3.5):g} m, {program.reverses}")
    1 N, -0.25 m, True
    """

    stages: Annotated[tuple[Stage, ...], Field(min_length=1)]
    type: Literal["program"] = Field(default="program", repr=False)

    @model_validator(mode="after")
    def _one_quantity(self):
        names = list(dict.fromkeys(name for stage in self.stages for name in stage.given))
        if len(names) > 1:
            raise ValueError(f"stages prescribe {' and '.join(names)}: give one and the same throughout")
        if not names or self.greatest == 0:
            units = ", ".join(f"{name} [{UNITS[name]}]" for name in UNITS if hasattr(Stage, name))
            raise ValueError(f"stages press nowhere: give one of {units}, above zero in one stage at least")
        return self

    @model_validator(mode="after")
    def _never_below_zero(self):
        unit = UNITS[self.pressed_by]
        for k, lowest, _ in self._swings:
            amplitude = self.stages[k].amplitude
            if lowest < -ROUNDING * amplitude:
                raise ValueError(
                    f"stages[{k}].amplitude = {amplitude:g} {unit} takes the {self.pressed_by} down to "
                    f"{lowest:g} {unit}: give less of it, or a greater {self.pressed_by} to oscillate about"
                )
        return self

    @property
    def pressed_by(self) -> str:
        """Name of what is prescribed, one of `UNITS`."""
        return next(name for stage in self.stages for name in stage.given)

    @property
    def greatest(self) -> float:
        """The greatest value prescribed, crests of oscillations among them, in its unit."""
        crests = [highest for _, _, highest in self._swings]
        return max(crests + [value for stage in self.stages for value in stage.given.values()])

    @property
    def held(self) -> Indent:
        """The greatest load or depth held for ever."""
        return pressed(self.pressed_by, self.greatest)

    @property
    def duration(self) -> float:
        """Duration of all stages [s]."""
        return float(self._times[-1])

    @property
    def length(self) -> float:
        """Slid in all stages, forwards and backwards [m]."""
        return float(np.cumsum([abs(stage.speed) * stage.duration for stage in self.stages])[-1])

    @property
    def span(self) -> float:
        """Between the farthest places forwards and backwards that the path comes to [m]."""
        return float(np.max(self._paths) - np.min(self._paths))

    @property
    def reverses(self) -> bool:
        """Whether the indenter ever moves backwards."""
        return any(stage.speed < 0 for stage in self.stages)

    def prescribed(self, time):
        """Load, depth or pressure at a time [s], any shape, in its unit."""
        times = self._times
        values = np.interp(time, times, self._levels)
        for stage, begin in zip(self.stages, times, strict=False):
            if stage.oscillation is not None:
                values = np.maximum(values + stage.oscillation.beyond_chord(np.subtract(time, begin)), 0.0)
        return values

    def path(self, time):
        """Path of the indenter forwards from its start [m] at a time [s], any shape."""
        return np.interp(time, self._times, self._paths)

    @property
    def turns(self) -> frozenset[float]:
        """Times [s] at which one stage follows another."""
        return frozenset(float(time) for time in self._times[1:-1])

    # Thousands of stages ask for these each.
    @cached_property
    def _times(self):
        return np.cumsum([0.0, *(stage.duration for stage in self.stages)])

    @cached_property
    def _paths(self):
        return np.cumsum([0.0, *(stage.speed * stage.duration for stage in self.stages)])

    @cached_property
    def _levels(self):
        """Prescribed load or depth at `_times`."""
        levels = [0.0]
        for stage in self.stages:
            end = stage.given.get(self.pressed_by, levels[-1])
            levels.append(end if stage.oscillation is None else max(end + stage.oscillation.last, 0.0))
        return levels

    @property
    def _swings(self):
        """Place of each stage that oscillates, with its lowest and highest value."""
        starts = self._levels[:-1]
        return [
            (k, *stage.oscillation.about(start, stage.given.get(self.pressed_by, start)))
            for k, (stage, start) in enumerate(zip(self.stages, starts, strict=True))
            if stage.oscillation is not None
        ]


Motion = Annotated[Indent | Slide | Shear | Program, Field(discriminator="type")]
