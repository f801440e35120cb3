"""The claims on force and depth: smooth bodies against closed forms, rough ones in one dimension against three."""

from collections.abc import Iterator

import numpy as np

from scene import Indent, Program
from scene.scales import elastic_contact

from ..finding import Finding
from ..references.indentation import loading_force
from .claims import BOTH, DIMENSIONS, Question, answered, pair, rest_questions
from .series import COARSE, FINE, REST, ROUGH, SMOOTH, SMOOTH_REST, Series, Solved
from .sides import Pair, Side

DEPTH, PRESSED_IN = "study-depth", "study-pressed-in"
# How close theory and solution are where theory is exact.
CLOSED = 0.01


def depth_findings(solved: Solved) -> list[Finding]:
    """At rest, and pressed in where the motion is a Program."""
    series, found = solved.series, []
    for solver, dimension in DIMENSIONS.items():
        fine, coarse = (Side.of(solved, solver, grid) for grid in (FINE, COARSE))
        for question, figure in _smooth(series):
            found.append(answered(question, dimension, fine, coarse, where(series), figure, surfaces=0))
    fine, coarse = (pair(solved, grid) for grid in (FINE, COARSE))
    questions = [(question, DEPTH) for question in (*rest_questions(solved), *_stiffness(series))]
    if isinstance(series.scene.motion, Program):
        questions += [(question, PRESSED_IN) for question in _pressed_in(series)]
    return found + [
        answered(question, BOTH, fine, coarse, where(series), figure) for question, figure in questions
    ]


def closed_forms(series: Series) -> tuple[np.ndarray, np.ndarray]:
    """Load [N] and depth [m] of the smooth body at rest at each press: Galin and Sneddon."""
    contacts = [elastic_contact(series.at(press)) for press in series.presses]
    return np.array([contact.load for contact in contacts]), np.array([contact.depth for contact in contacts])


def loading(series: Series) -> np.ndarray:
    """Force [N] on the smooth body pressed in at constant rates, at the end, (rates, presses): Lee and Radok."""
    body, solid = series.scene.indenter, series.scene.elastomer
    ends = [[press / rate for press in series.presses] for rate in series.speeds]
    return np.array(
        [
            [
                float(loading_force(body, solid, (0.0, end), (0.0, press), (end,))[0])
                for end, press in zip(row, series.presses, strict=True)
            ]
            for row in ends
        ]
    )


def where(series: Series) -> str:
    """Depth over rms height of the presses, in words."""
    if series.scene.roughness is None:
        return "smooth"
    _, depths = closed_forms(series)
    over = depths / series.scene.roughness.rms_height
    return f"d/h0 {over.min():.2g} to {over.max():.2g}"


def _smooth(series) -> Iterator[tuple[Question, str]]:
    """With the figure that shows it."""
    load, depth = closed_forms(series)
    name, known = ("depth", depth) if series.pressed_by == "load" else ("normal_force", load)
    yield (
        Question(
            f"smooth bodies at rest have the {name.split('_')[-1]} of Galin and Sneddon",
            0.0,
            "rms over the presses of the relative deviation from the closed form.",
            lambda side: side.mean(name, SMOOTH_REST)[0] / known - 1,
            CLOSED,
        ),
        DEPTH,
    )
    if isinstance(series.scene.motion, Program):
        forces = loading(series)
        yield (
            Question(
                "smooth bodies pressed into a viscoelastic solid have the force of Lee and Radok",
                0.0,
                "rms over rates and depths of the relative deviation from the closed form.",
                lambda side: side.mean("normal_force", SMOOTH) / forces - 1,
                CLOSED,
            ),
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
        )


def _secants(side: Side):
    return np.diff(side.mean("normal_force", REST)[0]) / np.diff(side.mean("depth", REST)[0])


def _pressed_in(series) -> Iterator[Question]:
    for place, what in ((0, "slowest"), (-1, "fastest")):

        def deviation(both: Pair, place=place):
            one, three = (side.mean("normal_force", ROUGH)[place, -1] for side in (both.one, both.three))
            return float(np.log(one / three))

        yield Question(
            f"pressed in at the {what} rate, rough, the force at the greatest depth is the same in 1D and 3D",
            0.0,
            f"ln of the ratio of forces, at {series.speeds[place]:.2g} m/s.",
            deviation,
        )
