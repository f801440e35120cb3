"""Roughness: a self-affine spectrum, from which each solver draws its own surface, or plain waves."""

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
    """Randomly rough, isotropic, self-affine between two wavelengths.

    hurst : Hurst exponent, 0 to 1
    rms_height : rms height h_0 over the whole surface [m]
    longest : longest wavelength and period of the surface [m], q_min = 2 pi / longest
    shortest : shortest wavelength [m], q_max = 2 pi / shortest; without it the cut-off is the Nyquist wave
        number of the solver's grid, as in the paper
    rolloff : wavelength [m] above which, up to `longest`, the spectrum is flat; without it there is no roll-off
    seed : of the random phases

    Spectra are two-sided: <h^2> = 2 int_0^inf C_1D dq = 2 pi int_0^inf q C_2D dq, and tied by the rule of
    the method of dimensionality reduction, C_1D = pi q C_2D, which keeps the rms height and the rms of the
    full gradient.
    """

    hurst: Annotated[Finite, Field(ge=0, le=1)]
    rms_height: NonNegative
    longest: Positive
    shortest: Positive | None = None
    rolloff: Positive | None = None
    seed: Annotated[Whole, Field(ge=0)] = 0
    type: Literal["self-affine"] = Field(default="self-affine", repr=False)

    @model_validator(mode="after")
    def _wavelengths_in_order(self):
        if self.shortest is not None and not self.shortest <= self.longest / 2:
            raise ValueError(f"shortest = {self.shortest:g} must be at most half of longest = {self.longest:g}")
        if self.rolloff is not None and not (self.shortest or 0.0) < self.rolloff <= self.longest:
            least = "" if self.shortest is None else f"more than shortest = {self.shortest:g} and "
            raise ValueError(f"rolloff = {self.rolloff:g} must be {least}at most longest = {self.longest:g}")
        return self

    @property
    def period(self) -> float:
        """Side of the square that repeats [m]."""
        return self.longest

    @property
    def q_min(self) -> float:
        """Lowest wave number 2 pi / longest [rad/m]."""
        return 2 * pi / self.longest

    def q_max(self, pixel: float) -> float:
        """Highest wave number [rad/m]: that of the shortest wavelength, else pi / pixel."""
        return 2 * pi / self.shortest if self.shortest is not None else pi / pixel

    @property
    def q_rolloff(self) -> float:
        """Wave number [rad/m] below which the spectrum is flat: q_min without a roll-off."""
        return self.q_min if self.rolloff is None else 2 * pi / self.rolloff

    def density_1d(self, q, q_max):
        """C_1D(q) [m^3], zero outside q_min <= q <= q_max [rad/m]."""
        return pi * q * self.density_2d(q, q_max)

    def density_2d(self, q, q_max):
        """C_2D(q) [m^4], zero outside q_min <= q <= q_max [rad/m]."""
        inside = (q >= self.q_min) & (q <= q_max)
        falling = np.maximum(np.where(inside, q, 0.0) / self.q_rolloff, 1.0) ** (-2 * self.hurst - 2)
        plateau = (self.rms_height / self.q_rolloff) ** 2 / (2 * pi * self._moment(1, self.q_min, q_max))
        return np.where(inside, plateau * falling, 0.0)

    def share(self, lower, upper, q_max):
        """Of <h^2>, what lies in q_min <= lower <= q <= upper <= q_max [rad/m], arrays allowed."""
        return self._moment(1, lower, upper) / self._moment(1, self.q_min, q_max)

    def rms_slope(self, q_max) -> float:
        """Spectral rms of the full gradient [1] with the cut-off q_max [rad/m]."""
        ratio = self._moment(3, self.q_min, q_max) / self._moment(1, self.q_min, q_max)
        return self.rms_height * self.q_rolloff * sqrt(ratio)

    def _moment(self, m, lower, upper):
        """int t^m max(t, 1)^(-2H-2) dt over t = q / q_rolloff, from lower to upper [rad/m]."""
        lower, upper = lower / self.q_rolloff, upper / self.q_rolloff
        flat = power_integral(m, np.minimum(lower, 1.0), np.minimum(upper, 1.0))
        return flat + power_integral(m - 2 * self.hurst - 2, np.maximum(lower, 1.0), np.maximum(upper, 1.0))


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Wave:
    """One wave along the sliding direction, h = amplitude cos(2 pi x / wavelength). amplitude, wavelength [m]."""

    amplitude: NonNegative
    wavelength: Positive
    type: Literal["wave"] = Field(default="wave", repr=False)

    @property
    def period(self) -> float:
        """Side of the square that repeats [m]."""
        return self.wavelength

    @property
    def rms_height(self) -> float:
        """[m]"""
        return self.amplitude / sqrt(2)

    def q_max(self, pixel: float) -> float:
        """Highest wave number along a side [rad/m]; the pixel does not matter."""
        return 2 * pi / self.wavelength

    @property
    def shortest(self) -> float:
        """Shortest wavelength along a side [m]."""
        return self.wavelength


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class CrossedWaves(Wave):
    """Two crossed waves, h = amplitude cos(2 pi x / wavelength) cos(2 pi y / wavelength)."""

    type: Literal["crossed-waves"] = Field(default="crossed-waves", repr=False)

    @property
    def rms_height(self) -> float:
        """[m]"""
        return self.amplitude / 2


Roughness = Annotated[SelfAffine | Wave | CrossedWaves, Field(discriminator="type")]
