"""Measured moduli as numbers: over the frequency, or over the time of relaxation or creep."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, Any

import numpy as np
from pydantic import model_validator
from pydantic.dataclasses import dataclass

from ..quantities import CLOSED, COMPLIANCE, MODULUS, ROW, SECOND, AbsoluteTemperature, Positive, Unit

MOST_ROWS = 5_000
_LEAST, _LEAST_OF_SEVERAL, _WIDEST = 4, 2, 1e40
SCATTER = 1.0  # [K] within which temperatures are one
FORMS = ("frequency", "storage", "loss"), ("time", "modulus"), ("time", "compliance")
Frequencies = Annotated[tuple[Annotated[Positive, Unit("frequency_unit")], ...], ROW]
Moduli = Annotated[tuple[Annotated[Positive, MODULUS], ...], ROW]
Compliances = Annotated[tuple[Annotated[Positive, COMPLIANCE], ...], ROW]
Times = Annotated[tuple[Annotated[Positive, SECOND], ...], ROW]
Temperatures = Annotated[tuple[AbsoluteTemperature, ...], ROW]


@dataclass(frozen=True, config=CLOSED, repr=False)
class Table:
    """Measured moduli in one of three forms: columns of equally many numbers, all > 0.

    frequency, storage, loss : storage and loss modulus over the frequency
    time, modulus : relaxation modulus [Pa] at times [s] after a sudden strain
    time, compliance : creep compliance [1/Pa] at times [s] after a sudden stress
    temperature : of each row [K]; absent where it is not known

    At least 4 frequencies or times, 2 at several temperatures, and at most 5,000 rows over 40 decades of them, in
    any order; one may stand there more than once, and then each of its rows counts. `notes` say what was read
    besides the columns and is not used; they are no part of what is compared or stored.
    """

    frequency: Frequencies | None = None
    storage: Moduli | None = None
    loss: Moduli | None = None
    time: Times | None = None
    modulus: Moduli | None = None
    compliance: Compliances | None = None
    temperature: Temperatures | None = None

    @property
    def form(self) -> tuple[str, ...]:
        """Names of the columns, one of `FORMS`; of a table over time the last one says which."""
        return tuple(name for name in dict.fromkeys(sum(FORMS, ())) if getattr(self, name) is not None)

    @property
    def over_time(self) -> bool:
        """Whether it is a table of relaxation or creep."""
        return self.time is not None

    @property
    def places(self) -> np.ndarray:
        """Frequencies or times (rows,)."""
        return np.array(getattr(self, self.form[0]))

    @property
    def several(self) -> bool:
        """Whether there are several temperatures: they lie farther apart than an oven scatters, 1 K."""
        given = self.temperature
        return given is not None and max(given) - min(given) > SCATTER

    @property
    def notes(self) -> tuple[str, ...]:
        """Lines on what was read besides the columns."""
        return self.__dict__.get("_notes", ())

    def noted(self, notes: Sequence[str]) -> "Table":
        """The table with such notes."""
        object.__setattr__(self, "_notes", tuple(notes))
        return self

    def shifted(self, longer: np.ndarray, stiffer: np.ndarray) -> "Table":
        """The rows at one temperature, at which times are shorter and moduli lower by these factors (rows,)."""
        changed: dict[str, Any] = {"temperature": None}
        for name in self.form:
            by = longer if name == self.form[0] else stiffer
            numbers = np.array(getattr(self, name))
            changed[name] = numbers * by if name in ("frequency", "compliance") else numbers / by
        return replace(self, **changed).noted(self.notes)

    @model_validator(mode="after")
    def _sound(self):
        if self.form not in FORMS:
            forms = "; or ".join(", ".join(form) for form in FORMS)
            raise ValueError(f"a table of {', '.join(self.form) or 'nothing'}: give {forms}")
        many = "times" if self.over_time else "frequencies"
        columns = (*self.form, *(["temperature"] if self.temperature is not None else []))
        lengths = [len(getattr(self, name)) for name in columns]
        if len(set(lengths)) > 1:
            raise ValueError(f"{', '.join(columns)} have {lengths} values: they must be equally many")
        if lengths[0] > MOST_ROWS:
            raise ValueError(f"{lengths[0]:,} rows: at most {MOST_ROWS:,} are fitted")
        places = set(self.places.tolist())
        least = _LEAST_OF_SEVERAL if self.several else _LEAST  # temperatures, which spread them
        if len(places) < least:
            raise ValueError(f"{len(places)} {many}: at least {least} are needed")
        if max(places) > _WIDEST * min(places):
            raise ValueError(f"{many} lie farther apart than by a factor of {_WIDEST:g}")
        return self

    def __repr__(self):
        return f"Table({len(self.places)} rows from {self.places.min():g} to {self.places.max():g})"
