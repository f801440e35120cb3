"""Rows of claims on a rough series: where each can be stated, and what measures it on its answers.

A new claim is a row here with a function of a few lines, and its words in `claims`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray

from scene.regime import MUCH_LESS_HEIGHT
from scene.scales import elastic_contact

from ...models import exact
from ...models.exact.indentation import loading_force
from ...models.table import DEPTH, FORCE, FRICTION, PROFILES, Model
from ...statistics.jackknife import draws_of, friction, mean, off_the_ratio
from .claims import at_ends, geometric, power
from .laws import Laws

if TYPE_CHECKING:
    from .rough import RoughSeries

# Slow: the loss tangent of the shortest wave, v times the longest time over it, and xi, below which friction is
# off its limit by less than the tolerance. Above FAST Eq. 19 is within 12 % of its plateau.
SLOW, FAST = 0.1, 3.0
# Ratio of xi to 1, or of 1 to xi, up to which the closest speed is at the knee.
AT_THE_KNEE = 3.0
CONTACT = {"profiles": "contact_length", "surfaces": "contact_area", "none": "contact_area"}  # [m], [m²]
SLOW_CAUSES = "curvature_by_pressure", "rms_slope_contact", "contact_length"  # of slow friction

# Ending of an id, place of speeds and values, number that the law has there: None of that of the claim.
Place = tuple[str, Any, float | None]


@dataclass(frozen=True)
class Here:
    """A place of a rough series at which claims are stated on a model.

    series, model : what is judged; laws : of the model; None of a series that does not slide
    place : of speeds and values; all where none is chosen
    """

    series: RoughSeries
    laws: Laws | None
    model: Model
    place: Any = ...

    @property
    def regime(self) -> str:
        """Dimensionless groups of the place in words."""
        if self.laws is not None:
            return self.laws.words(self.place)
        over = closed_forms(self.series)[1] / self.series.scene.roughness.rms_height
        words = f"d/h0 {over.min():.2g} to {over.max():.2g}"
        return words if self.place is ... else f"{self.series.speeds[self.place]:.2g} m/s; {words}"

    @property
    def pressed(self) -> str:
        """What is not prescribed: depth under loads, force at depths."""
        return DEPTH if self.series.prescribed == "load" else FORCE

    @property
    def rule(self) -> Laws:
        """Laws of the model, which slides."""
        assert self.laws is not None
        return self.laws

    @property
    def slow(self) -> bool:
        """Whether the slowest speed is in the limit of low speed."""
        known = self.rule.xi[0][np.isfinite(self.rule.xi[0])]
        slow = known.size > 0 and known.max() <= SLOW and self.rule.slowest_loss <= SLOW
        return len(self.rule.speeds) > 1 and bool(slow)

    @property
    def limits(self) -> dict[str, tuple[int, np.ndarray]]:
        """Places of the speeds by where they lie on the law, each with the loads or depths at which they do.

        slow, knee, fast : in the limit of low speed; where the median of xi is closest to 1; on the plateau
        below, above : slowest and fastest, where the median is below and above 1 and they are not at the knee
        slowest : whatever xi is
        """
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
        """Friction over that of Eq. 19."""
        return friction(it)[1:] / self.rule.law_of(self.xi(it))


Where = Callable[[Here], Iterator[Place]]


@dataclass(frozen=True)
class Row:
    """A claim: where it is stated, and what measures it.

    id : of the claim, with {quantity} in place of depth or force, and without the ending of its place
    where : places at which it can be stated
    measure : of a place and the answers of one model, or of a model and the reference; a number, or an array of
        which the root mean square counts
    pair : whether it compares a model with the reference
    quantity : that models must have a claim on; depth or force where it is empty
    body : rough or smooth
    """

    id: str
    where: Where
    measure: Callable[..., Any]
    pair: bool = False
    quantity: str = FRICTION
    body: str = "rough"


def at(
    place: Any,
    when: Callable[[Here], Any] = lambda here: True,
    expected: Callable[[Here], Any] = lambda here: None,
) -> Where:
    """One place of speeds and values, where something is so. expected : number that the law has there"""

    def where(here: Here) -> Iterator[Place]:
        if when(here):
            yield "", place, expected(here)

    return where


def ends(limit: str) -> Where:
    """Least and greatest load or depth at one of the speeds of `Here.limits`."""

    def where(here: Here) -> Iterator[Place]:
        if limit in here.limits:
            speed, values = here.limits[limit]
            yield from ((name, (speed, value), None) for name, value in at_ends("", values))

    return where


def along(limit: str, expected: Callable[[Here], float | None] = lambda here: None) -> Where:
    """All loads or depths at one of the speeds of `Here.limits`, two at least."""

    def where(here: Here) -> Iterator[Place]:
        if limit in here.limits and here.limits[limit][1].sum() > 1:
            yield "", here.limits[limit], expected(here)

    return where


everywhere = at(...)

# Friction of one dimensionality: Eqs. 14 to 19.


def speed_exponent(here: Here, it: xarray.Dataset) -> float:
    slow, next_to_it = friction(it)[1:3]
    speeds = here.series.speeds
    return float(np.mean(np.log(next_to_it / slow)) / np.log(speeds[1] / speeds[0]))


def with_load(quantity: Callable[[Here, xarray.Dataset], np.ndarray]) -> Callable[[Here, xarray.Dataset], float]:
    """Exponent of a quantity at the slowest speed as a power of the load."""
    return lambda here, it: power(mean(it, "normal_force")[1], quantity(here, it))


def nominal_exponent(here: Here) -> float:
    """d ln of the nominal contact, a length (1D) or an area (3D), over d ln F_N."""
    return (1 + here.rule.exponent_of_load) * (1 if here.model.draws == PROFILES else 2)


def behind(draws: str) -> dict[str, tuple[str, str | None]]:
    """Causes of the load in slow friction: a variable, or its ratio to another; by what they are called."""
    return {
        "contact": (CONTACT[draws], None),
        "drag": ("friction_force", CONTACT[draws]),
        "slope": ("rms_slope_contact", None),
    }


def cause(name: str) -> Callable[[Here, xarray.Dataset], np.ndarray]:
    """One of these at the slowest speed."""
    return lambda here, it: mean(it, *behind(here.model.draws)[name])[1]


def over_slow_law(here: Here, it: xarray.Dataset) -> float:
    return geometric((friction(it)[1:] / (here.rule.plateau * here.xi(it)))[here.place])


def slow_solid(here: Here) -> bool:
    """Whether every mode of the solid is fast against the slowest speed, so that the limit can be seen."""
    longest = here.series.scene.solid.retardation()[2].max()
    return here.slow and here.rule.wave_number * here.series.speeds[0] * longest <= SLOW


def over_limit(here: Here, it: xarray.Dataset) -> float:
    """Friction at the slowest speed over what the contact at rest gives in the limit of low speed."""
    rest, solid = it.isel(speed=0), here.series.scene.solid
    lagged = here.series.speeds[0], exact.mean_lag(solid)
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


FRICTIONS = [
    Row(
        "eq17.speed-exponent",
        at(slice(2), lambda here: here.slow, lambda here: float(here.rule.loss_exponent[0])),
        speed_exponent,
    ),
    Row(
        "eq17.load-exponent",
        along("slow", lambda here: here.rule.exponent_of_load),
        with_load(lambda here, it: friction(it)[1]),
    ),
    Row("eq17.contact", along("slow", nominal_exponent), with_load(cause("contact"))),
    Row("eq17.friction-per-contact", along("slow"), with_load(cause("drag"))),
    Row("eq17.slope-in-contact", along("slow"), with_load(cause("slope"))),
    Row("eq17.level", ends("slow"), over_slow_law),
    Row("limit.slow", at(0, slow_solid), over_limit),
    Row("eq19.level", ends("knee"), over_law),
    Row("eq19.load-exponent", along("knee"), law_with_load),
    Row("eq14.plateau", ends("fast"), over_law),
    Row("eq14.load-exponent", along("fast"), law_with_load),
    Row("eq19.law", everywhere, lambda here, it: np.log(here.over_law(it))),
]


# Friction of one dimensionality over that of the other.


def ratio(here: Here, one: xarray.Dataset, three: xarray.Dataset) -> float:
    """Friction in 1D over 3D."""
    return geometric(friction(one)[1:][here.place] / friction(three)[1:][here.place])


BOTH = [
    Row("friction.ratio.slow", ends("below"), ratio, pair=True),
    Row("friction.ratio.knee", ends("knee"), ratio, pair=True),
    Row("friction.ratio.fast", ends("above"), ratio, pair=True),
    Row("friction.ratio.smooth", ends("slowest"), ratio, pair=True, body="smooth"),
]


# Force and depth: smooth bodies against closed forms, rough ones in one dimension against three.


def closed_forms(series: RoughSeries) -> tuple[np.ndarray, np.ndarray]:
    """Load [N] and depth [m] of the smooth body at rest at each load or depth: Galin and Sneddon."""
    contacts = [elastic_contact(series.at(value)) for value in series.values]
    return np.array([contact.load for contact in contacts]), np.array([contact.depth for contact in contacts])


def loading(series: RoughSeries, reached: np.ndarray) -> np.ndarray:
    """Force [N] on the smooth body pressed in at constant rates, (rates, depths): Lee and Radok.

    reached : depths [m], (rates, depths). A march answers for the middle of its last step, half a step before the
        end
    """
    body, solid = series.scene.indenter, series.scene.elastomer
    forces = np.full(reached.shape, nan)
    for (row, column), depth in np.ndenumerate(reached):
        if depth > 0:
            times = 0.0, float(depth) / series.speeds[row]
            forces[row, column] = loading_force(body, solid, times, (0.0, float(depth)), times[1:])[0]
    return forces


def over_closed_form(here: Here, it: xarray.Dataset) -> np.ndarray:
    load, depth = closed_forms(here.series)
    name, known = ("depth_reached", depth) if here.pressed == DEPTH else ("normal_force", load)
    return mean(it, name)[0] / known - 1


def over_smooth(here: Here, it: xarray.Dataset) -> np.ndarray:
    """Force over that of the smooth body in closed form, (rates, depths)."""
    return here.force(it) / loading(here.series, mean(it, "depth_reached")[1:])


def deep(here: Here) -> np.ndarray:
    """Loads or depths at which roughness is small against depth."""
    return closed_forms(here.series)[1] * MUCH_LESS_HEIGHT >= here.series.scene.roughness.rms_height


def reaches(here: Here, is_deep: bool) -> bool:
    """Whether some loads or depths are deep, or not."""
    return bool((deep(here) == is_deep).any())


def depth_apart(here: Here, one: xarray.Dataset, three: xarray.Dataset, is_deep: bool) -> np.ndarray:
    """By how much depth or force there is another in 1D, where it is deep, or not."""
    if here.pressed == DEPTH:
        off = (mean(one, "depth_reached")[0] - mean(three, "depth_reached")[0]) / closed_forms(here.series)[1]
    else:
        off = np.log(mean(one, "normal_force")[0]) - np.log(mean(three, "normal_force")[0])
    return off[deep(here) == is_deep]


def stiffer(here: Here, one: xarray.Dataset, three: xarray.Dataset) -> np.ndarray:
    """ln of the ratio of the stiffness between neighbouring loads or depths."""
    stiff, other = (
        np.diff(mean(each, "normal_force")[0]) / np.diff(mean(each, "depth_reached")[0]) for each in (one, three)
    )
    return np.log(stiff / other)


def at_rest(here: Here) -> bool:
    """Whether bodies rest alone, at three loads or depths at least."""
    return not here.series.speeds and not here.series.pressed_in and len(here.series.values) > 2


def at_rates(least: int) -> Callable[[Here], bool]:
    """Whether bodies are pressed in at so many rates at least."""
    return lambda here: here.series.pressed_in and len(here.series.speeds) >= least


def pressed_apart(here: Here, one: xarray.Dataset, three: xarray.Dataset) -> float:
    first, other = (over_smooth(here, each)[here.place, -1] for each in (one, three))
    return float(np.log(first / other))


DEPTHS = [
    Row("smooth.rest-{quantity}", everywhere, over_closed_form, body="smooth"),
    Row("smooth.pressed-in", at(..., at_rates(1)), lambda here, it: over_smooth(here, it) - 1, body="smooth"),
]
REST = [
    Row(
        f"rest.{{quantity}}-{side}",
        at(..., partial(reaches, is_deep=is_deep)),
        partial(depth_apart, is_deep=is_deep),
        pair=True,
        quantity="",
    )
    for side, is_deep in (("deep", True), ("shallow", False))
]
MARCHES = [
    Row("rest.stiffness", at(..., at_rest), stiffer, pair=True, quantity=""),
    Row("pressed-in.slow", at(0, at_rates(2)), pressed_apart, pair=True, quantity=""),
    Row("pressed-in.fast", at(-1, at_rates(2)), pressed_apart, pair=True, quantity=""),
]
