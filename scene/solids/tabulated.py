"""A measured solid: the passive one with few modes that follows a table of its moduli best."""

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from math import inf, pi, sqrt
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from ..effects.temperature import TemperatureLaw
from ..files.stated import FORM, TableFormat, alternatives, refused, restated, split_format
from ..numeric_input import bare
from ..quantities import Finite, ShearModulus
from .fit import NEGLIGIBLE, Continued, Creep, Measured, Modes, Oscillation, Stress, fitted, rms
from .modes import Relaxation, Retardation
from .moduli import read_moduli
from .table import SCATTER, Table
from .viscoelastic import YOUNG, PoissonRatio, Solid, in_shear

# Number of standard errors below which a fitted modulus at rest cannot be distinguished from zero.
_SIGNIFICANT = 3
# Standard errors in half an interval of 95 %.
_SURE = 1.96


_OF_A_FILE = alternatives(
    *("frequency_unit", "kind"),
    equilibrium_youngs_modulus=YOUNG,
    table={"anyOf": [{"type": "string"}, {"type": "object"}]},
    **FORM,
)


@dataclass(frozen=True, config=_OF_A_FILE, kw_only=True)
class Tabulated(Solid):
    """Solid of measured moduli, fitted with a Prony series by nonnegative least squares.

    table : a Table; or
        the path of a text file, a DataFrame, a Dataset of xarray, or arrays by the names that columns may have. It
        is read once and kept as numbers; a relative path starts at the folder of a scene file that names it
    columns, units, where, separator, decimal, encoding, skip, rows : what differs of it from the documented form
        of tables, see `stated.TableFormat`
    frequency_unit : "rad/s" or "Hz" (cycles per second), where no heading says so; None over the time
    kind : "shear" for G', G'', G(t), J(t); "tensile" for E', E'', E(t), D(t), where no heading says so;
        E = 2 (1 + poisson_ratio) G, and moduli are in Pa where no heading has another unit
    equilibrium_modulus : shear modulus at rest [Pa] if it is known, else fitted: what does not relax within three
        times the longest time of the table, 1/(lowest angular frequency) or the last
    tolerance : largest root mean square of the relative misfits of all numbers that is accepted
    extrapolate : whether the power law that the loss follows at either end of the table goes on for six decades;
        if not, nothing relaxes beyond the table, which bounds the answer but does not give it

    `error` and `rms_error` say how well the series follows the table. Raises ValueError where a heading
    contradicts a field, if no passive solid follows the table to within the tolerance (in one, G' never falls with
    the frequency and G'' belongs to it), or if the table leaves the modulus at rest open: fitted, it has to be
    three times its standard error, `equilibrium_error`. Where the table ends before the plateau,
    `equilibrium_interval` says how far it is open. A table at several temperatures has modes once the law of the
    shift is known, as in a Scene: see `at_reference`.
    """

    table: Table
    frequency_unit: Literal["rad/s", "Hz"] | None
    kind: Literal["shear", "tensile"]
    equilibrium_modulus: ShearModulus | None = None
    tolerance: Annotated[Finite, Field(gt=0, lt=1)] = 0.1
    extrapolate: Annotated[bool, Field(strict=True)] = False
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["tabulated"] = Field(default="tabulated", repr=False)

    _in_tension = restated(in_shear)

    @restated
    def _read(cls, stated):  # noqa: N805
        if "table" not in stated:
            return stated
        written, found = split_format(stated)
        table = found["table"]
        if written != TableFormat() or not _is_plain(table):
            try:
                # What is no text is for the check of the fields to name.
                words = {name: each for name, each in found.items() if isinstance(each, str)}
                read = read_moduli(table, words.get("frequency_unit"), words.get("kind"), written)
            except ValueError as error:
                raise refused("table", table, error) from error
            found["table"] = table = read.table
            headings = {"frequency_unit": read.frequency_unit, "kind": read.kind}
            found = {name: value for name, value in headings.items() if value is not None} | found
        time = table.get("time") if isinstance(table, Mapping) else getattr(table, "time", None)
        return found if time is None else {"frequency_unit": None} | found

    @model_validator(mode="after")
    def _can_be_fitted(self):
        over_time = self.table.over_time
        if over_time != (self.frequency_unit is None):
            where = "the time: leave frequency_unit out" if over_time else "the frequency: state frequency_unit"
            raise ValueError(f"{self.table!r} is a table over {where}")
        if self.table.several:
            return self
        try:
            with np.errstate(over="raise", divide="raise", invalid="raise"):
                self.modes()
        except (ArithmeticError, RuntimeError) as error:  # RuntimeError of a fit that does not end
            why = f"{self.table!r}: no solid can be fitted ({error}): check units and columns"
            raise ValueError(why) from error
        if self.rms_error > self.tolerance:
            wrong = "that G' does not fall with the frequency"
            if over_time:
                wrong = "that the modulus falls, or the compliance grows, with the time"
            raise ValueError(
                f"{self.table!r}: the best passive solid is off by {self.rms_error:.2g} (relative, root mean "
                f"square), more than tolerance = {self.tolerance:g}: check units and columns, and {wrong}; if "
                "this is the scatter, raise tolerance"
            )
        if _fit(self)[0].equilibrium < _SIGNIFICANT * self.equilibrium_error:
            further = "for longer times" if over_time else "at lower frequencies"
            raise ValueError(
                f"{self.table!r} leaves the modulus at rest open: {self._seen_at_rest()}; state "
                f"equilibrium_modulus, or measure {further}"
            )
        return self

    def _seen_at_rest(self):
        """Sentence on what the table shows of the modulus at rest."""
        rest, error = _fit(self)[0].equilibrium, self.equilibrium_error
        return f"what is fitted is {f'{rest:.2g} Pa +- {error:.2g} Pa' if 0 < error < inf else 'none'}"

    def measured(self) -> tuple[np.ndarray, np.ndarray]:
        """The table in shear: angular frequencies (N,) [rad/s] ascending, and complex moduli (N,) [Pa].

        Over the time, times (N,) [s] ascending, and moduli [Pa] or compliances [1/Pa].
        """
        table, places = self.table, self.table.places
        order = np.argsort(places, kind="stable")
        stiffer = 2 * (1 + self.poisson_ratio) if self.kind == "tensile" else 1.0
        if table.modulus:
            return places[order], np.array(table.modulus)[order] / stiffer
        if table.compliance:
            return places[order], np.array(table.compliance)[order] * stiffer
        cycle = 2 * pi if self.frequency_unit == "Hz" else 1.0
        return cycle * places[order], (np.array(table.storage) + 1j * np.array(table.loss))[order] / stiffer

    @property
    def error(self) -> float:
        """Largest relative misfit of a number of the table."""
        return float(np.abs(_rows(self).misfit(self.modes())).max())

    @property
    def rms_error(self) -> float:
        """Root mean square of the relative misfits of the numbers of the table."""
        return rms(_rows(self).misfit(self.modes()))

    @property
    def equilibrium_error(self) -> float:
        """Standard error of a fitted modulus at rest [Pa]; zero of a known one, infinite where none is seen."""
        return _fit(self)[1]

    @property
    def equilibrium_interval(self) -> tuple[float, float]:
        """Interval of 95 % of the modulus at rest [Pa]; both ends are the known modulus if there is one.

        It holds two readings: a plateau that begins where the table ends, and the law that goes on there.
        """
        if self.equilibrium_modulus is not None:
            return self.equilibrium_modulus, self.equilibrium_modulus
        readings = _fit(self)[0].equilibrium, self.continued.at_rest
        error = _SURE * self.equilibrium_error / readings[0]
        if self.table.over_time:
            # A liquid of so slow modes is far off in a few rows alone, and tells less than the rows of the end.
            times = self.measured()[0]
            scatter = max(rms(_rows(self).misfit(_fit(self)[0])), NEGLIGIBLE)
            error = min(error, _SURE * scatter / sqrt((times > times[-1] / 10).sum()))
        return min(readings) * (1 - error), max(readings) * (1 + error)

    @property
    def frequencies(self) -> tuple[float, float]:
        """Lowest and highest angular frequency of the table [rad/s]; over time, 1/time."""
        ends = self.measured()[0][[0, -1]]
        low, high = 1 / ends[::-1] if self.table.over_time else ends
        return float(low), float(high)

    @property
    def continued(self) -> Continued:
        """The modes that follow the table, and the laws by which they go on beyond it."""
        return _continued(self)

    def modes(self) -> Modes:
        """Modes of the fit, and of its continuation. Raises ValueError of a table at several temperatures."""
        if self.table.several:
            raise ValueError(_no_law(self.table))
        if not self.extrapolate:
            return _fit(self)[0]
        series = _continued(self).series
        over = self.table.compliance and isinstance(series, Relaxation)
        return series.retardation() if over else series

    def at_reference(self, law: TemperatureLaw | None) -> "Tabulated":
        """The solid at the reference of the law, by which rows at other temperatures are shifted.

        Raises ValueError for several temperatures without a law, and for a temperature that is not the reference.
        """
        if self.table.temperature is None:
            return self
        if law is None:
            if self.table.several:
                raise ValueError(_no_law(self.table))
            return self
        return _reduced(self, replace(law, temperature=law.reference))  # which alone tells one law from another


