"""Claims on friction of one series: laws in each dimensionality, one against three, shifts onto one curve."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from math import nan
from typing import Any

import numpy as np

from ...models import exact
from ...models.table import FRICTION, PROFILES
from ...solving.parameter_grid import COARSE, FINE
from ...statistics import eq23
from ...statistics.collapse import Collapse, collapse
from ...statistics.finding import Claim, Finding, said_of
from ...statistics.frictioncurves import SimulatedCurves
from ...statistics.jackknife import friction, mean, mean_ratio, measured
from .claims import at_ends, claim, geometric, power
from .laws import Laws
from .series import CONTACT, ROUGH, SLOW_DRAG, SMOOTH, Contacts, sliding

# Slow: the loss tangent of the shortest wave, v times the longest time over it, and xi, below which friction is
# off its limit by less than the tolerance. Above FAST Eq. 19 is within 12 % of its plateau.
SLOW, FAST = 0.1, 3.0
# Ratio of xi to 1, or of 1 to xi, up to which the closest speed is at the knee.
AT_THE_KNEE = 3.0
# Claims on what is behind Eq. 17, by the column of its figure.
WHY = {"contact": "eq17.contact", "drag": "eq17.friction-per-contact", "slope": "eq17.slope-in-contact"}


def friction_findings(contacts: Contacts, laws: Mapping[str, Laws]) -> list[Finding]:
    """Findings on a series that slides, except those on the shifts of its curves."""
    found = []
    for solver, law in laws.items():
        dimension = contacts.labels[solver]
        for name, measure, place, expected in _one_sided(contacts.series, solver, law):
            each = claim(name, partial(lambda of, at, it: of(it[at]), measure, solver), dimension, expected)
            plot = (
                "collapse"
                if name == "eq17.load-exponent"
                else "slow-friction"
                if name in WHY.values()
                else "friction-speed"
            )
            found.append(finding(each, contacts, ROUGH, law.words(place), solver, plot=plot))
    known, everywhere = laws[contacts.series.models.reference], np.full(len(contacts.series.values), True)
    for level, speed, body in _places(known):
        for name, value in at_ends(level, everywhere):
            place = speed, value
            found += pair_findings(name, partial(_ratio, place), contacts, body, known.words(place))
    return found


def pair_findings(
    name: str,
    measure: Callable,
    contacts: Contacts,
    body: str,
    regime: str,
    plot: str = "friction-speed",
    quantity: str = FRICTION,
) -> list[Finding]:
    """Findings of a claim on each model against the reference, of those that answer a quantity.

    measure : of answers of both, in this order
    """
    found = []
    for model, reference, beside in contacts.pairs(quantity):

        def of_both(sample, both=(model, reference)):
            return measure(*(sample[each] for each in both))

        each = replace(said_of(claim(name, of_both), beside), dimension=beside)
        found.append(finding(each, contacts, body, regime, model, reference, plot=plot))
    return found


def _ratio(place, one, three):
    """Friction in 1D over 3D at a speed and a load or depth."""
    return geometric(friction(one)[1:][place] / friction(three)[1:][place])


def finding(
    each: Claim, contacts: Contacts, body: str, regime: str, *solvers: str, plot: str = "friction-speed"
) -> Finding:
    """Finding of a claim on one body of a series.

    solvers : those whose surfaces are left out; both if absent
    plot : name of the plot that shows it, in the folder of the series
    """
    fine, coarse = (contacts.sample(grid, body, *(solvers or contacts.labels)) for grid in (FINE, COARSE))
    return measured(each, fine, coarse, contacts.series.name, regime, f"{contacts.series.folder}/{plot}")


def _one_sided(series, solver, laws) -> Iterator[tuple[str, Callable, Any, float | None]]:
    """Claims of the paper on friction in one dimensionality.

    Each by its id, with what measures it on the answers of the solver, the place of speeds and values where that
    is, and the number that the law has there, None of the number of the claim itself.
    """

    def mu(answers):
        return friction(answers)[1:]

    def xi(answers):
        return laws.xi_under(mean(answers, "normal_force")[1:])

    def over_law(answers):
        return mu(answers) / laws.law_of(xi(answers))

    def against_load(answers, values, place, chosen=slice(None)):
        return power(mean(answers, "normal_force")[1:][place][chosen], values[chosen])

    def speed_exponent(answers):
        slow, next_to_it = mu(answers)[:2]
        return float(np.mean(np.log(next_to_it / slow)) / np.log(series.speeds[1] / series.speeds[0]))

    def with_load(quantity):
        return lambda it: power(mean(it, "normal_force")[1], quantity(it))

    def over_limit(answers):
        rest = answers.isel(speed=0)
        force = rest["normal_force"].transpose(..., "surface").values
        drag = exact.mean_lag(series.scene.solid) * rest[SLOW_DRAG].transpose(..., "surface").values
        limit = series.speeds[0] * mean_ratio(drag, force).value
        return geometric(mu(answers)[0] / limit)

    def level(name, quantity, speed, places):
        for end, value in at_ends(name, places):
            yield end, lambda it, place=(speed, value): geometric(quantity(it)[place]), (speed, value), None

    slowest, fast, everywhere = 0, laws.xi[-1] >= FAST, np.full(len(series.values), True)
    known = laws.xi[0][np.isfinite(laws.xi[0])]
    if len(laws.speeds) > 1 and laws.slowest_loss <= SLOW and known.size and known.max() <= SLOW:
        yield "eq17.speed-exponent", speed_exponent, slice(2), float(laws.loss_exponent[0])
        if len(series.values) > 1:
            exponent = laws.exponent_of_load
            yield "eq17.load-exponent", with_load(lambda it: mu(it)[0]), slowest, exponent
            draws = series.models[solver].draws
            for name, (variable, below) in behind(draws).items():
                law = nominal_exponent(draws, exponent) if name == "contact" else None
                measure = with_load(lambda it, of=variable, over=below: mean(it, of, over)[1])
                yield WHY[name], measure, slowest, law
        yield from level("eq17.level", lambda it: mu(it) / (laws.plateau * xi(it)), slowest, everywhere)
        # Every mode of the solid is fast against the slowest speed, so that the limit can be seen.
        if laws.wave_number * series.speeds[0] * series.scene.solid.retardation()[2].max() <= SLOW:
            yield "limit.slow", over_limit, slowest, None
    if (knee := _closest_to_one(laws)[1]) is not None:
        yield from level("eq19.level", over_law, knee, everywhere)
        if len(series.values) > 1:
            yield "eq19.load-exponent", lambda it: against_load(it, over_law(it)[knee], knee), knee, None
    if fast.any():
        yield from level("eq14.plateau", over_law, -1, fast)
        if fast.sum() > 1:
            yield "eq14.load-exponent", lambda it: against_load(it, over_law(it)[-1], -1, fast), (-1, fast), None
    yield "eq19.law", lambda it: np.log(over_law(it)), ..., None


def behind(draws: str) -> dict[str, tuple[str, str | None]]:
    """Causes of the load in slow friction: a variable, or its ratio to another; by the names of claims."""
    contact = CONTACT[draws]
    return {
        "contact": (contact, None),
        "drag": ("friction_force", contact),
        "slope": ("rms_slope_contact", None),
    }


def nominal_exponent(draws: str, of_friction: float) -> float:
    """d ln of the nominal contact, a length (1D) or an area (3D), over d ln F_N; of_friction : of Eq. 17."""
    return (1 + of_friction) * (1 if draws == PROFILES else 2)


def _places(laws) -> Iterator[tuple[str, int, str]]:
    """Claims on rough bodies by where the median of xi lies at a speed, each speed once; and on the smooth body.

    Each with its speed and the body.
    """
    middle, knee = _closest_to_one(laws)
    last = len(middle) - 1
    if middle[0] < 1 and knee != 0:
        yield "friction.ratio.slow", 0, ROUGH
    if knee is not None:
        yield "friction.ratio.knee", knee, ROUGH
    if middle[last] > 1 and knee != last:
        yield "friction.ratio.fast", last, ROUGH
    yield "friction.ratio.smooth", 0, SMOOTH


def _closest_to_one(laws) -> tuple[np.ndarray, int | None]:
    """Median of xi at each speed, and the place of the speed at the knee, None without any."""
    known = [row[np.isfinite(row)] for row in laws.xi]
    middle = np.array([np.exp(np.median(np.log(row))) if row.size else nan for row in known])
    away = np.nan_to_num(np.abs(np.log(middle)), nan=np.inf)
    closest = int(np.argmin(away))
    return middle, closest if away[closest] <= np.log(AT_THE_KNEE) else None


def collapses(contacts: Contacts, solver: str) -> tuple[Collapse, Collapse] | None:
    """Collapse of the curves of the rough body on both grids; None where points are too few."""
    try:
        fine, coarse = (collapse(curves(contacts, solver, grid)) for grid in (FINE, COARSE))
    except ValueError:
        return None
    return fine, coarse


def curves(contacts: Contacts, solver: str, grid: str = FINE) -> SimulatedCurves:
    """Friction of the rough body that slides."""
    return SimulatedCurves.of(sliding(contacts(solver, ROUGH, grid)))


def shift_findings(
    contacts: Contacts, solver: str, both: tuple[Collapse, Collapse] | None, laws: Laws
) -> Iterator[Finding]:
    """Whether curves fall onto one, with the shifts that are best and with those predicted."""
    series, dimension = contacts.series, contacts.labels[solver]
    words, draws = laws.words(), series.draws[solver]
    plots = (f"{series.folder}/collapse",) * 2
    if both is not None:
        shifts = dict(zip(series.speeds, laws.shifts.tolist(), strict=True))
        yield from eq23.findings(*both, dimension, shifts, laws.exponent, series.name, draws, words, plots)
    elif eq23.shiftable(len(series.speeds), len(series.values)):
        yield eq23.too_few(dimension, series.name, draws, words, plots[0])
