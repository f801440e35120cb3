"""Roughness by a measured spectral density, from which each solver draws its own surface."""

from dataclasses import replace
from functools import lru_cache
from itertools import pairwise
from math import inf, isfinite, pi, sqrt
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import ConfigDict, Field, TypeAdapter, model_validator
from pydantic.dataclasses import dataclass

from .heightmap import LONGEST, SHORTEST
from .isotropic import Isotropic
from .powerlaws import PowerLaws, of_surface
from .quantities import CLOSED, METRE, RADIAN_PER_METRE, ROW, Positive, Seed, Unit, by_name, some_of, takes
from .scanned import QUOTIENT
from .selfaffine import Wavelength
from .tablefile import Column, TableFormat, read_columns, refused, split_format

MOST_OF_SURFACE, MOST_OF_LINE = 5_000, 1_000  # points; a line has to be inverted
PER_METRE = Unit("1/m", "waves in a length", "0.1 1/um", 1e5)
OF_SURFACE = Unit("m^4", "a spectral density of a surface", "2 um^4", 2e-24)
OF_LINE = Unit("m^3", "a spectral density of a line", "2 um^3", 2e-18)
# <h^2> as an integral over wave vectors here, as one over these divided by 2 pi there.
CONVENTIONS = {"persson": 1.0, "jacobs": 2 * pi}

COLUMNS = (
    Column("q", ("wavevector", "wave vector"), (RADIAN_PER_METRE, PER_METRE)),
    Column("frequency", ("spatial frequency",), (PER_METRE,)),
    Column("C2D", ("C_iso",), (OF_SURFACE,)),
    Column("C1D", (), (OF_LINE,)),
)
_FREQUENCY: dict[str, Any] = {"frequency": Annotated[tuple[Annotated[Positive, PER_METRE], ...], ROW]}


def _or_table(schema: dict[str, Any]) -> None:
    """In JSON schema: a table in place of q and a density, frequencies in place of q."""
    properties = schema["properties"]
    properties |= {"table": {"type": "string"}, "frequency": TypeAdapter(_FREQUENCY["frequency"]).json_schema()}
    properties |= TypeAdapter(TableFormat).json_schema()["properties"]
    schema["required"] = ["convention"]
    schema["anyOf"] = [{"required": [name]} for name in ("table", "q", "frequency")]


