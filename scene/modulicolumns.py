"""Columns of a table of moduli that were found by their names, and the moduli that they state."""

from dataclasses import dataclass, field

import numpy as np

from . import modulinames as names
from .columns import Chosen, refuse_half_stated
from .modulinames import KINDS, OPEN
from .printable import brief
from .sheet import Sheet

_SAME = 0.1  # of the logarithm, of what columns state twice


@dataclass
class Columns:
    """Columns of one sheet by field, and what is noted of them.

    used : fields of those that were asked for
    """

    sheet: Sheet
    found: dict[str, Chosen]
    notes: list[str]
    used: set[str] = field(default_factory=set)

    @property
    def heading(self) -> str:
        """The heading, for messages."""
        return f"{self.sheet.name}: the heading ({brief(', '.join(self.sheet.names))})"

    def __contains__(self, name: str) -> bool:
        return name in self.found

    def of(self, name: str) -> np.ndarray:
        """Numbers of a field, all > 0, or NaN where nothing was measured. Raises ValueError with the place."""
        column = self.found[name]
        wrong = ~(np.isnan(column.numbers) | ((column.numbers > 0) & np.isfinite(column.numbers)))
        self.refuse(name, wrong, "must be finite and greater than 0")
        self.used.add(name)
        return column.numbers

    def refuse(self, name: str, wrong: np.ndarray, why: str) -> None:
        """Raise ValueError for the first row of a field that is wrong."""
        if wrong.any():
            row, column = int(np.argmax(wrong)), self.found[name].index
            given, where = self.sheet.numbers[row, column], self.sheet.place(row, column)
            raise ValueError(f"{where}: {name} = {given:g} {why}")

    def unused(self) -> list[str]:
        """Notes on columns that are known, and not asked for."""
        return [
            f"{self.sheet.name}: column {each.name!r} is not used"
            for name, each in self.found.items()
            if name not in self.used
        ]

    def has(self, quantity: str) -> bool:
        """Whether there is a column of a quantity of `modulinames.MODULI`."""
        return any(names.modulus(quantity, each).field in self for each in (*KINDS, OPEN))

    def modulus(self, quantity: str, kind: str | None) -> np.ndarray | None:
        """Numbers of a quantity; None where it has no column."""
        fields = [names.modulus(quantity, each).field for each in (kind, OPEN) if each in (*KINDS, OPEN)]
        return next((self.of(name) for name in fields if name in self), None)

    def kind(self, quantities: tuple[str, ...], stated: str | None) -> str | None:
        """Kind of the moduli, as the headings or a field of the solid say; None where neither does."""
        told = [kind for kind in KINDS if any(names.modulus(each, kind).field in self for each in quantities)]
        if stated in KINDS and told and stated not in told:
            raise ValueError(
                f"{self.heading} names moduli of kind {told[0]!r}, and kind = {stated!r} is stated: leave kind "
                "out, or correct the heading"
            )
        if stated not in KINDS and len(told) > 1:
            raise ValueError(
                f"{self.heading} names moduli of both kinds: state kind, {' or '.join(map(repr, told))}"
            )
        return stated if stated in KINDS or not told else told[0]

    def complex_modulus(self, kind: str | None) -> dict[str, np.ndarray]:
        """Storage and loss modulus, however they are stated."""
        storage, loss, size = (self.modulus(each, kind) for each in ("storage", "loss", "magnitude"))
        used = (
            each
            for name, each in self.found.items()
            if name in self.used and name.startswith(("storage", "loss", "magnitude"))
        )
        refuse_half_stated(self.sheet, used)
        whole = storage is not None and loss is not None
        tangent = self._tangent(needed=not whole)
        if storage is not None and loss is not None:
            self._check(tangent, loss / storage)
            return {"storage": storage, "loss": loss}
        if tangent is None or (storage is None and loss is None and size is None):
            raise ValueError(
                f"{self.heading} has no complete modulus: give storage and loss modulus, or one of them or the "
                "complex modulus with tan delta or a phase"
            )
        if storage is not None:
            return {"storage": storage, "loss": storage * tangent}
        if loss is not None:
            return {"storage": loss / tangent, "loss": loss}
        along = size / np.hypot(1.0, tangent)
        return {"storage": along, "loss": along * tangent}

    def _tangent(self, needed):
        """Loss over storage modulus as a column states it; None without one."""
        if names.TAN.field in self:
            return self.of(names.TAN.field)
        name = names.PHASE.field
        if name not in self:
            return None
        phase, column = self.of(name), self.found[name]
        if column.unit is None:
            if needed:
                raise ValueError(f"{self.heading} states no unit of {column.name!r}: write deg or rad behind it")
            return None
        self.refuse(name, phase >= np.pi / 2, "must be below 90 deg")
        return np.tan(phase)

    def _check(self, stated, found):
        if stated is None:
            return
        apart = float(np.nanmedian(np.abs(np.log(found / stated))))
        if apart > _SAME:
            raise ValueError(
                f"{self.heading}: loss over storage modulus is {np.exp(apart):.2g} times off tan delta or the "
                "phase beside them: correct their units, or keep two of them"
            )
