"""How the indenter moves: to rest, sliding steadily, sheared or by a program, and what presses it."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from .quantities import CLOSED, NonNegative, Positive

UNITS = {"load": "N", "depth": "m", "line_load": "N/m", "pressure": "Pa", "gap": "m"}


class _Pressed:
    """What presses the indenter: exactly one of `UNITS`."""

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

    load: Positive | None = None
    depth: Positive | None = None
    line_load: Positive | None = None
    pressure: Positive | None = None
    gap: Positive | None = None
    type: Literal["indent"] = Field(default="indent", repr=False)

    @property
    def speed(self) -> float:
        return 0.0


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Slide(_Pressed):
    """Steady sliding at a speed [m/s] >= 0, pressed in as in `Indent`."""

    speed: NonNegative
    load: Positive | None = None
    depth: Positive | None = None
    line_load: Positive | None = None
    pressure: Positive | None = None
    gap: Positive | None = None
    type: Literal["slide"] = Field(default="slide", repr=False)


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Shear(_Pressed):
    """Pressed in and held as in `Indent`, then drawn slowly along the surface against friction in the interface.

    displacement : of the indenter [m], from where it was pressed in, or
    force : tangential [N], less than what makes it slide; per length of a cylinder [N/m], on one cell of a plane
    """

    displacement: NonNegative | None = None
    force: NonNegative | None = None
    load: Positive | None = None
    depth: Positive | None = None
    line_load: Positive | None = None
    pressure: Positive | None = None
    gap: Positive | None = None
    type: Literal["shear"] = Field(default="shear", repr=False)

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
    """One stage of a program: a duration [s] at a constant speed [m/s].

    load [N], depth [m], line_load [N/m] or pressure [Pa] at the end of the stage, ramped linearly from that at its
    start; absent, it is held.
    """

    duration: Positive
    speed: NonNegative = 0.0
    load: NonNegative | None = None
    depth: NonNegative | None = None
    line_load: NonNegative | None = None
    pressure: NonNegative | None = None

    @property
    def given(self) -> dict[str, float]:
        """What the stage prescribes, name -> value at its end."""
        values = {name: getattr(self, name, None) for name in UNITS}
        return {name: value for name, value in values.items() if value is not None}


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Program:
    """A history in time: stages one after the other, from zero load or depth on an undisturbed elastomer.

    One quantity is prescribed throughout. Surfaces separate at zero load, and where the indenter is lifted faster
    than the elastomer recovers. A mean gap has no zero to start from: a Plane is pressed by its pressure.
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

    @property
    def pressed_by(self) -> str:
        """Name of what is prescribed, one of `UNITS`."""
        return next(name for stage in self.stages for name in stage.given)

    @property
    def greatest(self) -> float:
        """The greatest value prescribed, in its unit."""
        return max(value for stage in self.stages for value in stage.given.values())

    @property
    def held(self) -> Indent:
        """The greatest load or depth held for ever."""
        return Indent(**{self.pressed_by: self.greatest})

    @property
    def duration(self) -> float:
        """Of all stages [s]."""
        return float(self._times[-1])

    @property
    def length(self) -> float:
        """Slid in all stages [m]."""
        return float(self._paths[-1])

    def prescribed(self, time):
        """Load, depth or pressure at a time [s], any shape, in its unit."""
        values = [0.0]
        for stage in self.stages:
            values.append(stage.given.get(self.pressed_by, values[-1]))
        return np.interp(time, self._times, values)

    def path(self, time):
        """Length slid [m] until a time [s], any shape."""
        return np.interp(time, self._times, self._paths)

    @property
    def turns(self) -> frozenset[float]:
        """Times [s] at which one stage follows another."""
        return frozenset(float(time) for time in self._times[1:-1])

    @property
    def _times(self):
        return np.cumsum([0.0, *(stage.duration for stage in self.stages)])

    @property
    def _paths(self):
        return np.cumsum([0.0, *(stage.speed * stage.duration for stage in self.stages)])


Motion = Annotated[Indent | Slide | Shear | Program, Field(discriminator="type")]
