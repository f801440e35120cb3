"""A solid measured as G', G'' against frequency: the passive solid with few modes that follows the table best."""

from functools import lru_cache
from math import inf, pi, sqrt
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import BeforeValidator, Field, model_validator
from pydantic.dataclasses import dataclass

from .files import once
from .modes import Relaxation
from .quantities import CLOSED, Finite, Pressure
from .table import COLUMNS, Table, columns
from .viscoelastic import PoissonRatio, Solid

# Times further beyond the inverse frequencies of a table than this cannot be told from its ends.
_MARGIN = 10**0.5
_TIMES_A_DECADE = (1, 1.5, 2, 3, 5, 10, 30)
# No measurement is worth modes for a smaller misfit.
_NEGLIGIBLE = 1e-3
# Largest relative contribution of a mode that is left out.
_INVISIBLE = 1e-7
# Standard errors of a fitted modulus at rest; what is less of them cannot be told from nothing.
_TOLD = 3


def _read_if_path(value):
    return once(columns, value) if isinstance(value, str | Path) else value


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Tabulated(Solid):
    """Solid of measured storage and loss modulus, fitted with a Prony series by nonnegative least squares.

    table : a Table, or the path of a text or CSV file with its three columns, read once and kept as numbers; a
        relative path starts at the working directory
    frequency_unit : "rad/s" or "Hz" (cycles per second)
    kind : "shear" for G', G''; "tensile" for E', E'' = 2 (1 + poisson_ratio) G', G''; both in Pa
    equilibrium_modulus : shear modulus at rest [Pa] if it is known, else fitted: what does not relax within three
        times the longest time of the table, 1/(lowest angular frequency)
    tolerance : largest root mean square of the relative misfits of G' and G'' that is accepted

    `error` and `rms_error` say how well the series follows the table. Raises ValueError if no passive solid does
    to within the tolerance (in one, G' never falls with the frequency and G'' belongs to it), or if the table
    leaves the modulus at rest open: fitted, it has to be three times its standard error, `equilibrium_error`.
    """

    table: Annotated[Table, BeforeValidator(_read_if_path, json_schema_input_type=str | Table)]
    frequency_unit: Literal["rad/s", "Hz"]
    kind: Literal["shear", "tensile"]
    equilibrium_modulus: Pressure | None = None
    tolerance: Annotated[Finite, Field(gt=0, lt=1)] = 0.1
    poisson_ratio: PoissonRatio = 0.5
    type: Literal["tabulated"] = Field(default="tabulated", repr=False)

    @model_validator(mode="after")
    def _can_be_fitted(self):
        try:
            with np.errstate(over="raise", divide="raise", invalid="raise"):
                self.modes()
        except (ArithmeticError, RuntimeError) as error:  # RuntimeError of a fit that does not end
            why = f"{self.table!r}: no solid can be fitted ({error}): check units and columns"
            raise ValueError(why) from error
        if self.rms_error > self.tolerance:
            raise ValueError(
                f"{self.table!r}: the best passive solid is off by {self.rms_error:.2g} (relative, root mean "
                f"square), more than tolerance = {self.tolerance:g}: check units and columns, and that G' does "
                "not fall with the frequency; if this is the scatter, raise tolerance"
            )
        if self.modes().equilibrium < _TOLD * self.equilibrium_error:
            raise ValueError(
                f"{self.table!r} leaves the modulus at rest open: {self._seen_at_rest()}; state "
                "equilibrium_modulus, or measure at lower frequencies"
            )
        return self

    def _seen_at_rest(self):
        """What the table shows of the modulus at rest, in words."""
        rest, lowest = self.modes().equilibrium, self.measured()[0][0]
        low, next_octave = self.modes().complex_modulus(lowest * np.array([1.0, 2.0]))
        liquid = "it shows a liquid, " if low.imag > low.real else ""
        fitted = f"is {rest:.2g} Pa with a standard error of {self.equilibrium_error:.2g} Pa"
        return (
            f"{liquid}as at its lowest frequency, {min(self.table.frequency):g} {self.frequency_unit}, G'' is "
            f"{low.imag / low.real:.2g} G' and G' grows as frequency^{np.log2(next_octave.real / low.real):.2g}, "
            f"and what is fitted {fitted if 0 < self.equilibrium_error < inf else 'is none'}"
        )

    def measured(self):
        """Angular frequencies (N,) [rad/s] ascending, and complex shear moduli (N,) [Pa]."""
        frequency, storage, loss = (np.array(getattr(self.table, name)) for name in COLUMNS)
        order = np.argsort(frequency, kind="stable")
        cycle = 2 * pi if self.frequency_unit == "Hz" else 1.0
        stiffer = 2 * (1 + self.poisson_ratio) if self.kind == "tensile" else 1.0
        return cycle * frequency[order], (storage + 1j * loss)[order] / stiffer

    @property
    def error(self) -> float:
        """Largest relative misfit of G' or G'' at a row of the table."""
        return float(np.abs(_misfit(self.modes(), *self.measured())).max())

    @property
    def rms_error(self) -> float:
        """Root mean square of the relative misfits of G' and G'' at the rows of the table."""
        return _rms(_misfit(self.modes(), *self.measured()))

    @property
    def equilibrium_error(self) -> float:
        """Standard error of a fitted modulus at rest [Pa]; zero of a known one, infinite where none is seen."""
        return _fit(self)[1]

    def modes(self) -> Relaxation:
        return _fit(self)[0]


