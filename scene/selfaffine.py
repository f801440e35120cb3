"""Roughness by a self-affine spectrum, from which each solver draws its own surface."""

from itertools import pairwise
from math import inf, pi, sqrt
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, ConfigDict, Field, TypeAdapter, ValidationError, model_validator
from pydantic.dataclasses import dataclass

from .printable import brief
from .quantities import (
    CLOSED,
    METRE,
    RADIAN_PER_METRE,
    Finite,
    Length,
    LengthOrZero,
    NonNegative,
    Seed,
    by_name,
    takes,
)

# Wavelength [m] down to which its wave number, and that of a grid that resolves it, is a number.
_SHORTEST = 1e-300


def _has_wave_number(wavelength):
    if wavelength < _SHORTEST:
        raise ValueError(f"wavelengths are at least {_SHORTEST:g} m, for their wave numbers to be finite")
    return wavelength


Wavelength = Annotated[Length, AfterValidator(_has_wave_number)]

# Enough for directions over seven decades of wave numbers, to 1e-12.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(28)


def power_integral(exponent, lower, upper):
    """int_lower^upper q^exponent dq for 0 < lower <= upper, arrays allowed; exact also near exponent = -1."""
    p = exponent + 1
    ratio = np.log(upper / lower)
    return lower**p * (np.expm1(p * ratio) / p if p else ratio)


_SLOPE = TypeAdapter(NonNegative)


def _or_slope(schema: dict[str, Any]) -> None:
    """In JSON schema: a slope in place of the height."""
    schema["properties"] |= {
        "rms_slope": _SLOPE.json_schema() | {"description": "in place of rms_height: rms of the full gradient"}
    }
    schema["required"].remove("rms_height")
    schema["oneOf"] = [{"required": ["rms_height"]}, {"required": ["rms_slope", "shortest"]}]


_of_waves = takes(**dict.fromkeys(("q", "q_max", "lower", "upper"), RADIAN_PER_METRE))


