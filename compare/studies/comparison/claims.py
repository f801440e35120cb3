"""Claims on one scene and on series, each by its id, and what measures them: powers, means, places along xi."""

from dataclasses import replace
from math import isfinite, nan

import numpy as np

from ...statistics.finding import Claim

# How far from what is claimed still counts as it: what a reader of a diagram over decades of friction would not
# see, and less than what any measured roughness is known to.
TOLERANCE = 0.05
# How close theory and solution are where theory is exact.
CLOSED = 0.01
# Claims on relative deviations, by the first part of their names.
IN_PERCENT = {"force", "grid", "history", "law3d", "pressed-in", "rest", "smooth"}
_OWN = "Ratio of the means over surfaces."
_HISTORY = "rms over the history of the difference of 1D from 3D, over the rms of 3D, without what scatter adds."
_RATIO = "Ratio of the coefficients, 1D over 3D."
_PRESSED = "ln of the ratio of forces, each divided by the force on the smooth body at the depth reached."
_REST_DEPTH = (
    "the depth under a load is the same in 1D and 3D",
    "rms over loads of the difference of depths, divided by the depth of the smooth body.",
)
_REST_FORCE = "the force at a depth is the same in 1D and 3D", "rms over depths of ln of the ratio of forces."
_ON_THE_LAW = (
    "|ln(measured / S)| over the points at which the roughness has more than 0.3 of the friction, h₀ at most "
    "0.1 d. Measured: the friction minus the friction of the smooth body on the contact that roughness widens, "
    "divided by the friction of the waves in full contact. The upper end of the interval includes the scatter of "
    "surfaces, the lower end does not."
)
_AVERAGED = (
    "|ln(measured / mean of S)| at the same points: the misfit of the law itself. S is bent, so that the mean "
    "lies below S at the mean pressure, by up to a tenth for a cone."
)
_RAW = "|ln(measured / S)| at the same points, on the contact of the bare smooth body, with all waves."
_DEEP, _SHALLOW = "At rest, rough, h0 at most 0.1 d", "At rest, rough, h0 above 0.1 d"
# Sentence and meaning of each claim by its id; by the number claimed, NaN where it differs from place to place,
# and by how far from it still counts.
_TEXTS: dict[tuple[float, float], dict[str, tuple[str, str]]] = {
    (nan, TOLERANCE): {
        "eq17.speed-exponent": (
            "Eq. 17: at low speed friction grows with the speed as the loss at the shortest wave does",
            "d ln μ / d ln v between the two slowest speeds, mean over the loads or depths.",
        ),
        "eq17.load-exponent": (
            "Eqs. 16, 17: at low speed friction falls with the load as F_N^(-n/(n+1))",
            "d ln μ / d ln F_N at the slowest speed, least squares over the loads or depths. The law leaves out "
            "the slope of the macroscopic shape.",
        ),
    },
    (nan, 2 * TOLERANCE): {
        "eq17.contact": (
            "Behind Eq. 17: real contact grows with the load as the nominal contact does",
            "d ln of the length of real contact (1D), or of its area (3D), over d ln F_N, at the slowest speed, "
            "least squares over the loads or depths. The paper takes contact for full, and its length for 2a.",
        ),
    },
    (0.0, 2 * TOLERANCE): {
        "eq17.friction-per-contact": (
            "Behind Eq. 17: friction over the real contact is the same at every load",
            "d ln of the friction force over the length (1D) or area (3D) of real contact, over d ln F_N, at the "
            "slowest speed, least squares over the loads or depths. This and the exponent of the contact make up "
            "the exponent of friction.",
        ),
        "eq17.slope-in-contact": (
            "Behind Eq. 17: what touches is as steep at every load",
            "d ln of the rms slope over the real contact, over d ln F_N, at the slowest speed, least squares over "
            "the loads or depths.",
        ),
        "eq19.law": (
            "Eq. 19: friction follows the law at all speeds and loads",
            "rms over all points of ln μ minus ln μ of the law with α = 1.5, without the part of the scatter.",
        ),
        "eq18.one-curve": (
            "Eq. 18: friction over its plateau is one function of ξ, whatever roughness and solid",
            "rms of ln μ about one curve through all points of several series, none shifted, without what "
            "scatter adds.",
        ),
    },
    (1.0, TOLERANCE): {
        "friction.ratio.own": (
            "Friction of the scene as it stands is the same in 1D and 3D",
            "Friction in 1D over 3D, ratio of the means over surfaces.",
        ),
        "limit.slow": (
            "Friction at the slowest speed follows the exact limit of low speed",
            "Not of the paper: μ at the slowest speed over vτ times the mean of d2z/dx2 weighted with the "
            "pressure at rest (3D), or over Eq. 10 with the contact at rest (1D); geometric mean over the loads "
            "or depths, on the same surfaces. It tells a fault of a solver from the failure of a law. In 3D "
            "friction is found by that mean where the contact trails by less than a quarter of a pixel "
            "(docs/explanation/theory.md, Eq. 5e): the check is then of the pressure found in sliding.",
        ),
        "eq14.slope-exponent": (
            "Eq. 14: friction at the fastest speed goes as the rms slope to the power 1",
            "d ln μ / d ln of the rms slope, least squares over several rms heights, mean of the loads or depths "
            "at which all are at that limit, but for what Eq. 19 still lacks of it.",
        ),
    },
    (2.0, 2 * TOLERANCE): {
        "friction.ratio.smooth-slow": (
            "Slow friction of the smooth body, 1D over 3D, agrees with the closed forms",
            "Friction in 1D over 3D at the lowest speed: as the speed tends to zero it tends to 2, or to 1 for "
            "two models of the same dimensionality.",
        ),
        "eq17.slope-exponent": (
            "Eq. 17: friction at the slowest speed goes as the rms slope to the power 2",
            "d ln μ / d ln of the rms slope, least squares over several rms heights, mean of the loads or depths "
            "at which all are at that limit, but for what Eq. 19 still lacks of it.",
        ),
    },
    (0.0, TOLERANCE): {
        "force.ratio.rough": (
            "The force on the rough body at the same depth is the same in 1D and 3D",
            "Force in 1D over 3D less one, at rest; ratio of the means over surfaces, at every depth.",
        ),
        "force.ratio.smooth": (
            "The force on the smooth body at the same depth is the same in 1D and 3D",
            "Force in 1D over 3D less one, at rest, at every depth.",
        ),
        "history.force": ("The force is the same in 1D and 3D all along", _HISTORY),
        "history.depth": ("The depth is the same in 1D and 3D all along", _HISTORY),
        "history.friction": ("The tangential force is the same in 1D and 3D all along", _HISTORY),
        "eq14.load-exponent": (
            "Eq. 14: at high speed friction does not depend on the load",
            "d ln μ / d ln F_N at the fastest speed, minus the exponent of Eq. 19 there, least squares over the "
            "loads or depths at which ξ is large.",
        ),
        "eq19.load-exponent": (
            "Eq. 19: at the knee friction falls with the load as the law does",
            "d ln μ / d ln F_N at the speed at which ξ is closest to 1, minus the exponent of the law there, "
            "least squares over the loads or depths.",
        ),
        "law3d.collapse": (
            "Law in 3D: what roughness adds to friction, over that in full contact, is S(x)",
            f"Median of {_ON_THE_LAW}",
        ),
        "rest.depth-deep": (f"{_DEEP}: {_REST_DEPTH[0]}", _REST_DEPTH[1]),
        "rest.depth-shallow": (f"{_SHALLOW}: {_REST_DEPTH[0]}", _REST_DEPTH[1]),
        "rest.force-deep": (f"{_DEEP}: {_REST_FORCE[0]}", _REST_FORCE[1]),
        "rest.force-shallow": (f"{_SHALLOW}: {_REST_FORCE[0]}", _REST_FORCE[1]),
        "rest.stiffness": (
            "At rest, rough: the stiffness is the same in 1D and 3D",
            "rms over neighbouring loads or depths of ln of the ratio of dF/dd.",
        ),
        "pressed-in.slow": (
            "Pressed in at the slowest rate, rough: the force at the greatest depth is the same in 1D and 3D",
            _PRESSED,
        ),
        "pressed-in.fast": (
            "Pressed in at the fastest rate, rough: the force at the greatest depth is the same in 1D and 3D",
            _PRESSED,
        ),
    },
    (0.0, 3 * TOLERANCE): {
        "law3d.collapse-most": (
            "Law in 3D: nine in ten points lie on S(x) to within 15 %",
            f"Nine in ten are below it: {_ON_THE_LAW}",
        ),
    },
    (0.0, CLOSED): {
        "smooth.rest-depth": (
            "Smooth bodies at rest have the depth of Galin and Sneddon",
            "rms over the loads of the relative deviation from the closed form.",
        ),
        "smooth.rest-force": (
            "Smooth bodies at rest have the force of Galin and Sneddon",
            "rms over the depths of the relative deviation from the closed form.",
        ),
        "smooth.pressed-in": (
            "Smooth bodies pressed into a viscoelastic solid have the force of Lee and Radok",
            "rms over rates and depths of the relative deviation from the closed form at the depth reached.",
        ),
    },
    (nan, nan): {  # reported, and not claimed
        "friction.ratio.speed": ("Friction in 1D over 3D", "Ratio of the means at each speed."),
        "own.depth": ("Depth of the scene as it stands, 1D over 3D", _OWN),
        "own.force": ("Force of the scene as it stands, 1D over 3D", _OWN),
        "law3d.averaged": (
            "Misfit from S averaged over the pressure of the body, median",
            f"Median of {_AVERAGED}",
        ),
        "law3d.averaged-most": (
            "Misfit from S averaged over the pressure of the body, nine in ten",
            f"Nine in ten are below it: {_AVERAGED}",
        ),
        "law3d.raw": ("Misfit from S(x) in raw coordinates, median", f"Median of {_RAW}"),
        "law3d.raw-most": (
            "Misfit from S(x) in raw coordinates, nine in ten",
            f"Nine in ten are below it: {_RAW}",
        ),
        "friction.spread": (
            "Spread of both estimates of 3D friction",
            "Friction by traction less friction by energy lost, over friction: an indicator of the error of "
            "discretisation, no bound.",
        ),
        "force.closed-form": (
            "Force on the smooth body over the closed form, less one",
            "At rest, where the closed form is the truth.",
        ),
        "grid.change": (
            "Change of the scene's own answer from half the points to all",
            "Relative, of friction, else of the depth under a load or the force at a depth. The change on halving "
            "understates the error by 1 / (1 - 2^-p) at order p: twice at first order.",
        ),
    },
}
# The same of levels, by the number claimed, at one load or depth: what differs from load to load has no mean.
_LEVELS: dict[float, dict[str, tuple[str, str]]] = {
    1.0: {
        "eq17.level": (
            "Eq. 17: friction at low speed has the level of the law",
            "μ over the law at the slowest speed, with the rms slope as this dimensionality has it and every "
            "wave taken for the shortest.",
        ),
        "eq19.level": (
            "Eq. 19: friction at the knee has the level of the law",
            "μ over the law with α = 1.5 at the speed at which ξ is closest to 1.",
        ),
        "eq14.plateau": (
            "Eq. 14: at high speed friction is √2 times the rms slope",
            "μ over that, times what Eq. 19 has there, at the fastest speed, of the loads or depths at which "
            "ξ is large.",
        ),
        "friction.ratio.slow": ("Rough, at the slowest speed: friction in 1D is that in 3D", _RATIO),
        "friction.ratio.knee": ("Rough, at the knee: friction in 1D is that in 3D", _RATIO),
        "friction.ratio.fast": ("Rough, at the fastest speed: friction in 1D is that in 3D", _RATIO),
    },
    2.0: {
        "friction.ratio.smooth": (
            "Smooth, at the slowest speed: friction in 1D is twice that in 3D",
            f"{_RATIO} It tends to 2 as the speed tends to zero.",
        ),
    },
}
ENDS = "least", "greatest"  # load or depth at which a level is stated
CLAIMS = {
    name: Claim(name, sentence, expected, tolerance, meaning, percent=name.split(".")[0] in IN_PERCENT)
    for (expected, tolerance), texts in _TEXTS.items()
    for name, (sentence, meaning) in texts.items()
} | {
    name: Claim(name, f"{sentence}, at the {end} load or depth", number, number * TOLERANCE, meaning)
    for number, texts in _LEVELS.items()
    for level, (sentence, meaning) in texts.items()
    for end in ENDS
    for name in [f"{level}-{end}"]
}


