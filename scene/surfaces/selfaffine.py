"""Roughness by a self-affine spectrum, from which each solver draws its own surface."""

from dataclasses import replace
from math import inf, pi
from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator, Field, TypeAdapter, model_validator
from pydantic.dataclasses import dataclass

from ..files.stated import alternatives, restated, taken
from ..quantities import BARE, Finite, Length, LengthOrZero, NonNegative, Seed
from .isotropic import Isotropic, power_integral, wave_at_slope

ATOM = 1e-10  # no wave is shorter [m]
# Wavelength [m] down to which its wave number, and the wave numbers of a grid that resolves it, are finite.
_SHORTEST = 1e-300


def _has_wave_number(wavelength):
    if wavelength < _SHORTEST:
        raise ValueError(f"wavelengths are at least {_SHORTEST:g} m, for their wave numbers to be finite")
    return wavelength


Wavelength = Annotated[Length, AfterValidator(_has_wave_number)]

_SLOPE = TypeAdapter(NonNegative)


def slope_of(given):
    if not 0 <= (found := BARE.value(given)) < inf:
        raise ValueError("Input should be the rms of the full gradient, a number from 0 on")
    return found


_STATED = alternatives("rms_height", **dict.fromkeys(("rms_slope", "shortest_at_slope"), _SLOPE.json_schema()))


@dataclass(frozen=True, config=_STATED, kw_only=True)
class SelfAffine(Isotropic):
    """Randomly rough, isotropic, self-affine between two wavelengths.

    hurst : Hurst exponent, 0 to 1
    rms_height : rms height h_0 over the whole surface [m]
    longest : longest wavelength and period of the surface [m], q_min = 2 pi / longest
    shortest : shortest wavelength [m], q_max = 2 pi / shortest; without it the cut-off is the Nyquist wave
        number of the solver's grid, as in the paper
    rolloff : wavelength [m] above which, up to `longest`, the spectrum is flat; without it there is no roll-off
    seed : of the random phases, and of the amplitudes where those are drawn
    amplitudes : "fixed", those of the spectrum, so that each surface has its rms height, or "gaussian", complex
        Gaussian variables of the same mean square, so that heights are a Gaussian process and the rms height of a
        surface scatters

    In place of rms_height `rms_slope` may be stated, the spectral rms of the full gradient [1], with `shortest`:
    it becomes the rms_height that has it. In place of shortest `shortest_at_slope` may be stated: the shortest
    wave is then the one at which the rms slope reaches that value.
    """

    hurst: Annotated[Finite, Field(ge=0, le=1)]
    rms_height: LengthOrZero
    longest: Wavelength
    shortest: Wavelength | None = None
    rolloff: Wavelength | None = None
    seed: Seed = 0
    amplitudes: Literal["fixed", "gaussian"] = "fixed"
    type: Literal["self-affine"] = Field(default="self-affine", repr=False)

    @restated
    def _of_the_slope(cls, stated):  # noqa: N805
        if "shortest_at_slope" in stated:
            return _up_to_the_slope(cls, stated)
        if "rms_slope" not in stated:
            return stated
        slope = taken("rms_slope", stated, slope_of)
        del stated["rms_slope"]
        if "rms_height" in stated or stated.get("shortest") is None:
            raise ValueError(f"rms_slope = {slope:g}: state shortest, up to which it is found, and no rms_height")
        try:
            unit = cls(**stated, rms_height=1.0)
        except ValueError:
            return stated | {"rms_height": 1.0}  # for the mistakes of the fields that have them
        return stated | {"rms_height": slope / unit.rms_slope(unit.q_max(0.0))}

    @model_validator(mode="after")
    def _wavelengths_in_order(self):
        if self.shortest is not None and not self.shortest <= self.longest / 2:
            raise ValueError(f"shortest = {self.shortest:g} must be at most half of longest = {self.longest:g}")
        if self.rolloff is not None and not (self.shortest or 0.0) < self.rolloff <= self.longest:
            least = "" if self.shortest is None else f"more than shortest = {self.shortest:g} and "
            raise ValueError(f"rolloff = {self.rolloff:g} must be {least}at most longest = {self.longest:g}")
        return self

    @property
    def normalized(self) -> "SelfAffine":
        """Spectrum at an rms height of 1 m, as the square of a tiny height vanishes."""
        return replace(self, rms_height=1.0)

    @property
    def q_rolloff(self) -> float:
        """Wave number [rad/m] below which the spectrum is flat: q_min without a roll-off."""
        return self.q_min if self.rolloff is None else 2 * pi / self.rolloff

    @property
    def _unit(self):
        return self.q_rolloff

    def _corners(self, q_max):
        return self.q_min, self.q_rolloff

    def _relative(self, q):
        return np.maximum(q / self.q_rolloff, 1.0) ** (-2 * self.hurst - 2)

    def _moment(self, m, lower, upper):
        """int t^m max(t, 1)^(-2H-2) dt over t = q / q_rolloff, from lower to upper [rad/m]."""
        lower, upper = lower / self.q_rolloff, upper / self.q_rolloff
        flat = power_integral(m, np.minimum(lower, 1.0), np.minimum(upper, 1.0))
        return flat + power_integral(m - 2 * self.hurst - 2, np.maximum(lower, 1.0), np.maximum(upper, 1.0))


def _up_to_the_slope(cls, stated):
    """Fields with the shortest wave at which the rms slope reaches what is stated."""
    slope = taken("shortest_at_slope", stated, slope_of)
    del stated["shortest_at_slope"]
    if stated.get("shortest") is not None or "rms_slope" in stated:
        raise ValueError(f"shortest_at_slope = {slope:g}: state rms_height, and neither shortest nor rms_slope")
    try:
        rough = cls(**stated)
    except ValueError:
        return stated  # for the mistakes of the fields that have them
    return stated | {"shortest": wave_at_slope(slope, rough.rms_slope, 2 * rough.q_min, 2 * pi / ATOM)}
