"""Roughness by a measured spectral density, from which each solver draws its own surface."""

from functools import lru_cache
from math import inf, isfinite, pi, sqrt
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from ..files.stated import FORM, TableFormat, alternatives, filled, restated, taken
from ..files.tablefile import Column, read_columns
from ..quantities import RADIAN_PER_METRE, ROW, Positive, Seed, Unit
from .heightmap import LONGEST, SHORTEST
from .isotropic import Isotropic, PowerLaws, of_surface, wave_at_slope
from .scanned import QUOTIENT
from .selfaffine import Wavelength, slope_of

MOST_OF_SURFACE, MOST_OF_LINE = 5_000, 1_000  # points; a line has to be inverted
PER_METRE = Unit("1/m", "waves in a length", "0.1 1/um", 1e5)
OF_SURFACE = Unit("m^4", "a spectral density of a surface", "2 um^4", 2e-24)
OF_LINE = Unit("m^3", "a spectral density of a line", "2 um^3", 2e-18)
# The density here is one over the wave vector, there over that divided by 2 pi.
CONVENTIONS = {"persson": 1.0, "jacobs": 2 * pi}
COLUMNS = (
    Column("q", ("wavevector", "wave vector"), (RADIAN_PER_METRE, PER_METRE)),
    Column("frequency", ("spatial frequency",), (PER_METRE,)),
    Column("C2D", ("C_iso",), (OF_SURFACE,)),
    Column("C1D", (), (OF_LINE,)),
)


