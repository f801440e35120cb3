"""Roughness that was measured along a line: an isotropic surface whose spectrum is fitted to the line."""

from dataclasses import replace
from functools import lru_cache
from math import pi, sqrt
from typing import Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from ..files.stated import alternatives, restated
from ..quantities import Length, Seed
from . import linescan
from .heightmap import DEGREES, LONGEST, SHORTEST, HeightLine, LineHeights, levelled
from .linescan import Interval, LineLaw
from .scanned import OF_A_FILE, QUOTIENT, prepared
from .selfaffine import SelfAffine


@dataclass(frozen=True, config=alternatives("heights", "spacing", **OF_A_FILE), kw_only=True)
class Profile:
    """Roughness of an isotropic surface that was measured along a line, as by a stylus.

    heights : along the line [m], evenly spaced; a table with a column of heights and maybe one of places
    spacing : of the points [m]; may be left out where places are known, in a table or an array with coordinates
    peaks : "up", heights grow towards the elastomer, as instruments give them; "down", the other way
    level : what is taken off the heights first, their "mean", the straight line ("tilt"), the parabola
        ("curvature") or the "cubic" that fits them best
    shortest_kept : waves shorter than this are left out, of the line and of the surface [m]
    seed : of the surface that is drawn, and of the point of the line under the axis: 0 is its middle

    In place of heights `file` is the path of a text or an array, see `heightfile`; `unit` of the heights is needed
    where it states none. `skip`, `rows`, `separator`, `decimal`, `encoding`, `columns`, `units` and `where` state
    what differs of a text, see `stated.TableFormat`. Missing heights are refused; missing = "fill" fills in up
    to 5 % on straight lines.

    Solvers take up `fitted`, a self-affine surface with the roll-off and the cut-off that the line shows: in 3D
    the surface, in 1D lines with C_1D = pi q C_2D; in 1D a line scan is the measured line itself. `law` has the
    intervals of the fit. Raises ValueError where there are less than 64 points, or no waves to fit.
    """

    heights: LineHeights
    spacing: Length
    peaks: Literal["up", "down"] = "up"
    level: Literal["mean", "tilt", "curvature", "cubic"] = "tilt"
    shortest_kept: Length | None = None
    seed: Seed = 0
    type: Literal["profile"] = Field(default="profile", repr=False)

    _prepared = restated(lambda cls, stated: prepared(cls, stated, HeightLine, "spacing"))

    @model_validator(mode="after")
    def _can_be_fitted(self):
        if not SHORTEST <= self.spacing <= LONGEST:
            raise ValueError(f"spacing = {self.spacing:g} m: from {SHORTEST:g} to {LONGEST:g} m")
        (least, most), kept = self.keepable, self.shortest_kept
        if kept is not None and not least * (1 - QUOTIENT) <= kept <= most:
            raise ValueError(
                f"shortest_kept = {kept:g} m: from two spacings, {least:g} m, to half of the line, {most:g} m"
            )
        law = self.law
        if law is not None and kept is not None and not kept < law.rolloff.value:
            raise ValueError(
                f"shortest_kept = {kept:g} m: the roll-off of the line is at "
                f"{law.rolloff.value:.3g} m, and waves below it have to be left"
            )
        return self

    @property
    def keepable(self) -> tuple[float, float]:
        """Least and greatest `shortest_kept` [m]: two spacings, and half of the line."""
        return 2 * self.spacing, self.length / 2

    @property
    def length(self) -> float:
        """Length of the line [m], a spacing for each point."""
        return self.heights.shape[0] * self.spacing

    @property
    def law(self) -> LineLaw | None:
        """Law of the isotropic surface with the intervals of its numbers; None of a flat line."""
        return _law(self.heights, self.spacing, self.level)

    @property
    def fitted(self) -> SelfAffine:
        """The surface that solvers take up. Waves longer than the line are not known, and left out."""
        law, shortest = self.law, 2 * self.spacing
        if law is None:
            return SelfAffine(hurst=1.0, rms_height=0.0, longest=self.length, shortest=shortest, seed=self.seed)
        shortest = max(shortest, law.shortest.value)
        whole = SelfAffine(
            hurst=law.hurst.value,
            rms_height=law.rms_height.value,
            longest=self.length,
            shortest=shortest,
            rolloff=None if law.rolloff.value >= self.length else law.rolloff.value,
            seed=self.seed,
        )
        kept = self.shortest_kept
        if kept is None or kept <= shortest:
            return whole
        left = whole.share(whole.q_min, 2 * pi / kept, whole.q_max(0.0))
        return replace(whole, rms_height=whole.rms_height * sqrt(left), shortest=kept)

    @property
    def relief(self) -> np.ndarray:
        """Heights above the elastomer along the line, levelled (N,) [m]."""
        return levelled(self.heights.heights, self.level) * (-1 if self.peaks == "up" else 1)

    @property
    def side(self) -> float:
        """Length of what repeats where the line is itself the rough line, with its mirror image [m]."""
        return 2 * self.length

    @property
    def top(self) -> int:
        """Number of the shortest wave of the measured line that is kept, on what repeats."""
        top = self.heights.shape[0] - 1
        return (
            top if self.shortest_kept is None else min(top, int(self.side / self.shortest_kept * (1 + QUOTIENT)))
        )

    @property
    def waves(self) -> np.ndarray:
        """Amplitudes of the waves k = 1, 2, ... of the measured line on what repeats (top,), complex [m].

        They pass through all points, and begin at the point under the axis: the middle one or a random one.
        """
        relief = self.relief
        count = len(relief)
        place = count // 2 if self.seed == 0 else int(np.random.default_rng(self.seed).integers(count))
        whole = np.concatenate([relief, relief[::-1]])
        return 2 * np.fft.rfft(np.roll(whole, -place), norm="forward")[1 : self.top + 1]

    @property
    def flat(self) -> bool:
        """Whether nothing is left of the heights once `level` is taken off."""
        return self.law is None

    @property
    def rms_height(self) -> float:
        """Rms height of the fitted surface [m]."""
        return self.fitted.rms_height

    @property
    def period(self) -> float:
        """Side of the square of the fitted surface that repeats [m]."""
        return self.length

    @property
    def longest(self) -> float:
        """Longest wavelength of the fitted surface [m]."""
        return self.length

    @property
    def shortest(self) -> float:
        """Shortest wavelength of the fitted surface [m]."""
        return 2 * pi / self.q_max(0.0)

    def q_max(self, pixel: float) -> float:
        """Highest wave number of the fitted surface [rad/m]; the pixel of a grid does not matter."""
        return self.fitted.q_max(pixel)

    def rms_slope(self, q_max: float) -> float:
        """Rms slope of the full gradient of the fitted surface [1] with the cut-off q_max [rad/m]."""
        return self.fitted.rms_slope(q_max)

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what was read and how it is used."""
        kept = self.shortest_kept
        left = () if kept is None else (f"waves shorter than {kept:.3g} m are left out, as shortest_kept states",)
        return (*self.heights.notes, *(() if self.law is None else _sentences(self.law)), *left)


def _sentences(law):
    yield (
        f"roughness is an isotropic surface fitted to a line: Hurst exponent {_in_words(law.hurst)}, rms height "
        f"{_in_words(law.rms_height, ' m')}, rms slope of the full gradient {_in_words(law.rms_slope)}, roll-off "
        f"{_in_words(law.rolloff, ' m')}, shortest wave {_in_words(law.shortest, ' m')}; intervals of 95 % are "
        "those of the fit alone"
    )
    if law.rolloff.value < law.length:
        lengths = Interval(*(law.length / each for each in (law.rolloff.value, law.rolloff.high, law.rolloff.low)))
        yield f"the line has {_in_words(lengths)} correlation lengths, counted by its roll-off"
    else:
        yield (
            f"the line of {law.length:.3g} m shows no roll-off, so it is less than a correlation length: how high "
            "longer waves are is not known"
        )
    if law.cutoff:
        yield (
            f"waves of the line that are shorter than the cut-off are left out: they have "
            f"{100 * law.beyond:.2g} % of the mean square slope between its points"
        )
    else:
        yield "the spectrum goes on to two spacings of the line: shorter waves, and how steep, are not known"
    if not law.follows:
        yield (
            "the line scatters about a self-affine law more than a Gaussian one does: it may be none, and the "
            "intervals say too little"
        )
    yield (
        'in 1D rough lines are drawn by C_1D = pi q C_2D of this surface; spectrum = "line-scan" of MDR takes the '
        "measured line itself"
    )


def _in_words(number: Interval, unit: str = "") -> str:
    return f"{number.value:.3g}{unit} ({number.low:.3g} to {number.high:.3g}{unit})"


@lru_cache(maxsize=8)
def _law(heights, spacing, level):
    relief = levelled(heights.heights, level)
    return linescan.fit(relief, spacing, DEGREES[level]) if relief.any() else None
