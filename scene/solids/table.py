"""Measured moduli as numbers: over the frequency, or over the time of relaxation or creep."""

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self

import numpy as np
from pydantic import Discriminator, Tag, model_validator
from pydantic.dataclasses import dataclass

from ..files.reading import CHOICE
from ..quantities import CLOSED, COMPLIANCE, MODULUS, ROW, SECOND, AbsoluteTemperature, Positive, Unit

MOST_ROWS = 5_000
_LEAST, _LEAST_OF_SEVERAL, _WIDEST = 4, 2, 1e40
SCATTER = 1.0  # [K] within which temperatures are one
Frequencies = Annotated[tuple[Annotated[Positive, Unit("frequency_unit")], ...], ROW]
Moduli = Annotated[tuple[Annotated[Positive, MODULUS], ...], ROW]
Compliances = Annotated[tuple[Annotated[Positive, COMPLIANCE], ...], ROW]
Times = Annotated[tuple[Annotated[Positive, SECOND], ...], ROW]
Temperatures = Annotated[tuple[AbsoluteTemperature, ...], ROW]


class _Rows:
    """Rows of numbers, the first of which says where.

    notes : what was read beside them and is not used; no field, and no part of what is compared or stored
    """

    PLACE: ClassVar[tuple[str, str]]  # its field, and more of them
    notes: Sequence[str] = ()

    if TYPE_CHECKING:
        temperature: tuple[float, ...] | None

    @property
    def places(self) -> np.ndarray:
        """Frequencies or times (rows,)."""
        return np.array(getattr(self, self.PLACE[0]))

    @property
    def several(self) -> bool:
        """Whether there are several temperatures: they lie farther apart than an oven scatters, 1 K."""
        given = self.temperature
        return given is not None and max(given) - min(given) > SCATTER

    def noted(self, notes: Sequence[str]) -> Self:
        """The table with such notes."""
        object.__setattr__(self, "notes", tuple(notes))
        return self

    def shifted(self, longer: np.ndarray, stiffer: np.ndarray) -> Self:
        """The rows at one temperature, at which times are shorter and moduli lower by these factors (rows,)."""
        name = self.PLACE[0]
        changed: dict[str, Any] = {"temperature": None}
        names = [each.name for each in fields(self)]  # type: ignore[arg-type]
        for field in (each for each in names if each != "temperature"):
            numbers = np.array(getattr(self, field))
            by = longer if field == name else stiffer
            numbers = numbers * by if field in ("frequency", "compliance") else numbers / by
            changed[field] = tuple(numbers.tolist())
        return replace(self, **changed).noted(self.notes)  # type: ignore[type-var]

    def _check(self):
        name, many = self.PLACE
        columns = [each.name for each in fields(self) if each.name != "temperature"]
        lengths = [len(getattr(self, each)) for each in columns]
        if len(set(lengths)) > 1:
            named = f"{', '.join(columns[:-1])} and {columns[-1]}"
            raise ValueError(f"{named} have {lengths} values: they must be equally many")
        if self.temperature is not None and len(self.temperature) != lengths[0]:
            raise ValueError(f"temperature has {len(self.temperature)} values, {name} has {lengths[0]}: one each")
        if lengths[0] > MOST_ROWS:
            raise ValueError(f"{lengths[0]:,} rows: at most {MOST_ROWS:,} are fitted")
        places = getattr(self, name)
        if max(places, default=0.0) > _WIDEST * min(places, default=0.0):
            raise ValueError(f"{many} lie farther apart than by a factor of {_WIDEST:g}")
        least = _LEAST_OF_SEVERAL if self.several else _LEAST  # temperatures, which spread them
        if (count := len(set(places))) < least:
            raise ValueError(f"{count} {many}: at least {least} are needed")
        return self

    def __repr__(self):
        places = getattr(self, self.PLACE[0])
        return f"{type(self).__name__}({len(places)} rows from {min(places):g} to {max(places):g})"


@dataclass(frozen=True, config=CLOSED, repr=False)
class Table(_Rows):
    """Measured moduli: frequency, storage and loss modulus, equally many, all > 0; at least 4 frequencies.

    At most 5,000 rows, over 40 decades of the frequency.

    In any order; a frequency may stand there more than once, and then each of its rows counts.

    temperature : of each row [K]; absent where it is not known
    """

    PLACE = "frequency", "frequencies"

    frequency: Frequencies
    storage: Moduli
    loss: Moduli
    temperature: Temperatures | None = None

    _sound = model_validator(mode="after")(_Rows._check)


@dataclass(frozen=True, config=CLOSED, repr=False)
class RelaxationTable(_Rows):
    """Measured relaxation modulus: time [s] after a sudden strain and modulus [Pa], as many as in `Table`.

    temperature : of each row [K]; absent where it is not known
    """

    PLACE = "time", "times"

    time: Times
    modulus: Moduli
    temperature: Temperatures | None = None

    _sound = model_validator(mode="after")(_Rows._check)


@dataclass(frozen=True, config=CLOSED, repr=False)
class CreepTable(_Rows):
    """Measured creep compliance: time [s] after a sudden stress and compliance [1/Pa], as many as in `Table`.

    temperature : of each row [K]; absent where it is not known
    """

    PLACE = "time", "times"

    time: Times
    compliance: Compliances
    temperature: Temperatures | None = None

    _sound = model_validator(mode="after")(_Rows._check)


def _kind(given):
    """Tag of the kind of table that is given, by the names of its numbers."""
    held = (
        given if isinstance(given, Mapping) else {name: 0 for name in getattr(given, "__dataclass_fields__", ())}
    )
    named = (each for each in (CreepTable, RelaxationTable) if fields(each)[1].name in held)
    return CHOICE + next(named, Table).__name__


AnyTable = Annotated[
    Annotated[Table, Tag(f"{CHOICE}Table")]
    | Annotated[RelaxationTable, Tag(f"{CHOICE}RelaxationTable")]
    | Annotated[CreepTable, Tag(f"{CHOICE}CreepTable")],
    Discriminator(_kind),
]