@dataclass(
    frozen=True,
    config=alternatives("q", table={"type": "string"}, shortest_at_slope={"type": "number"}, **FORM),
    kw_only=True,
)
class Spectrum(Isotropic):
    """Randomly rough and isotropic, with a measured spectral density.

    q : wave numbers 2 pi / wavelength [rad/m], in any order (N,)
    C2D : density of the surface at them (N,) [m^4]
    C1D : in place of C2D, density of line scans of the surface (N,) [m^3]
    convention : of the density, which has to be stated: "jacobs", <h^2> = 1/(2 pi) int q C2D dq (Jacobs, Junge and
        Pastewka, Surf. Topogr. 5, 013001, 2017), or "persson", <h^2> = 2 pi int q C2D dq, a density smaller by
        4 pi^2. C1D of two sides has <h^2> = 1/pi int C1D dq, or 2 int C1D dq, over q > 0
    sides : of C1D, "two", or "one" where C1D is twice as large, as all of <h^2> is ascribed to q > 0
    longest_kept, shortest_kept : longer and shorter waves are left out [m]; absent, those of q stay. In place of
        shortest_kept `shortest_at_slope` may be stated: waves are kept up to the one at which the rms slope
        reaches that value
    seed, amplitudes : see `SelfAffine`

    Between the points the density is a power law, outside it is zero. C1D is turned into C2D by Abel's inversion,
    in which C1D goes on beyond its last point by the law of its last octave. The longest wave is the period of the
    surface.

    In place of q and the density `table` is the path of a text file, relative to the folder of a scene file that
    names it, a DataFrame, a Dataset of xarray or arrays by name, with columns of these names; q, in rad/m or 1/m,
    is 2 pi / wavelength, and `frequency` [1/m] in its place 1 / wavelength. `columns`, `units`, `where`,
    `separator`, `decimal`, `encoding`, `skip` and `rows` state how it differs from the documented form of tables,
    see `stated.TableFormat`.

    Raises ValueError where there are fewer than two points or equal ones, where the waves span less than a factor
    of 2, and where no isotropic surface has such a C1D.

    >>> from scene import Spectrum
    >>> rough = Spectrum(q=[6e3, 6e4, 6e5], C2D=[4e-22, 3e-22, 1e-25], convention="jacobs")
    >>> print(f"{rough.rms_height:.3g} m, {rough.rms_slope(rough.q_max(0.0)):.3g}")
    4.5e-07 m, 0.054
    """

    q: Annotated[tuple[Annotated[Positive, RADIAN_PER_METRE], ...], ROW]
    convention: Literal["jacobs", "persson"] | None = None
    C2D: Annotated[tuple[Annotated[Positive, OF_SURFACE], ...], ROW] | None = None
    C1D: Annotated[tuple[Annotated[Positive, OF_LINE], ...], ROW] | None = None
    sides: Literal["one", "two"] | None = None
    longest_kept: Wavelength | None = None
    shortest_kept: Wavelength | None = None
    seed: Seed = 0
    amplitudes: Literal["fixed", "gaussian"] = "fixed"
    type: Literal["spectrum"] = Field(default="spectrum", repr=False)

    _of_a_table = restated(lambda cls, stated: _up_to_the_slope(cls, filled(stated, _read)))

    @model_validator(mode="after")
    def _is_one(self):
        if self.convention is None:
            raise ValueError(
                'state the convention of the density: "jacobs", <h^2> = 1/(2 pi) int q C2D dq = 1/pi int C1D dq, '
                'or "persson", <h^2> = 2 pi int q C2D dq = 2 int C1D dq, over q > 0 and with C1D of two sides'
            )
        if (self.C2D is None) == (self.C1D is None):
            raise ValueError("C2D of the surface [m^4] or C1D of its line scans [m^3]: give one of them")
        if self.C2D is not None and self.sides is not None:
            raise ValueError("sides belongs to C1D: C2D has none, leave it out")
        if self.C1D is not None and self.sides is None:
            raise ValueError('C1D: state sides = "two", or "one" where it is twice as large for q > 0')
        count, density = len(self.q), self.C2D or self.C1D or ()
        if count != len(density):
            raise ValueError(f"q has {count} values, and the density {len(density)}: one each")
        if not 2 <= count <= (MOST_OF_SURFACE if self.C1D is None else MOST_OF_LINE):
            raise ValueError(
                f"{count:,} points: from 2 to {MOST_OF_SURFACE:,} of C2D are taken, {MOST_OF_LINE:,} of C1D; "
                "average more of them in bands"
            )
        if len(set(self.q)) < count:
            twice = next(each for each in self.q if self.q.count(each) > 1)
            raise ValueError(f"q = {twice:g} rad/m is there twice: the density has one value at each")
        least, most = self.keepable[0], 2 * pi / min(self.q)
        low, high = self.shortest_kept or least, self.longest_kept or most
        if not least * (1 - QUOTIENT) <= low <= high * (1 + QUOTIENT) / 2 <= most * (1 + QUOTIENT) / 2:
            raise ValueError(
                f"waves from {low:g} m to {high:g} m, of those of q from {least:g} m to {most:g} m: the longest "
                "has to be at least twice as long as the shortest"
            )
        if not SHORTEST <= self.rms_height <= LONGEST:
            raise ValueError(f"an rms height of {self.rms_height:g} m: check the units of q and the density")
        return self

    @property
    def q_min(self) -> float:
        """Lowest wave number that is kept [rad/m]."""
        return float(self._kept.q[0])

    def q_max(self, pixel: float) -> float:
        """Highest wave number that is kept [rad/m]; the pixel of a grid does not matter."""
        return float(self._kept.q[-1])

    @property
    def longest(self) -> float:
        """Longest wavelength, and period of the surface [m]."""
        return 2 * pi / self.q_min

    @property
    def shortest(self) -> float:
        """Shortest wavelength [m]."""
        return 2 * pi / self.q_max(0.0)

    @property
    def keepable(self) -> tuple[float, float]:
        """Least and greatest `shortest_kept` [m]: the shortest wave of q, and half of the longest that is kept."""
        return 2 * pi / max(self.q), (self.longest_kept or 2 * pi / min(self.q)) / 2

    @property
    def rms_height(self) -> float:
        """Rms height of the waves that are kept [m]."""
        return sqrt(2 * pi * self._moment(1, 0.0, inf))

    @property
    def height_left_out(self) -> tuple[float, float]:
        """Shares of the mean square height in waves longer, and shorter, than are kept.

        Each is the share of these waves in the sum of them and the waves kept, if the laws of the first and of
        the last octave of q go on without an end; 1 where they then have no bound.
        """
        return self._left_out(1)

    @property
    def slope_left_out(self) -> tuple[float, float]:
        """Shares of the mean square slope in waves longer, and shorter, than are kept: see `height_left_out`."""
        return self._left_out(3)

    def _left_out(self, m):
        inside = self._moment(m, 0.0, inf)
        gaps = self._whole.moment(m, [0.0, self.q_max(0.0)], [self.q_min, inf]) + self._whole.beyond(m)
        longer, shorter = (float(each / (each + inside)) if isfinite(each) else 1.0 for each in gaps)
        return longer, shorter

    @property
    def notes(self) -> tuple[str, ...]:
        """Heights and slopes that the spectrum has, and those that it leaves out, a sentence each."""
        (long, short), (flat, steep) = (
            100 * np.array(each) for each in (self.height_left_out, self.slope_left_out)
        )
        return (
            f"the spectrum has waves from {self.shortest:.3g} m to {self.longest:.3g} m, an rms height of "
            f"{self.rms_height:.3g} m and an rms slope of the full gradient of {self.rms_slope(inf):.3g}",
            f"if it went on as it ends, longer waves would have {long:.3g} % of the mean square height and "
            f"{flat:.3g} % of the mean square slope, shorter waves {short:.3g} % and {steep:.3g} %",
        )

    def _moment(self, m, lower, upper):
        return self._kept.moment(m, lower, upper)

    @property
    def _whole(self) -> PowerLaws:
        assert self.convention
        return _density(self.q, self.C2D or self.C1D or (), self.convention, self.sides)

    @property
    def _kept(self) -> PowerLaws:
        return _cut(self._whole, self.longest_kept, self.shortest_kept)

    @property
    def _unit(self):
        return 1.0

    def _corners(self, q_max):
        return tuple(self._kept.q[:-1].tolist())

    def _relative(self, q):
        return self._kept(q)