def _is_plain(table):
    """Whether a table stands there by the names of our fields."""
    if not isinstance(table, Mapping):
        return isinstance(table, Table)
    known = Table.__dataclass_fields__.keys()
    return table.keys() <= known and all(bare(each)[1] is None for each in table.values())


def _no_law(table):
    low, high = min(table.temperature), max(table.temperature)
    return (
        f"elastomer.table has several temperatures, from {low:g} to {high:g} K: state [temperature], the law that "
        "shifts them to its reference, or give the table a column of shift factors"
    )


@lru_cache(maxsize=16)
def _reduced(solid: Tabulated, law: TemperatureLaw) -> Tabulated:
    """The solid at the temperature of a law, its reference."""
    temperature = np.array(solid.table.temperature)
    mean = float(temperature.mean())
    if not solid.table.several and abs(mean - law.reference) > SCATTER:
        raise ValueError(
            f"elastomer.table was measured at {mean:g} K, and temperature.reference = {law.reference:g} K: the "
            "law shifts from the temperature at which the elastomer is stated, make it the reference"
        )
    if not solid.table.several and mean == law.reference:
        return solid
    try:
        laws = {each: replace(law, temperature=each) for each in temperature.tolist()}
    except ValueError as error:
        raise ValueError(f"elastomer.table: a row at {str(error).partition(': ')[2]}") from error
    longer, stiffer = np.array([(laws[each].shift, laws[each].stiffer) for each in temperature.tolist()]).T
    return replace(solid, table=solid.table.shifted(longer, stiffer))


@lru_cache(maxsize=64)
def _fit(solid: Tabulated) -> tuple[Modes, float]:
    """Modes, and the error of the modulus at rest [Pa]."""
    return fitted(_rows(solid), solid.equilibrium_modulus)


@lru_cache(maxsize=64)
def _continued(solid: Tabulated) -> Continued:
    rows, modes, (low, high) = _rows(solid), _fit(solid)[0], solid.frequencies
    whole = modes.relaxation() if isinstance(modes, Retardation) else modes
    scatter = max(rms(rows.misfit(modes)), NEGLIGIBLE)
    end = complex(whole.complex_modulus(low))
    if solid.table.over_time:
        high /= sqrt(10)  # modes that had relaxed before the first row are not seen, and part of the loss there
        if end.imag:  # the loss follows from differences of the moduli
            scatter *= abs(end) / end.imag
    return Continued(whole, (low, high), solid.equilibrium_modulus, scatter)


def _rows(solid: Tabulated) -> Measured:
    kinds = {"loss": Oscillation, "modulus": Stress, "compliance": Creep}
    return kinds[solid.table.form[-1]](*solid.measured())