@dataclass(frozen=True, config=ConfigDict(**CLOSED, json_schema_extra=_or_table), kw_only=True)
class Spectrum(Isotropic):
    """Randomly rough and isotropic, with a measured spectral density.

    q : wave numbers 2 pi / wavelength [rad/m], in any order (N,); or `frequency`, 1 / wavelength [1/m]
    C2D : density of the surface at them (N,) [m^4]
    C1D : in place of C2D, density of line scans of the surface (N,) [m^3]
    convention : of the density, which has to be stated: "jacobs", <h^2> = 1/(2 pi) int q C2D dq (Jacobs, Junge and
        Pastewka, Surf. Topogr. 5, 013001, 2017), or "persson", <h^2> = 2 pi int q C2D dq, a density smaller by
        4 pi^2. C1D of two sides has <h^2> = 1/pi int C1D dq, or 2 int C1D dq, over q > 0
    sides : of C1D, "two", or "one" where C1D is twice as large, as all of <h^2> is ascribed to q > 0
    longest_kept, shortest_kept : longer and shorter waves are left out [m]; absent, those of q stay
    seed, amplitudes : see `SelfAffine`

    Between the points the density is a power law, outside it is zero. C1D is turned into C2D by Abel's inversion,
    in which C1D goes on beyond its last point by the law of its last octave. The longest wave is the period of the
    surface.

    In place of q and the density `table` is the path of a text file, relative to the folder of a scene file that
    names it, a DataFrame, a Dataset of xarray or arrays by name, with columns of these names; q, in rad/m or 1/m,
    is 2 pi / wavelength. `columns`, `units`, `where`, `separator`, `decimal`, `encoding`, `skip` and `rows` state
    how it differs from the documented form of tables, see `tablefile.TableFormat`.

    Raises ValueError where there are fewer than two points or equal ones, where the waves span less than a factor
    of 2, and where no isotropic surface has such a C1D.

    >>> from scene import Spectrum
    >>> rough = Spectrum(q=[6e3, 6e4, 6e5], C2D=[4e-18, 3e-18, 1e-21], convention="jacobs")
    >>> print(f"{rough.rms_height:.3g} m, {rough.rms_slope(rough.q_max(0.0)):.3g}")
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

    @model_validator(mode="before")
    @classmethod
    def _read(cls, given: Any) -> Any:
        stated = by_name(given)
        if stated is None:
            return given
        written, stated = split_format(stated)
        if "table" in stated:
            table = stated.pop("table")
            if twice := {each.field for each in COLUMNS} & set(stated):
                raise ValueError(f"{min(twice)} beside table: give one of them")
            try:
                stated |= _of_table(table, written)
            except ValueError as error:
                raise refused(table, error) from error
        elif written != TableFormat():
            raise ValueError("columns, units, skip and so on are of a table: give table")
        if "frequency" in stated:
            if "q" in stated:
                raise ValueError("frequency beside q = 2 pi frequency: give one of them")
            (found,) = some_of(_FREQUENCY, stated).values()
            del stated["frequency"]
            stated["q"] = tuple(2 * pi * each for each in found)
        return stated

    @model_validator(mode="after")
    def _has_a_surface(self):
        if (self.C2D is None) == (self.C1D is None):
            raise ValueError("C2D of the surface [m^4] or C1D of its line scans [m^3]: give one of them")
        if (self.C1D is None) != (self.sides is None):
            raise ValueError(
                "sides belongs to C1D: C2D has none, leave it out"
                if self.C1D is None
                else 'C1D: state sides = "two", or "one" where the density is twice as large for q > 0'
            )
        if self.convention is None:
            raise ValueError(
                'state the convention of the density: "jacobs", <h^2> = 1/(2 pi) int q C2D dq = 1/pi int C1D dq, '
                'or "persson", <h^2> = 2 pi int q C2D dq = 2 int C1D dq, over q > 0 and with C1D of two sides'
            )
        density = self.C2D or self.C1D or ()
        if len(self.q) != len(density):
            raise ValueError(f"q has {len(self.q)} values, and the density {len(density)}: one each")
        most_points = MOST_OF_SURFACE if self.C1D is None else MOST_OF_LINE
        if not 2 <= len(self.q) <= most_points:
            raise ValueError(
                f"{len(self.q):,} points: from 2 to {most_points:,} are taken; average more of them in bands"
            )
        ordered = sorted(self.q)
        if twice := [low for low, high in pairwise(ordered) if low == high]:
            raise ValueError(f"q = {twice[0]:g} rad/m is there twice: the density has one value at each")
        least, most = 2 * pi / ordered[-1], 2 * pi / ordered[0]
        for name in ("longest_kept", "shortest_kept"):
            kept = getattr(self, name)
            if kept is not None and not least * (1 - QUOTIENT) <= kept <= most * (1 + QUOTIENT):
                raise ValueError(f"{name} = {kept:g} m: the waves of q are from {least:g} m to {most:g} m")
        least, most = self.shortest_kept or least, self.longest_kept or most
        if not 2 * least <= most * (1 + QUOTIENT):
            raise ValueError(f"waves from {least:g} m to {most:g} m: the longest has to be at least twice as long")
        if not SHORTEST <= self.rms_height <= LONGEST:
            raise ValueError(f"an rms height of {self.rms_height:g} m: check the units of q and the density")
        return self

    @property
    def q_min(self) -> float:
        """Lowest wave number that is kept [rad/m]."""
        return float(self._laws[1].q[0])

    @takes(pixel=METRE)
    def q_max(self, pixel: float) -> float:
        """Highest wave number that is kept [rad/m]; the pixel of a grid does not matter."""
        return float(self._laws[1].q[-1])

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
        return 2 * pi / max(self.q), self.longest / 2

    @property
    def rms_height(self) -> float:
        """Rms height of the waves that are kept [m]."""
        return sqrt(2 * pi * self.moment(1, 0.0, inf))

    @property
    def normalized(self) -> "Spectrum":
        """The same spectrum at an rms height of 1 m."""
        name, square = "C1D" if self.C2D is None else "C2D", self.rms_height**2
        changed: dict[str, Any] = {name: tuple(each / square for each in getattr(self, name))}
        return replace(self, **changed)

    def left_out(self, m: int) -> tuple[float, float]:
        """Shares of the mean square height (m = 1) or slope (m = 3) in waves longer, and shorter, than are kept.

        Each share is that of these waves in their sum with those that are kept, if the laws of the first and of
        the last octave of the table go on without an end; 1 where they then have no bound.
        """
        whole, kept = self._laws
        gaps = whole.moment(m, [0.0, kept.q[-1]], [kept.q[0], inf])
        longer, shorter = (
            each / (each + self.moment(m, 0.0, inf)) if isfinite(each) else 1.0
            for each in (gaps + whole.beyond(m)).tolist()
        )
        return longer, shorter

    @property
    def notes(self) -> tuple[str, ...]:
        """What the spectrum has, and what it leaves out, a sentence each."""
        height, slope = self.left_out(1), self.left_out(3)
        longer, shorter = (
            f"{100 * high:.3g} % of the mean square height and {100 * steep:.3g} % of the mean square slope"
            for high, steep in zip(height, slope, strict=True)
        )
        return (
            f"the spectrum has waves from {self.shortest:.3g} m to {self.longest:.3g} m, an rms height of "
            f"{self.rms_height:.3g} m and an rms slope of the full gradient of {self.rms_slope(inf):.3g}",
            f"if it went on as it ends, longer waves would have {longer}, shorter waves {shorter}",
        )

    @property
    def _laws(self) -> tuple[PowerLaws, PowerLaws]:
        """Density of the surface [m^4] by the convention of `Isotropic`: the whole, and what is kept of it."""
        line = None if self.C1D is None or self.sides is None else (self.C1D, self.sides)
        return _laws(self.q, self.C2D, line, self.convention, self.longest_kept, self.shortest_kept)

    @property
    def _unit(self):
        return 1.0

    def _corners(self, q_max):
        return tuple(self._laws[1].q[:-1].tolist())

    def _relative(self, q):
        return self._laws[1](q)

    def moment(self, m, lower, upper):
        """int q^m C_2D dq of the waves that are kept, from lower to upper [rad/m], arrays allowed; in SI."""
        return self._laws[1].moment(m, lower, upper)


def _of_table(table: Any, written: TableFormat) -> dict[str, Any]:
    """Columns of a table, all above zero, as fields."""
    found = read_columns(table, COLUMNS, written)
    for pair in (("q", "frequency"), ("C2D", "C1D")):
        there = [name for name in pair if name in found]
        taken = [name for name in there if name in (written.columns or {})] or there
        if len(taken) != 1:
            raise ValueError(
                f"{found.name}: one column {' or '.join(pair)} is needed, not {len(taken)}: state its heading, as "
                f'columns = {{{pair[0]} = "..."}}'
            )
        found.values = {name: each for name, each in found.values.items() if name in taken or name not in pair}
    if "q" in found and found.units["q"] is None and any(found.units.values()):
        raise ValueError(
            f'{found.name}: column {found.headings["q"]!r} has no unit: state units = {{q = "rad/m"}}'
        )
    for name, values in found.values.items():
        found.refuse(name, values <= 0, "is not above zero: leave it out, as with where or rows")
    return {name: tuple(values.tolist()) for name, values in found.values.items()}


@lru_cache(maxsize=16)
def _laws(q, surface, line, convention, longest, shortest):
    order, unit = np.argsort(q), CONVENTIONS[convention]
    places = np.array(q)[order]
    if line is None:
        density = np.array(surface)[order] / unit**2
    else:
        values, sides = line
        scans = PowerLaws(places, np.array(values)[order] / unit / (2 if sides == "one" else 1))
        places, density = of_surface(scans)
        if not (density > 0).all():
            raise ValueError(
                f"C1D: at q = {places[np.argmin(density > 0)]:.3g} rad/m the surface would have a density below "
                "zero, and no isotropic surface has such line scans: C1D has to fall towards greater q, also at "
                "its end; average it over wider bands, or leave out points"
            )
    whole = PowerLaws(places, density)
    ends = (2 * pi / longest if longest else places[0], 2 * pi / shortest if shortest else places[-1])
    return whole, whole.cut(*np.clip(ends, places[0], places[-1]))