def _read(table: Any, written: TableFormat) -> dict[str, Any]:
    """q and densities of a table, all above zero."""
    found = read_columns(table, COLUMNS, written)
    if ("q" in found) == ("frequency" in found):
        raise ValueError(
            f'{found.name}: one column q or frequency is needed: state its heading, as columns = {{q = "..."}}'
        )
    if "q" in found and found.units["q"] is None and any(found.units.values()):
        raise ValueError(
            f'{found.name}: column {found.headings["q"]!r} has no unit: state units = {{q = "rad/m"}}'
        )
    for name, values in found.items():
        found.refuse(name, values <= 0, "is not above zero: leave it out, as with where or rows")
    columns = dict(found)
    if "frequency" in columns:
        columns["q"] = 2 * pi * columns.pop("frequency")
    return columns


def _up_to_the_slope(cls, stated):
    """Fields with the shortest wave kept at which the rms slope reaches what is stated."""
    if "shortest_at_slope" not in stated:
        return stated
    slope = taken("shortest_at_slope", stated, slope_of)
    del stated["shortest_at_slope"]
    if stated.get("shortest_kept") is not None:
        raise ValueError(f"shortest_at_slope = {slope:g}: state no shortest_kept")
    try:
        whole = cls(**stated)
    except ValueError:
        return stated  # for the mistakes of the fields that have them
    low, high = whole.q_min, whole.q_max(0.0)

    def steepness(q):
        return sqrt(2 * pi * whole._moment(3, low, q))

    return stated | {"shortest_kept": wave_at_slope(slope, steepness, 2 * low, high)}


@lru_cache(maxsize=16)
def _density(q, stated, convention, sides):
    """C_2D [m^4] by the convention of `Isotropic`."""
    order, unit = np.argsort(q), CONVENTIONS[convention]
    places, density = np.array(q)[order], np.array(stated)[order] / unit
    if sides is None:
        return PowerLaws(places, density / unit)
    found = of_surface(PowerLaws(places, density / (2 if sides == "one" else 1)))
    if (wrong := ~(found.density > 0)).any():
        raise ValueError(
            f"C1D: at q = {found.q[wrong][0]:.3g} rad/m the surface would have a density below zero, and no "
            "isotropic surface has such line scans: C1D has to fall towards greater q, also at its end; average "
            "it over wider bands, or leave out points"
        )
    return found


@lru_cache(maxsize=16)
def _cut(whole, longest, shortest):
    ends = (2 * pi / longest if longest else 0.0, 2 * pi / shortest if shortest else inf)
    return whole.cut(*np.clip(ends, whole.q[0], whole.q[-1]))
