"""Claims on force and depth: smooth bodies against closed forms, rough ones in one dimension against three."""

from collections.abc import Iterator
from functools import partial
from math import nan

import numpy as np

from scene.regime import MUCH_LESS_HEIGHT
from scene.scales import elastic_contact

from ..exact.indentation import loading_force
from ..finding import Claim, Finding
from ..statistics.jackknife import mean
from .claims import claim
from .claims_friction import finding
from .series import ROUGH, SMOOTH, SOLVERS, Contacts, Series


def depth_findings(contacts: Contacts) -> list[Finding]:
    """Findings at rest, and pressed in where the motion is a Program."""
    series, found = contacts.series, []
    words = where(series)
    for solver, dimension in SOLVERS.items():
        for each in _smooth(series, solver, dimension):
            plot = "pressed-in" if each.id == "smooth.pressed-in" else "depth"
            found.append(finding(each, contacts, SMOOTH, words, solver, plot=plot))
    found += rest_findings(contacts, words)
    for each in _stiffness(series):
        found.append(finding(each, contacts, ROUGH, words, plot="depth"))
    for each, rate in _pressed_in(series):
        found.append(finding(each, contacts, ROUGH, f"{rate:.2g} m/s; {words}", plot="pressed-in"))
    return found


def rest_findings(contacts: Contacts, words: str) -> list[Finding]:
    """Findings on depth or force at rest, where roughness is small against depth and elsewhere."""
    claims = _at_rest(contacts.series)
    return [finding(each, contacts, ROUGH, words, plot="depth") for each in claims]


def closed_forms(series: Series) -> tuple[np.ndarray, np.ndarray]:
    """Load [N] and depth [m] of the smooth body at rest at each load or depth: Galin and Sneddon."""
    contacts = [elastic_contact(series.at(value)) for value in series.values]
    return np.array([contact.load for contact in contacts]), np.array([contact.depth for contact in contacts])


def loading(series: Series, depths: np.ndarray | None = None) -> np.ndarray:
    """Force [N] on the smooth body pressed in at constant rates, (rates, depths): Lee and Radok.

    depths : reached [m], (rates, depths); those prescribed if absent. A march answers for the middle of its last
        step, half a step before the end
    """
    reached = np.broadcast_to(series.values, (len(series.speeds), len(series.values)))
    reached = reached if depths is None else depths
    return np.array(
        [
            [_loading(series, rate, depth) for depth in row]
            for rate, row in zip(series.speeds, reached.tolist(), strict=True)
        ]
    )


def _loading(series, rate, depth):
    if not depth > 0:
        return nan
    body, solid, end = series.scene.indenter, series.scene.elastomer, depth / rate
    return float(loading_force(body, solid, (0.0, end), (0.0, depth), (end,))[0])


def where(series: Series) -> str:
    """Depth over rms height at all loads or depths, in words."""
    _, depths = closed_forms(series)
    over = depths / series.scene.roughness.rms_height
    return f"d/h0 {over.min():.2g} to {over.max():.2g}"


def _smooth(series, solver, dimension) -> Iterator[Claim]:
    load, depth = closed_forms(series)
    name, variable, known = (
        ("smooth.rest-depth", "depth_reached", depth)
        if series.prescribed == "load"
        else ("smooth.rest-force", "normal_force", load)
    )
    yield claim(name, lambda sample: mean(sample[solver], variable)[0] / known - 1, dimension)
    if series.pressed_in and series.speeds:
        yield claim("smooth.pressed-in", lambda sample: _over_smooth(series, sample[solver]) - 1, dimension)


def _at_rest(series) -> Iterator[Claim]:
    depths, at_load = closed_forms(series)[1], series.prescribed == "load"

    def apart(sample):
        if at_load:
            one, three = (mean(sample[solver], "depth_reached")[0] for solver in SOLVERS)
            return (one - three) / depths
        one, three = (np.log(mean(sample[solver], "normal_force")[0]) for solver in SOLVERS)
        return one - three

    deep = depths * MUCH_LESS_HEIGHT >= series.scene.roughness.rms_height
    for places, side in ((deep, "deep"), (~deep, "shallow")):
        if places.any():
            measure = partial(lambda sample, places: apart(sample)[places], places=places)
            yield claim(f"rest.{'depth' if at_load else 'force'}-{side}", measure)


def _stiffness(series) -> Iterator[Claim]:
    """Claim on the relaxed contact: secants between neighbouring loads or depths, in 1D and 3D at the same."""
    if not series.speeds and not series.pressed_in and len(series.values) > 2:
        yield claim("rest.stiffness", lambda sample: np.log(_secants(sample["MDR"]) / _secants(sample["BEM"])))


def _pressed_in(series) -> Iterator[tuple[Claim, float]]:
    """Claims at the slowest and the fastest rate, of two at least, with the rate [m/s]."""
    if not series.pressed_in or len(series.speeds) < 2:
        return
    for place, what in ((0, "slow"), (-1, "fast")):

        def apart(sample, place=place):
            one, three = (_over_smooth(series, sample[solver])[place, -1] for solver in SOLVERS)
            return float(np.log(one / three))

        yield claim(f"pressed-in.{what}", apart), series.speeds[place]


def _over_smooth(series, answers):
    """Force over that of the smooth body in closed form, (rates, depths)."""
    return mean(answers, "normal_force")[1:] / loading(series, mean(answers, "depth_reached")[1:])


def _secants(answers):
    return np.diff(mean(answers, "normal_force")[0]) / np.diff(mean(answers, "depth_reached")[0])
