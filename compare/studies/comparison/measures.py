"""Rows of claims: where each can be stated, and what measures it on the answers; those on a rough series.

A new claim is a row here with a function of a few lines, and its words in `claims`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np

from scene import Program, Scene
from scene.scales import MUCH_LESS_HEIGHT, elastic_contact

from ...models import exact
from ...models.exact.indentation import force_of_depth
from ...models.table import DEPTH, FRICTION, PROFILES, Model
from ...solving.curve import Curve
from ...statistics.jackknife import draws_of, friction, mean, off_the_ratio
from .answers import CONTACT, Answers
from .claims import ENDS, geometric, power
from .laws import Laws

if TYPE_CHECKING:
    import xarray

ROUGH, SMOOTH = "rough", "smooth"  # curves of a rough series, by the body
# Slow: the loss tangent of the shortest wave, v times the longest time over it, and xi, below which friction is
# off its limit by less than the tolerance. Above FAST Eq. 19 is within 12 % of its plateau.
SLOW, FAST = 0.1, 3.0
# Ratio of xi to 1, or of 1 to xi, up to which the closest speed is at the knee.
AT_THE_KNEE = 3.0
SLOW_CAUSES = "curvature_by_pressure", "rms_slope_contact", "contact_length"  # of slow friction

# Ending of an id, or words of a place, and the place of speeds and values.
Place = tuple[str, Any]


@dataclass(frozen=True)
class Here:
    """A place of a series at which claims are stated on a model.

    series, model, answers : what is judged, see `series.Series`
    laws : of the model, or of the reference that it is compared with; None where it does not slide
    place : of speeds and values; all where none is chosen
    """

    series: Any
    model: Model
    answers: Answers
    laws: Laws | None
    place: Any = ...

    @property
    def regime(self) -> str:
        """Ranges of load and xi of the place in words; empty where it does not slide."""
        return "" if self.laws is None else self.laws.words(self.place)

    @property
    def curve(self) -> Curve:
        """Curve of a rough series."""
        return self.series.curves[ROUGH]

    @property
    def rates(self) -> tuple[float, ...]:
        """Speeds at which the bodies of a rough series are pressed in [m/s]; none of others."""
        return self.curve.speeds[1:] if isinstance(self.series.scene.motion, Program) else ()

    @property
    def rule(self) -> Laws:
        """Laws of the model, which slides."""
        assert self.laws is not None
        return self.laws

    @property
    def slow(self) -> bool:
        """Whether the slowest speed is in the limit of low speed."""
        if self.laws is None:
            return False
        known = self.laws.xi[0][np.isfinite(self.laws.xi[0])]
        slow = known.size > 0 and known.max() <= SLOW and self.laws.slowest_loss <= SLOW
        return len(self.laws.speeds) > 1 and bool(slow)

    @property
    def limits(self) -> dict[str, tuple[int, np.ndarray]]:
        """Places of the speeds by where they lie on the law, each with the loads or depths at which they do.

        slow, knee, fast : in the limit of low speed; where the median of xi is closest to 1; on the plateau
        below, above : slowest and fastest, where the median is below and above 1 and they are not at the knee
        slowest : whatever xi is
        """
        if self.laws is None:
            return {}
        xi = [row[np.isfinite(row)] for row in self.rule.xi]
        middle = np.array([np.exp(np.median(np.log(row))) if row.size else nan for row in xi])
        away = np.nan_to_num(np.abs(np.log(middle)), nan=np.inf)
        knee, last, fast = int(np.argmin(away)), len(xi) - 1, self.rule.xi[-1] >= FAST
        at_knee = away[knee] <= np.log(AT_THE_KNEE)
        found = {
            "slow": (0, self.slow),
            "knee": (knee, at_knee),
            "fast": (-1, fast),
            "below": (0, middle[0] < 1 and not (at_knee and knee == 0)),
            "above": (last, middle[last] > 1 and not (at_knee and knee == last)),
            "slowest": (0, True),
        }
        everywhere = np.full(self.rule.xi.shape[1], True)
        return {name: (speed, everywhere & known) for name, (speed, known) in found.items() if np.any(known)}

    def force(self, it: xarray.Dataset) -> np.ndarray:
        """Mean normal force where it moves, (speeds, values)."""
        return mean(it, "normal_force")[1:]

    def xi(self, it: xarray.Dataset) -> np.ndarray:
        """xi where it moves, at the load of the answers."""
        return self.rule.xi_under(self.force(it))

    def over_law(self, it: xarray.Dataset) -> np.ndarray:
        """Friction divided by the friction of Eq. 19."""
        return friction(it)[1:] / self.rule.law_of(self.xi(it))


Where = Callable[[Here], Iterator[Place]]


@dataclass(frozen=True)
class Row:
    """A claim: where it is stated, and what measures it.

    id : of the claim, with {quantity} in place of depth or force, and without the ending of its place
    where : places at which it can be stated
    measure : of a place and the answers of a model, or of a model and the reference; a number, or an array whose
        root mean square counts
    pair : whether it compares a model with the reference
    quantity : that models must have a claim on; depth or force, what is not prescribed, where it is empty
    curve : that it is measured on
    expected : number that the law has there; if None, the number of the claim
    each : whether the measure covers all speeds and values at once, with a finding for each place
    size : whether the number is never negative
    """

    id: str
    where: Where
    measure: Callable[..., Any]
    pair: bool = False
    quantity: str = FRICTION
    curve: str = ROUGH
    expected: Callable[[Here], float | None] = lambda here: None
    each: bool = False
    size: bool = False


def at(place: Any, when: Callable[[Here], Any] = lambda here: True) -> Where:
    """One place of speeds and values, where something is so."""
    return lambda here: iter([("", place)] if when(here) else [])


def ends(limit: str) -> Where:
    """Least and greatest load or depth at one of the speeds of `Here.limits`; one alone is the least."""

    def where(here: Here) -> Iterator[Place]:
        if limit in here.limits:
            speed, values = here.limits[limit]
            known = dict.fromkeys(np.flatnonzero(values)[[0, -1]].tolist())
            yield from ((f"-{end}", (speed, value)) for end, value in zip(ENDS, known, strict=False))

    return where


def along(limit: str) -> Where:
    """All loads or depths at one of the speeds of `Here.limits`, two at least."""

    def where(here: Here) -> Iterator[Place]:
        if limit in here.limits and here.limits[limit][1].sum() > 1:
            yield "", here.limits[limit]

    return where


everywhere = at(..., lambda here: here.laws is not None)

# Friction in each dimensionality: Eqs. 14 to 19.


def speed_exponent(here: Here, it: xarray.Dataset) -> float:
    slow, next_to_it = friction(it)[1:3]
    speeds = here.rule.speeds
    return float(np.mean(np.log(next_to_it / slow)) / np.log(speeds[1] / speeds[0]))


def with_load(*names: str) -> Callable[[Here, xarray.Dataset], float]:
    """Exponent of a mean, or of the ratio of two, at the slowest speed as a power of the load.

    names : of variables; "contact" is the length of real contact in one dimension, its area in three
    """

    def measure(here: Here, it: xarray.Dataset) -> float:
        own = [CONTACT[here.model.draws] if name == "contact" else name for name in names]
        return power(here.force(it)[0], mean(it, *own)[1])

    return measure


def nominal_exponent(here: Here) -> float:
    """d ln of the nominal contact, a length (1D) or an area (3D), over d ln F_N."""
    return (1 + here.rule.exponent_of_load) * (1 if here.model.draws == PROFILES else 2)


def over_slow_law(here: Here, it: xarray.Dataset) -> float:
    return geometric((friction(it)[1:] / (here.rule.plateau * here.xi(it)))[here.place])


def slow_solid(here: Here) -> bool:
    """Whether every mode of the solid is fast against the slowest speed, so that the limit can be seen."""
    longest = here.series.scene.solid.retardation()[2].max()
    return here.slow and here.rule.wave_number * here.rule.speeds[0] * longest <= SLOW


def over_limit(here: Here, it: xarray.Dataset) -> float:
    """Friction at the slowest speed over what the contact at rest gives in the limit of low speed."""
    rest, solid = it.isel(speed=0), here.series.scene.solid
    lagged = here.rule.speeds[0], exact.mean_lag(solid)
    force, *causes = (draws_of(rest, name) if name in rest else nan for name in ("normal_force", *SLOW_CAUSES))
    curvature, slope, length = causes
    if here.model.draws == PROFILES or "curvature_by_pressure" not in rest:
        drag = exact.slow_friction_by_slope(*lagged, solid.indentation_modulus, slope, length)
    else:
        drag = exact.slow_friction_by_curvature(*lagged, force, curvature)
    return geometric(friction(it)[1] / off_the_ratio(drag, force)[0])


def over_law(here: Here, it: xarray.Dataset) -> float:
    return geometric(here.over_law(it)[here.place])


def law_with_load(here: Here, it: xarray.Dataset) -> float:
    return power(here.force(it)[here.place], here.over_law(it)[here.place])


# Ratio of friction in 1D to friction in 3D.


def ratio(here: Here, one: xarray.Dataset, three: xarray.Dataset) -> float:
    """Friction in 1D over 3D."""
    return geometric((friction(one) / friction(three))[1:][here.place])


# Force and depth: smooth bodies against closed forms, rough ones in one dimension against three.


def closed_forms(curve: Curve) -> tuple[np.ndarray, np.ndarray]:
    """Load [N] and depth [m] of the smooth body at rest at each load or depth: Galin and Sneddon."""
    contacts = [elastic_contact(curve.at(value)) for value in curve.values]
    return np.array([contact.load for contact in contacts]), np.array([contact.depth for contact in contacts])


def loading(scene: Scene, rates: Sequence[float], reached: np.ndarray) -> np.ndarray:
    """Force [N] on the smooth body pressed in at constant rates [m/s], (rates, depths): Lee and Radok.

    reached : depths [m], (rates, depths). A march answers for the middle of its last step, half a step before the
        end
    """
    forces = np.full(reached.shape, nan)
    for (row, column), depth in np.ndenumerate(reached):
        if depth > 0:
            times, depths = (0.0, float(depth) / rates[row]), (0.0, float(depth))
            force, _ = force_of_depth(scene.indenter, scene.elastomer, times, depths, times[1:])
            forces[row, column] = force[0]
    return forces


def over_closed_form(here: Here, it: xarray.Dataset) -> np.ndarray:
    load, depth = closed_forms(here.curve)
    name, known = ("depth_reached", depth) if here.series.pressed == DEPTH else ("normal_force", load)
    return mean(it, name)[0] / known - 1


def over_smooth(here: Here, it: xarray.Dataset) -> np.ndarray:
    """Force divided by the force on the smooth body in closed form, (rates, depths)."""
    return here.force(it) / loading(here.series.scene, here.rates, mean(it, "depth_reached")[1:])


def on_side(here: Here, is_deep: bool) -> np.ndarray:
    """Loads or depths at which roughness is small against depth, or is not."""
    deep = closed_forms(here.curve)[1] * MUCH_LESS_HEIGHT >= here.series.scene.roughness.rms_height
    return deep == is_deep


def reaches(here: Here, is_deep: bool) -> bool:
    """Whether some loads or depths are deep, or not."""
    return bool(on_side(here, is_deep).any())


def depth_apart(here: Here, one: xarray.Dataset, three: xarray.Dataset, is_deep: bool) -> np.ndarray:
    """By how much depth or force there is another in 1D, where it is deep, or not."""
    if here.series.pressed == DEPTH:
        off = (mean(one, "depth_reached")[0] - mean(three, "depth_reached")[0]) / closed_forms(here.curve)[1]
    else:
        off = np.log(mean(one, "normal_force")[0]) - np.log(mean(three, "normal_force")[0])
    return off[on_side(here, is_deep)]


def stiffer(here: Here, one: xarray.Dataset, three: xarray.Dataset) -> np.ndarray:
    """ln of the ratio of the stiffness between neighbouring loads or depths."""
    stiff, other = (
        np.diff(mean(each, "normal_force")[0]) / np.diff(mean(each, "depth_reached")[0]) for each in (one, three)
    )
    return np.log(stiff / other)


def pressed_apart(here: Here, one: xarray.Dataset, three: xarray.Dataset) -> float:
    first, other = (over_smooth(here, each)[here.place, -1] for each in (one, three))
    return float(np.log(first / other))


def at_rates(least: int) -> Callable[[Here], bool]:
    """Whether bodies are pressed in at this number of rates or more."""
    return lambda here: len(here.rates) >= least


# Claims on a rough series.
ROWS = [
    Row(
        "eq17.speed-exponent",
        at(slice(2), lambda here: here.slow),
        speed_exponent,
        expected=lambda here: float(here.rule.loss_exponent[0]),
    ),
    Row(
        "eq17.load-exponent",
        along("slow"),
        with_load("friction_force", "normal_force"),
        expected=lambda here: here.rule.exponent_of_load,
    ),
    Row("eq17.contact", along("slow"), with_load("contact"), expected=nominal_exponent),
    Row("eq17.friction-per-contact", along("slow"), with_load("friction_force", "contact")),
    Row("eq17.slope-in-contact", along("slow"), with_load("rms_slope_contact")),
    Row("eq17.level", ends("slow"), over_slow_law),
    Row("limit.slow", at(0, slow_solid), over_limit),
    Row("eq19.level", ends("knee"), over_law),
    Row("eq19.load-exponent", along("knee"), law_with_load),
    Row("eq14.plateau", ends("fast"), over_law),
    Row("eq14.load-exponent", along("fast"), law_with_load),
    Row("eq19.law", everywhere, lambda here, it: np.log(here.over_law(it))),
    Row("friction.ratio.slow", ends("below"), ratio, pair=True),
    Row("friction.ratio.knee", ends("knee"), ratio, pair=True),
    Row("friction.ratio.fast", ends("above"), ratio, pair=True),
    Row("friction.ratio.smooth", ends("slowest"), ratio, pair=True, curve=SMOOTH),
    Row(
        "smooth.rest-{quantity}",
        at(..., lambda here: here.laws is None),
        over_closed_form,
        quantity="",
        curve=SMOOTH,
    ),
    Row(
        "smooth.pressed-in",
        at(..., at_rates(1)),
        lambda here, it: over_smooth(here, it) - 1,
        quantity="",
        curve=SMOOTH,
    ),
    *(
        Row(
            f"rest.{{quantity}}-{side}",
            at(..., partial(reaches, is_deep=is_deep)),
            partial(depth_apart, is_deep=is_deep),
            pair=True,
            quantity="",
        )
        for side, is_deep in (("deep", True), ("shallow", False))
    ),
    Row(
        "rest.stiffness",
        at(..., lambda here: len(here.curve.speeds) == 1 and len(here.curve.values) > 2),
        stiffer,
        pair=True,
        quantity="",
    ),
    Row("pressed-in.slow", at(0, at_rates(2)), pressed_apart, pair=True, quantity=""),
    Row("pressed-in.fast", at(-1, at_rates(2)), pressed_apart, pair=True, quantity=""),
]