def claim(name: str, expected: float | None = None) -> Claim:
    """Claim of an id, with the number that the law has in one place, and its tolerance in proportion."""
    found = CLAIMS[name]
    if expected is None:
        return found
    times = expected / found.expected if isfinite(found.expected) else 1.0
    return replace(found, expected=expected, tolerance=found.tolerance * times)


def power(abscissae: np.ndarray, values: np.ndarray) -> float:
    """d ln y / d ln x, least squares; NaN where any of them has no logarithm."""
    x, y = np.log(abscissae), np.log(values)
    lever = x - x.mean()
    return float(lever @ y / (lever @ lever))


def geometric(ratios: np.ndarray) -> float:
    """Geometric mean; NaN where any of them is not positive."""
    return float(np.exp(np.mean(np.log(ratios))))


# Claims in a few words, by their ids, in the order in which tables have them; two ids may answer one question.
SHORT = {
    "history.force": "force all along, 1D/3D",
    "history.depth": "depth all along, 1D/3D",
    "history.friction": "tangential force all along, 1D/3D",
    "friction.ratio.smooth-slow": "slow smooth friction, 1D/3D",
    "force.ratio.rough": "rough force at a depth, 1D/3D − 1",
    "force.ratio.smooth": "smooth force at a depth, 1D/3D − 1",
    "eq23.collapse": "Eq. 23: shifted along load, one curve",
    "eq23.vertical": "Eq. 23: no shift along friction",
    "eq23.vertical-exponent": "Eq. 23: no shift along friction",
    "eq23.predicted": "Eqs. 22, 23: shifted by p(v), one curve",
    "eq23.exponent": "Eqs. 22, 23: power of p(v)",
    "eq18.one-curve": "Eq. 18: one function of ξ",
    "eq19.law": "Eq. 19: the law at all speeds and loads",
    **{f"eq19.level-{end}": "Eq. 19: level at the knee" for end in ENDS},
    "eq19.load-exponent": "Eq. 19: falls with the load at the knee",
    **{f"eq17.level-{end}": "Eq. 17: level at low speed" for end in ENDS},
    "eq17.speed-exponent": "Eq. 17: power of the speed",
    "eq17.load-exponent": "Eq. 17: power of the load",
    "eq17.slope-exponent": "Eq. 17: power of the rms slope",
    "eq17.contact": "Eq. 17: contact with the load",
    "eq17.friction-per-contact": "Eq. 17: friction over the contact",
    "eq17.slope-in-contact": "Eq. 17: slope in the contact",
    "limit.slow": "exact limit of low speed",
    **{f"eq14.plateau-{end}": "Eq. 14: plateau" for end in ENDS},
    "eq14.load-exponent": "Eq. 14: no load at high speed",
    "eq14.slope-exponent": "Eq. 14: power of the rms slope",
    **{
        f"friction.ratio.{where}-{end}": f"friction, {words}, 1D/3D"
        for where, words in (
            ("slow", "slow"), ("knee", "at the knee"), ("fast", "fast"), ("smooth", "smooth and slow")
        )
        for end in ENDS
    },
    "law3d.collapse": "law in 3D: on S(x), median",
    "law3d.collapse-most": "law in 3D: on S(x), nine in ten",
    **{
        f"rest.{what}-{side}": f"{what} at rest, {side}, 1D/3D"
        for what in ("depth", "force")
        for side in ("deep", "shallow")
    },
    "rest.stiffness": "stiffness at rest, 1D/3D",
    "pressed-in.slow": "force, pressed in slowly, 1D/3D",
    "pressed-in.fast": "force, pressed in fast, 1D/3D",
    "smooth.rest-depth": "smooth depth at rest, closed form",
    "smooth.rest-force": "smooth force at rest, closed form",
    "smooth.pressed-in": "smooth force, pressed in, closed form",
}  # fmt: skip
