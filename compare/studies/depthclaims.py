"""The claims on force and depth: smooth bodies against closed forms, rough ones in one dimension against three."""

from collections.abc import Iterator

import numpy as np

from scene import Indent, Program
from scene.scales import elastic_contact

from ..finding import Finding
from ..exact.indentation import loading_force
from ..verdict import DIMENSIONS
from .pairclaims import pairs, rest_questions
from .question import BOTH, DEPTH, Question, answered
from .series import COARSE, FINE, REST, ROUGH, SMOOTH, SMOOTH_REST, Series, Solved
from .sides import Pair, Side

PRESSED_IN = "study-pressed-in"
# How close theory and solution are where theory is exact.
CLOSED = 0.01


def depth_findings(solved: Solved) -> list[Finding]:
    """At rest, and pressed in where the motion is a Program."""
    series, words, found = solved.series, where(solved.series), []
    for solver, dimension in DIMENSIONS.items():
        one, other = (Side.of(solved, solver, grid).smooth for grid in (FINE, COARSE))
        found += [answered(question, dimension, one, other, words) for question in _smooth(series)]
    fine, coarse = pairs(solved)
    questions = [*rest_questions(series), *_stiffness(series), *_pressed_in(series)]
    return found + [answered(question, BOTH, fine, coarse, words) for question in questions]


def closed_forms(series: Series) -> tuple[np.ndarray, np.ndarray]:
    """Load [N] and depth [m] of the smooth body at rest at each press: Galin and Sneddon."""
    contacts = [elastic_contact(series.at(press)) for press in series.presses]
    return np.array([contact.load for contact in contacts]), np.array([contact.depth for contact in contacts])


def loading(series: Series, depths: np.ndarray | None = None) -> np.ndarray:
    """Force [N] on the smooth body pressed in at constant rates, (rates, presses): Lee and Radok.

    depths : reached [m], (rates, presses); those prescribed if absent. A march answers for the middle of its last
        step, half a step before the end
    """
    reached = np.broadcast_to(series.presses, (len(series.speeds), len(series.presses)))
    reached = reached if depths is None else depths
    return np.array(
        [
            [_loading(series, rate, depth) for depth in row]
            for rate, row in zip(series.speeds, reached.tolist(), strict=True)
        ]
    )


def _loading(series, rate, depth):
    if not depth > 0:
        return np.nan
    body, solid, end = series.scene.indenter, series.scene.elastomer, depth / rate
    return float(loading_force(body, solid, (0.0, end), (0.0, depth), (end,))[0])


def where(series: Series) -> str:
    """Depth over rms height of the presses, in words."""
    _, depths = closed_forms(series)
    over = depths / series.scene.roughness.rms_height
    return f"d/h0 {over.min():.2g} to {over.max():.2g}"


def _smooth(series) -> Iterator[Question]:
    """Of one Side of smooth bodies."""
    load, depth = closed_forms(series)
    name, known = ("depth", depth) if series.pressed_by == "load" else ("normal_force", load)
    yield Question(
        f"smooth bodies at rest have the {name.split('_')[-1]} of Galin and Sneddon",
        0.0,
        "rms over the presses of the relative deviation from the closed form.",
        lambda side: side.mean(name, SMOOTH_REST)[0] / known - 1,
        CLOSED,
        DEPTH,
    )
    if isinstance(series.scene.motion, Program):
        yield Question(
            "smooth bodies pressed into a viscoelastic solid have the force of Lee and Radok",
            0.0,
            "rms over rates and depths of the relative deviation from the closed form at the depth reached.",
            lambda side: _over_smooth(series, side, SMOOTH) - 1,
            CLOSED,
            PRESSED_IN,
        )


def _stiffness(series) -> Iterator[Question]:
    """Of the relaxed contact: secants between neighbouring presses, in 1D and 3D at the same press."""
    if isinstance(series.scene.motion, Indent) and len(series.presses) > 2:
        yield Question(
            "at rest, rough, the stiffness is the same in 1D and 3D",
            0.0,
            "rms over neighbouring presses of ln of the ratio of dF/dd.",
            lambda both: np.log(_secants(both.one) / _secants(both.three)),
            figure=DEPTH,
        )


def _over_smooth(series, side: Side, body):
    """Force over that of the smooth body in closed form, (rates, presses)."""
    return side.mean("normal_force", body) / loading(series, side.mean("depth", body))


def _secants(side: Side):
    return np.diff(side.mean("normal_force", REST)[0]) / np.diff(side.mean("depth", REST)[0])


def _pressed_in(series) -> Iterator[Question]:
    """At the slowest and the fastest rate, of two at least."""
    if not isinstance(series.scene.motion, Program) or len(series.speeds) < 2:
        return
    for place, what in ((0, "slowest"), (-1, "fastest")):

        def deviation(both: Pair, place=place):
            one, three = (_over_smooth(series, side, ROUGH)[place, -1] for side in (both.one, both.three))
            return float(np.log(one / three))

        yield Question(
            f"pressed in at the {what} rate, rough, the force at the greatest depth is the same in 1D and 3D",
            0.0,
            f"ln of the ratio of forces, each over that of the smooth body at the depth reached, at "
            f"{series.speeds[place]:.2g} m/s.",
            deviation,
            figure=PRESSED_IN,
        )
