"""Claims on friction of one series: laws in each dimensionality, one against three, shifts onto one curve."""

from collections.abc import Iterator, Mapping
from math import nan

import numpy as np

from ..finding import Claim, Finding
from ..rectangle import COARSE, FINE
from ..statistics import eq23
from ..statistics.collapse import Collapse, collapse
from ..statistics.frictioncurves import SimulatedCurves
from ..statistics.jackknife import friction, mean, mean_ratio, measured
from .claims import at_xi, claim, geometric, power
from .laws import Laws, slow_drag
from .series import ROUGH, SMOOTH, SOLVERS, Contacts, sliding

# Slow: the loss tangent of the shortest wave, v times the longest time over it, and xi, below which friction is
# off its limit by less than the tolerance. Above FAST Eq. 19 is within 12 % of its plateau.
SLOW, FAST = 0.1, 3.0
# Ratio of xi to 1, or of 1 to xi, up to which the closest speed is at the knee.
AT_THE_KNEE = 3.0


def friction_findings(contacts: Contacts, laws: Mapping[str, Laws]) -> list[Finding]:
    """Findings on a series that slides, but for what shifts of its curves say."""
    found = []
    for solver, dimension in SOLVERS.items():
        words = laws[solver].words
        for each, xi in _one_sided(contacts, solver, dimension, laws[solver]):
            found.append(finding(each, contacts, ROUGH, at_xi(xi, words) if xi is not None else words, solver))
    words = laws["BEM"].words
    for name, place in _places(laws["BEM"]):

        def ratio(sample, place=place):
            one, three = (friction(sample[solver])[1:][place] for solver in SOLVERS)
            return geometric(one / three)

        found.append(finding(claim(name, ratio), contacts, ROUGH, at_xi(laws["BEM"].xi[place], words)))
    return [*found, finding(claim("pair.smooth", _smooth_ratio), contacts, SMOOTH, words)]


def finding(
    each: Claim, contacts: Contacts, body: str, regime: str, *solvers: str, plot: str = "levels"
) -> Finding:
    """Finding of a claim on one body of a series.

    solvers : those whose surfaces are left out; both if absent
    plot : name of the plot that shows it, in the folder of the series
    """
    fine, coarse = (contacts.sample(grid, body, *(solvers or SOLVERS)) for grid in (FINE, COARSE))
    if each.id == "eq17.load-exponent":
        plot = "collapse"
    name = contacts.series.name
    return measured(each, fine, coarse, name, regime, f"{contacts.series.folder}/{plot}")


def _one_sided(contacts, solver, dimension, laws) -> Iterator[tuple[Claim, np.ndarray | None]]:
    """Claims of the paper on friction in one dimensionality, each with xi where it is measured."""
    if len(laws.speeds) > 1 and laws.slowest_loss <= SLOW and _all_slow(laws.xi[0]):
        for each in _at_low_speed(contacts, solver, dimension, laws):
            yield each, laws.xi[0]
    fast = laws.xi[-1] >= FAST
    if fast.any():

        def plateau(sample):
            mu, xi = _at_points(sample[solver], laws)
            return geometric(mu[-1][fast] / laws.law_of(xi)[-1][fast])

        yield claim("eq14.plateau", plateau, dimension), laws.xi[-1][fast]

    def law(sample):
        mu, xi = _at_points(sample[solver], laws)
        return np.log(mu / laws.law_of(xi))

    yield claim("eq19.law", law, dimension), None


def _at_low_speed(contacts, solver, dimension, laws) -> Iterator[Claim]:
    series = contacts.series
    apart = np.log(series.speeds[1] / series.speeds[0])

    def speed_exponent(sample):
        mu = friction(sample[solver])[1:]
        return float(np.mean(np.log(mu[1] / mu[0])) / apart)

    yield claim("eq17.speed-exponent", speed_exponent, dimension, float(laws.loss_exponent[0]))
    if len(series.values) > 1:

        def load_exponent(sample):
            return power(mean(sample[solver], "normal_force")[1], friction(sample[solver])[1])

        yield claim("eq17.load-exponent", load_exponent, dimension, laws.exponent_of_load)

    def level(sample):
        mu, xi = _at_points(sample[solver], laws)
        return geometric(mu[0] / (laws.plateau * xi[0]))

    yield claim("eq17.level", level, dimension)
    # Every mode of the solid is fast against the slowest speed, so that the limit can be seen.
    if laws.wave_number * series.speeds[0] * series.scene.solid.retardation()[2].max() <= SLOW:

        def over_limit(sample):
            rest = sample[solver].isel(speed=0)
            drag = slow_drag(series.scene.solid, solver, rest)
            limit = series.speeds[0] * mean_ratio(drag, rest["normal_force"].transpose(..., "draw").values).value
            return geometric(friction(sample[solver])[1] / limit)

        yield claim("limit.slow", over_limit, dimension)


def _at_points(answers, laws):
    """Friction at every point that slides, and xi under the load there."""
    return friction(answers)[1:], laws.xi_under(mean(answers, "normal_force")[1:])


def _all_slow(xi):
    """Whether xi is small wherever it is known."""
    known = xi[np.isfinite(xi)]
    return known.size > 0 and known.max() <= SLOW


def _smooth_ratio(sample):
    one, three = (friction(sample[solver])[1] for solver in SOLVERS)
    return geometric(one / three)


def _places(laws) -> Iterator[tuple[str, int]]:
    """Claims by where the median of xi lies at a speed; each speed is asked once."""
    known = [row[np.isfinite(row)] for row in laws.xi]
    middle = np.array([np.exp(np.median(np.log(row))) if row.size else nan for row in known])
    away = np.nan_to_num(np.abs(np.log(middle)), nan=np.inf)
    last, closest = len(middle) - 1, int(np.argmin(away))
    knee = closest if away[closest] <= np.log(AT_THE_KNEE) else None
    if middle[0] < 1 and knee != 0:
        yield "pair.friction-slow", 0
    if knee is not None:
        yield "pair.friction-knee", knee
    if middle[last] > 1 and knee != last:
        yield "pair.friction-fast", last


def collapses(contacts: Contacts, solver: str) -> tuple[Collapse, Collapse] | None:
    """What shifts make of the curves of the rough body on both grids; None where points are too few."""
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
    series, dimension = contacts.series, SOLVERS[solver]
    words, draws = laws.words, series.draws[solver]
    plots = f"{series.folder}/collapse", f"{series.folder}/shifts"
    if both is not None:
        shifts = dict(zip(series.speeds, laws.shifts.tolist(), strict=True))
        yield from eq23.findings(*both, dimension, shifts, laws.exponent, series.name, draws, words, plots)
    elif eq23.shiftable(len(series.speeds), len(series.values)):
        yield eq23.too_few(dimension, series.name, draws, words, plots[0])