@lru_cache(maxsize=64)
def _fit(solid: Tabulated) -> tuple[Relaxation, float]:
    """Fit with as few times a decade as follow the table about as well as many do, and the error at rest [Pa]."""
    omega, measured = solid.measured()

    def at(density, rest=solid.equilibrium_modulus):
        fast, slow = 1 / (omega[-1] * _MARGIN), _MARGIN / omega[0]
        times = np.geomspace(fast, slow, int(np.ceil(np.log10(slow / fast) * density)) + 1)
        return _nonnegative(omega, measured, times, rest)

    def misfit(series):
        return _rms(_misfit(series, omega, measured))

    *coarser, finest = _TIMES_A_DECADE
    best = at(finest)
    enough = max(1.1 * misfit(best), _NEGLIGIBLE)
    series = next((series for series in map(at, coarser) if misfit(series) <= enough), best)
    if solid.equilibrium_modulus is not None:
        return series, 0.0
    # With the most times, as slow modes else leave room for a modulus at rest.
    told = _standard_errors(2 * len(omega), len(best.times) + 1, misfit(best), misfit(at(finest, rest=0.0)))
    return series, series.equilibrium / told if told and series.equilibrium else inf


def _standard_errors(rows, fitted, misfit, without):
    """Standard errors by which a fitted amount differs from zero.

    rows, fitted : numbers of misfits, and of amounts that were fitted
    misfit, without : root mean square of the misfits with that amount, and without it
    """
    noise = max(rows * misfit**2 / max(rows - fitted, 1), _NEGLIGIBLE**2)
    # The sum of squares is least at the fitted amount, and grows as the square of the distance from it.
    return sqrt(max(rows * (without**2 - misfit**2), 0.0) / noise)


def _nonnegative(omega, measured, times, equilibrium):
    """The series of given times, moduli >= 0, and given or fitted equilibrium, with the least relative misfit."""
    # Only tables need it.
    from scipy.optimize import nnls

    phase = 1j * omega[:, None] * times
    parts = np.hstack([np.ones((len(omega), 1)), phase / (1 + phase)])
    matrix = np.vstack([parts.real / measured.real[:, None], parts.imag / measured.imag[:, None]])
    target = np.ones(len(matrix))
    if equilibrium is not None:
        target -= equilibrium * matrix[:, 0]
        matrix[:, 0] = 0.0
    size = np.linalg.norm(matrix, axis=0) + (matrix[0] == 0)
    amounts = nnls(matrix / size, target, maxiter=100 * len(size))[0] / size
    rest, moduli = amounts[0] if equilibrium is None else equilibrium, amounts[1:]
    kept = moduli * matrix[:, 1:].max(axis=0) > _INVISIBLE
    return Relaxation.of(float(rest), moduli[kept], times[kept])


def _misfit(series, omega, measured):
    found = series.complex_modulus(omega)
    return np.append(found.real / measured.real, found.imag / measured.imag) - 1


def _rms(values):
    return float(np.sqrt(np.mean(values**2)))
