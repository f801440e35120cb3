"""The claims of the paper, each with what the simulation measures and whether it holds."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from math import isfinite, sqrt

import numpy as np

from ..finding import verdict
from ..statistics.jackknife import interval, standard_error
from .campaign import line
from .conditions import gathered
from .law import Law
from .parameters import Loss
from .predicted import CONSTANT, STIFFNESS
from .reproduction import Reproduction
from .shifts import STRAIGHT, Shifted, exponent_of


@dataclass(frozen=True)
class Claim:
    """One claim: a number that the paper states or implies, and what is measured of it.

    name, figure : what is claimed, and the name of the figure that shows it
    expected, tolerance : the number, and how far from it still counts as it, absolute
    value, low, high : measured, with its interval of 95 %; NaN where it cannot be had
    text : how it was measured, and what a deviation means
    undecidable : why there is no verdict whatever the number; empty if there may be one
    """

    name: str
    figure: str
    expected: float
    tolerance: float
    value: float
    low: float
    high: float
    text: str
    undecidable: str = ""

    @property
    def verdict(self) -> str:
        """holds, fails or undecided, from the interval."""
        return "undecided" if self.undecidable else verdict(self.expected, self.tolerance, self.low, self.high)

    @property
    def row(self) -> dict:
        """Every field and the verdict."""
        return asdict(self) | {"verdict": self.verdict}

    @property
    def written(self) -> str:
        """Value and interval in words."""
        if not isfinite(self.value):
            return "undecided"
        if not (isfinite(self.low) and isfinite(self.high)):
            return f"{self.value:.4g}, interval undecided"
        if self.low == self.high:
            return f"{self.value:.4g}"
        return f"{self.value:.4g} ({self.low:.4g} to {self.high:.4g})"


def claims(found: Reproduction) -> list[Claim]:
    """Every claim, in the order of the paper."""
    return [*_slope_one(found), *_alphas(found), *_plateaus(found.laws), *_shifts(found)]


def _slope_one(found) -> Iterator[Claim]:
    """Eq. 17: on all points, where its conditions hold, and with the macroscopic slope kept."""
    collapse = found.collapse
    flags = collapse.conditions.flags
    slow = flags["xi << 1"] & flags["2a < L"] & flags["h0 << d"]
    steepness = collapse.regime.rms_slope[collapse.holds]
    cases = (
        (
            "where its conditions hold",
            collapse.holds,
            1.0,
            "points with xi at most 0.05, h_0 at most d/10, 2a below L, and a macroscopic slope of at most a "
            f"fifth of that of the roughness. Small slopes are not among the conditions: {_slopes(steepness)}",
        ),
        (
            "whatever the macroscopic slope",
            slow,
            1.0,
            "of the same without the last condition: Eq. 11 drops the slope of the macroscopic profile, which on "
            "a nearly smooth one makes all the friction",
        ),
        (
            "whatever the macroscopic slope, which is kept as in Eq. 10",
            slow,
            collapse.with_macro_slope,
            "of the same, with the mean square of both slopes in place of that of the roughness",
        ),
    )
    for name, where, over, text in cases:
        fit = line(collapse, where, over)
        yield Claim(
            name=f"Eq. 17, friction at low speed grows as xi^1, {name}",
            figure="paper-studies",
            expected=1.0,
            tolerance=0.02,
            value=fit.slope,
            low=fit.slope_interval[0],
            high=fit.slope_interval[1],
            text=f"Exponent of a power law through {fit.points} {text}. The factor is {fit.factor:.3f}, and the "
            f"farthest point is off xi by {fit.worst:.2g} of it.",
        )


def _alphas(found) -> Iterator[Claim]:
    for law in found.laws:
        worst = law.deviation[np.argmax(np.abs(law.deviation))]
        criteria = ", ".join(f"{alpha:.3f} ({name})" for name, alpha in law.by_criterion.items())
        yield Claim(
            name=f"Eq. 19, best alpha, {law.shape}",
            figure="paper-law",
            expected=1.5,
            tolerance=0.1,
            value=law.alpha,
            low=law.alpha_interval[0],
            high=law.alpha_interval[1],
            text=f"Least squares of ln mu over {law.xi.size} values of xi from {law.xi[0]:g} to {law.xi[-1]:g}. "
            f"The interval is of the sampling of profiles alone; {law.left}. By what is made least alpha is "
            f"{criteria}. With alpha = 1.5 the law is at most {abs(worst):.1%} off.",
        )
    one, other = found.laws
    count = min(one.alphas.size, other.alphas.size)
    difference = one.alpha - other.alpha
    error = float(standard_error(one.alphas[:count] - other.alphas[:count]))
    low, high = interval(difference, error, count - 1)
    yield Claim(
        name=f"alpha does not depend on the shape: {one.shape} minus {other.shape}",
        figure="paper-law",
        expected=0.0,
        tolerance=0.1,
        value=difference,
        low=low,
        high=high,
        text="Difference of the two, on the same profiles. With every place of the contact taken for a rough "
        f"plane pressed as deep as it is there, alpha is {one.planes_alpha:.2f} and {other.planes_alpha:.2f}: "
        "places of a cone differ more in depth, and lose contact over a wider range of speeds.",
    )


def _plateaus(laws: tuple[Law, ...]) -> Iterator[Claim]:
    for law in laws:
        low, high = interval(law.plateau, law.plateau_error, law.alphas.size - 1)
        yield Claim(
            name=f"Eq. 14, the plateau is sqrt(2) times the rms slope, {law.shape}",
            figure="paper-law",
            expected=1.0,
            tolerance=0.03,
            value=law.plateau,
            low=low,
            high=high,
            text=f"mu-tilde at xi = {law.xi[-1]:g} over Eq. 19 there, with the rms slope by finite differences.",
        )


def _slopes(steepness) -> str:
    if not steepness.size:
        return "no point is left"
    return (
        f"slopes are {steepness.min():.2g} to {steepness.max():.2g} here. With heights, the slope of the cone and "
        "the load times any number, friction is times that number exactly: the same collapse holds at any slope"
    )


def _shifts(found) -> Iterator[Claim]:
    for lossy in found.losses:
        for name, shifted in (("friction", lossy.whole), ("friction less that of the smooth body", lossy.rough)):
            yield _collapse(lossy.loss, name, shifted)
            yield _exponent(lossy.loss, name, shifted)


def _collapse(loss: Loss, name: str, shifted: Shifted) -> Claim:
    """Whether horizontal shifts bring the curves onto one, by what they still miss over their scatter."""
    found, asked = shifted.collapse, f"horizontal shifts bring {name} onto one curve"
    missed = sqrt(found.after.chi_square)
    why = "the curves only part" if not found.overlaps else "" if found.separable else STRAIGHT
    return Claim(
        name=f"Fig. 7, {asked}, {_of(loss)}: what is missed over the scatter",
        figure=f"shifted-curves{loss.suffix}",
        expected=0.0,
        tolerance=sqrt(1 + 2 * sqrt(2 / found.after.freedom)),
        value=missed,
        low=missed,
        high=missed,
        text=f"Eq. 23. Shifted, the curves miss one another by {found.after.rms:.1%}, and points scatter by "
        f"{found.scatter:.1%}; counted is the root of chi square per degree of freedom, which may exceed one by "
        f"two standard deviations.{f' Undecided: {why}.' if why else ''}",
        undecidable=why,
    )


def _exponent(loss: Loss, name: str, shifted: Shifted) -> Claim:
    """The power of the speed in those shifts, which the collapse has to give a meaning first."""
    low, high = shifted.within
    expected = exponent_of(loss)
    return Claim(
        name=f"Fig. 7, exponent of the shift of {name} against the speed, {_of(loss)}",
        figure=f"shifted-curves{loss.suffix}",
        expected=expected,
        tolerance=0.05 * abs(expected),
        value=shifted.exponent,
        low=low,
        high=high,
        text=f"{_meant(shifted, expected)} {_modulus(shifted)}",
    )


def _of(loss: Loss) -> str:
    return f"loss ~ frequency^{loss.exponent:g}, tau = {loss.relaxation_time:g} s"


def _meant(shifted: Shifted, expected: float) -> str:
    """What the exponent is, and whether what is expected lies within its interval."""
    if not shifted.collapse.overlaps:
        return "The misfit only falls as the curves are pulled apart: no shift has an exponent."
    if not shifted.decided:
        return "The curves do not collapse: their shifts mean nothing, and have no exponent."
    taken = "" if shifted.collapse.separable else f"Shifts are taken for horizontal, of {STRAIGHT}. "
    low, high = shifted.within
    if not (isfinite(low) and isfinite(high)):
        return f"{taken}Its interval cannot be had."
    inside = "within" if low <= expected <= high else "outside"
    return (
        f"{taken}The interval is of the sampling of profiles; {expected:g} itself lies {inside} it, and "
        "what is up to 5 % off it counts as it."
    )


def _modulus(shifted: Shifted) -> str:
    """Whether the assumption of a constant macroscopic modulus is kept."""
    ratio = gathered(shifted.conditions).ratios[STIFFNESS]
    kept = "is constant within a tenth, as" if ratio.max() <= CONSTANT else "is not constant, which"
    return (
        f"On the scale of the contact the modulus, G(v/a) in magnitude, is {ratio.min():.2f} to {ratio.max():.2f} "
        f"times G_0: it {kept} the paper presupposes."
    )
