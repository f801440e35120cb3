"""Self-affine roughness as a spectrum. Each solver draws its own surface from it, in its own dimension."""

from math import pi, sqrt
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from .quantities import CLOSED, Finite, NonNegative, Positive, Whole


def power_integral(exponent, lower, upper):
    """int_lower^upper q^exponent dq for 0 < lower <= upper, arrays allowed; exact also near exponent = -1."""
    p = exponent + 1
    ratio = np.log(upper / lower)
    return lower**p * (np.expm1(p * ratio) / p if p else ratio)


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class SelfAffine:
    """Randomly rough, isotropic, self-affine between two wavelengths, without roll-off.

    hurst : Hurst exponent, 0 to 1
    rms_height : rms height h_0 over the whole surface [m]
    longest : longest wavelength and period of the surface [m], q_min = 2 pi / longest
    shortest : shortest wavelength [m], q_max = 2 pi / shortest; without it the cut-off is the Nyquist wave
        number of the solver's grid, as in the paper
    seed : of the random phases

    Spectra are two-sided: <h^2> = 2 int_0^inf C_1D dq = 2 pi int_0^inf q C_2D dq, and tied by the rule of
    the method of dimensionality reduction, C_1D = pi q C_2D, which keeps the rms height and the rms of the
    full gradient.
    """

    hurst: Annotated[Finite, Field(ge=0, le=1)]
    rms_height: NonNegative
    longest: Positive
    shortest: Positive | None = None
    seed: Annotated[Whole, Field(ge=0)] = 0
    type: Literal["self-affine"] = Field(default="self-affine", repr=False)

    @model_validator(mode="after")
    def _wavelengths_in_order(self):
        if self.shortest is not None and not self.shortest <= self.longest / 2:
            raise ValueError(f"shortest = {self.shortest:g} must be at most half of longest = {self.longest:g}")
        return self

    @property
    def q_min(self) -> float:
        """Lowest wave number 2 pi / longest [rad/m]."""
        return 2 * pi / self.longest

    def q_max(self, pixel: float) -> float:
        """Highest wave number [rad/m]: that of the shortest wavelength, else pi / pixel."""
        return 2 * pi / self.shortest if self.shortest is not None else pi / pixel

    def density_1d(self, q, q_max):
        """C_1D(q) [m^3], zero outside q_min <= q <= q_max [rad/m]."""
        return pi * q * self.density_2d(q, q_max)

    def density_2d(self, q, q_max):
        """C_2D(q) [m^4], zero outside q_min <= q <= q_max [rad/m]."""
        norm = 2 * pi * power_integral(-2 * self.hurst - 1, self.q_min, q_max)
        inside = (q >= self.q_min) & (q <= q_max)
        return np.where(inside, self.rms_height**2 / norm * np.where(inside, q, 1.0) ** (-2 * self.hurst - 2), 0.0)

    def rms_slope(self, q_max) -> float:
        """Spectral rms of the full gradient [1] with the cut-off q_max [rad/m]."""
        h = self.hurst
        ratio = power_integral(1 - 2 * h, self.q_min, q_max) / power_integral(-2 * h - 1, self.q_min, q_max)
        return self.rms_height * sqrt(ratio)


Roughness = SelfAffine
