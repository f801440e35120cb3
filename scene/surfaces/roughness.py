"""Roughness of every kind: by a spectrum, plain waves, a map, or a line."""

from math import pi, sqrt
from typing import Annotated, Literal

from pydantic import Field
from pydantic.dataclasses import dataclass

from ..quantities import CLOSED, LengthOrZero
from .profile import Profile
from .selfaffine import SelfAffine, Wavelength
from .spectrum import Spectrum
from .topography import Topography

__all__ = ["CrossedWaves", "Profile", "Roughness", "SelfAffine", "Spectrum", "Topography", "Wave"]


@dataclass(frozen=True, config=CLOSED, kw_only=True)
class Wave:
    """One wave along the sliding direction, h = amplitude cos(2 pi x / wavelength). amplitude, wavelength [m]."""

    amplitude: LengthOrZero
    wavelength: Wavelength
    type: Literal["wave"] = Field(default="wave", repr=False)

    @property
    def flat(self) -> bool:
        """Whether the rms height is zero, so that there is no roughness."""
        return self.rms_height == 0

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

    # Each type has its own name in files, and so has a subtype.
    type: Literal["crossed-waves"] = Field(default="crossed-waves", repr=False)  # type: ignore[assignment]

    @property
    def rms_height(self) -> float:
        """[m]"""
        return self.amplitude / 2


Roughness = Annotated[
    SelfAffine | Spectrum | Wave | CrossedWaves | Topography | Profile, Field(discriminator="type")
]
