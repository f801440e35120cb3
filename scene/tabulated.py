"""A solid measured as G', G'' against frequency: the passive solid with few modes that follows the table best."""

from functools import lru_cache
from math import pi
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
# Of the lowest storage modulus; what is left below it at rest cannot be told from nothing.
_LEAST_REST = 1e-2


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
    leaves the modulus at rest open.
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
        _, measured = self.measured()
        if self.modes().equilibrium < _LEAST_REST * measured.real.min() and self.equilibrium_modulus is None:
            raise ValueError(
                f"{self.table!r} leaves the modulus at rest open: state equilibrium_modulus, or measure at lower "
                "frequencies"
            )
        return self

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

    def modes(self) -> Relaxation:
        return _fit(self)


@lru_cache(maxsize=64)
def _fit(solid: Tabulated) -> Relaxation:
    """Fit with as few times a decade as follow the table about as well as many do."""
    omega, measured = solid.measured()

    def at(density):
        fast, slow = 1 / (omega[-1] * _MARGIN), _MARGIN / omega[0]
        times = np.geomspace(fast, slow, int(np.ceil(np.log10(slow / fast) * density)) + 1)
        return _nonnegative(omega, measured, times, solid.equilibrium_modulus)

    def misfit(series):
        return _rms(_misfit(series, omega, measured))

    *coarser, finest = _TIMES_A_DECADE
    best = at(finest)
    enough = max(1.1 * misfit(best), _NEGLIGIBLE)
    return next((series for series in map(at, coarser) if misfit(series) <= enough), best)


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