@dataclass(frozen=True, config=ConfigDict(**CLOSED, json_schema_extra=_or_slope), kw_only=True)
class SelfAffine:
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
    it becomes the rms_height that has it.

    Spectra are two-sided: <h^2> = 2 int_0^inf C_1D dq = 2 pi int_0^inf q C_2D dq. A line has the spectrum of the
    method of dimensionality reduction, C_1D = pi q C_2D, which keeps the rms height and the rms of the full
    gradient, or that of a line scan.
    """

    hurst: Annotated[Finite, Field(ge=0, le=1)]
    rms_height: LengthOrZero
    longest: Wavelength
    shortest: Wavelength | None = None
    rolloff: Wavelength | None = None
    seed: Seed = 0
    amplitudes: Literal["fixed", "gaussian"] = "fixed"
    type: Literal["self-affine"] = Field(default="self-affine", repr=False)

    @model_validator(mode="before")
    @classmethod
    def _of_the_slope(cls, given: Any) -> Any:
        stated = by_name(given)
        if stated is None or "rms_slope" not in stated:
            return given
        stated = dict(stated)
        said = f"rms_slope = {brief(repr(slope := stated.pop('rms_slope')))}"
        if "rms_height" in stated:
            raise ValueError(f"{said} beside rms_height = {brief(repr(stated['rms_height']))}: give one of them")
        try:
            slope = _SLOPE.validate_python(slope)
        except ValidationError as error:
            why = error.errors()[0]["msg"].removeprefix("Value error, ")
            raise ValueError(f"{said}: {why}, the rms of the full gradient, a number without a unit") from None
        try:
            unit = cls(**stated, rms_height=1.0)
        except ValueError:
            return stated | {"rms_height": 1.0}  # for the mistakes to be told of the fields that have them
        if unit.shortest is None:
            raise ValueError(
                f"{said} without shortest: the cut-off would be that of each solver's grid, and so would the "
                "height; state shortest, the shortest wavelength, or rms_height in place of rms_slope"
            )
        steepness = unit.rms_slope(unit.q_max(0.0))
        height = slope / steepness if 0 < steepness < inf else inf
        if not height < inf or (slope and not height):
            raise ValueError(f"{said}: its rms height is beyond the range of numbers")
        return stated | {"rms_height": height}

    @model_validator(mode="after")
    def _wavelengths_in_order(self):
        if self.shortest is not None and not self.shortest <= self.longest / 2:
            raise ValueError(f"shortest = {self.shortest:g} must be at most half of longest = {self.longest:g}")
        if self.rolloff is not None and not (self.shortest or 0.0) < self.rolloff <= self.longest:
            least = "" if self.shortest is None else f"more than shortest = {self.shortest:g} and "
            raise ValueError(f"rolloff = {self.rolloff:g} must be {least}at most longest = {self.longest:g}")
        return self

    @property
    def flat(self) -> bool:
        """Whether the rms height is zero, so that there is no roughness."""
        return self.rms_height == 0

    @property
    def period(self) -> float:
        """Side of the square that repeats [m]."""
        return self.longest

    @property
    def q_min(self) -> float:
        """Lowest wave number 2 pi / longest [rad/m]."""
        return 2 * pi / self.longest

    @takes(pixel=METRE)
    def q_max(self, pixel: float) -> float:
        """Highest wave number [rad/m]: that of the shortest wavelength, else pi / pixel."""
        return 2 * pi / self.shortest if self.shortest is not None else pi / pixel

    @property
    def q_rolloff(self) -> float:
        """Wave number [rad/m] below which the spectrum is flat: q_min without a roll-off."""
        return self.q_min if self.rolloff is None else 2 * pi / self.rolloff

    @_of_waves
    def density_1d(self, q, q_max):
        """C_1D(q) [m^3] by the rule pi q C_2D, zero outside q_min <= q <= q_max [rad/m]."""
        return pi * q * self.density_2d(q, q_max)

    @_of_waves
    def density_line_scan(self, q, q_max):
        """C_1D(q) [m^3] of a line scan, 2 int_0^inf C_2D(sqrt(q^2 + s^2)) ds, for q > 0 [rad/m]; zero above q_max.

        A wave of the surface at an angle to the line is seen on it at q cos(angle): the line scan has power also
        below q_min, and half the mean square slope of the full gradient.
        """
        return self._over_directions(lambda seen: seen / q * self.density_1d(seen, q_max), q, q_max)

    @_of_waves
    def density_2d(self, q, q_max):
        """C_2D(q) [m^4], zero outside q_min <= q <= q_max [rad/m]."""
        inside = (q >= self.q_min) & (q <= q_max)
        falling = np.maximum(np.where(inside, q, 0.0) / self.q_rolloff, 1.0) ** (-2 * self.hurst - 2)
        plateau = (self.rms_height / self.q_rolloff) ** 2 / (2 * pi * self._moment(1, self.q_min, q_max))
        return np.where(inside, plateau * falling, 0.0)

    @_of_waves
    def share(self, lower, upper, q_max):
        """Share of <h^2> that lies in q_min <= lower <= q <= upper <= q_max [rad/m], arrays allowed."""
        return self._moment(1, lower, upper) / self._moment(1, self.q_min, q_max)

    @_of_waves
    def share_line_scan(self, lower, upper, q_max):
        """Share of <h^2> that a line scan has in 0 < lower <= q <= upper <= q_max [rad/m], arrays allowed."""

        def above(q):
            return self.share(np.maximum(q, self.q_min), q_max, q_max)

        seen_above_lower, seen_above_upper = (self._over_directions(above, q, q_max) for q in (lower, upper))
        return seen_above_lower - seen_above_upper

    @_of_waves
    def rms_slope(self, q_max) -> float:
        """Spectral rms of the full gradient [1] with the cut-off q_max [rad/m].

        >>> from scene import SelfAffine
        >>> rough = SelfAffine(hurst=0.8, rms_height=1e-6, longest=1e-3, shortest=1e-5, seed=1)
        >>> round(rough.rms_slope(rough.q_max(pixel=1e-6)), 3)
        0.029
        """
        ratio = self._moment(3, self.q_min, q_max) / self._moment(1, self.q_min, q_max)
        return self.rms_height * self.q_rolloff * sqrt(ratio)

    def _over_directions(self, function, q, q_max):
        """Mean over all angles of function(q / cos(angle)), which is zero above q_max [rad/m].

        With 1 / cos(angle) = cosh(t) the integrand is analytic between the corners of the spectrum.
        """
        corners = [np.arccosh(np.maximum(corner / q, 1.0)) for corner in (q, self.q_min, self.q_rolloff, q_max)]
        total = 0.0
        for start, end in pairwise(corners):
            middle, half = (start + end) / 2, (end - start) / 2
            for node, weight in zip(_NODES, _WEIGHTS, strict=True):
                stretch = np.cosh(middle + half * node)
                total = total + weight * half * function(q * stretch) / stretch
        return 2 / pi * total

    def _moment(self, m, lower, upper):
        """int t^m max(t, 1)^(-2H-2) dt over t = q / q_rolloff, from lower to upper [rad/m]."""
        lower, upper = lower / self.q_rolloff, upper / self.q_rolloff
        flat = power_integral(m, np.minimum(lower, 1.0), np.minimum(upper, 1.0))
        return flat + power_integral(m - 2 * self.hurst - 2, np.maximum(lower, 1.0), np.maximum(upper, 1.0))
