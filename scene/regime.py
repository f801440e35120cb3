"""Regime of a rough contact against the conditions of the laws of Popov et al., Sci. Rep. 4, 3750 (2014)."""

from dataclasses import dataclass

import numpy as np

from .doubt import SMALL_SLOPE

# "Much less" in numbers: the term that a law drops is then at most about a tenth, a twenty-fifth of what it keeps.
MUCH_LESS_HEIGHT, MUCH_LESS_SLOPE = 0.1, 0.2


@dataclass(frozen=True)
class Regime:
    """Ratios of a rough contact, numbers or arrays of one shape.

    height_over_depth : rms height over the depth of the smooth relaxed contact, h_0 / d
    contact_over_period : its width over the longest wavelength, 2a / L
    macro_over_rough : rms slope of the macroscopic profile over that contact, over the rms slope of the roughness
    rms_slope : of the roughness
    """

    height_over_depth: float
    contact_over_period: float
    macro_over_rough: float
    rms_slope: float

    @classmethod
    def of(cls, profile, contact, rms_height, longest, rms_slope) -> "Regime":
        """Regime of roughness of an rms height and a longest wavelength [m] on a one-dimensional profile.

        profile : coefficient c_n [m^(1-n)] and exponent n of g = c_n |x|^n
        contact : radius a and depth d [m] of the smooth relaxed contact
        """
        (c, n), (a, d) = profile, contact
        macro = c * n * a ** (n - 1) / np.sqrt(2 * n - 1)
        # Heights that are all zero have no slope.
        with np.errstate(divide="ignore"):
            over_rough = np.divide(macro, rms_slope)
        return cls(rms_height / d, 2 * a / longest, over_rough, rms_slope)

    @property
    def flags(self) -> dict[str, bool]:
        """Whether each condition holds, by name: h0 << d, 2a < L, macro slope << roughness slope, small slopes."""
        return {
            "h0 << d": self.height_over_depth <= MUCH_LESS_HEIGHT,
            "2a < L": self.contact_over_period < 1,
            "macro slope << roughness slope": self.macro_over_rough <= MUCH_LESS_SLOPE,
            "small slopes": self.rms_slope <= SMALL_SLOPE,
        }
