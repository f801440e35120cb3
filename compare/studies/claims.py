"""Claims that studies judge, each by its id, and what measures them: powers, geometric means, places along xi."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ..finding import BOTH, Claim

# How far from what is claimed still counts as it: what a reader of a diagram over decades of friction would not
# see, and less than what any measured roughness is known to.
TOLERANCE = 0.05
# How close theory and solution are where theory is exact.
CLOSED = 0.01
_RATIO = "Ratio of the coefficients, 1D over 3D, geometric mean over the loads or depths."
_PRESSED = "ln of the ratio of forces, each over that of the smooth body at the depth reached."

CLAIMS = {
    claim.id: claim
    for claim in (
        Claim(
            "eq17.speed-exponent",
            "Eq. 17: at low speed friction grows with the speed as the loss at the shortest wave does",
            tolerance=TOLERANCE,
            meaning="d ln mu / d ln v between the two slowest speeds, mean over the loads or depths.",
        ),
        Claim(
            "eq17.load-exponent",
            "Eqs. 16, 17: at low speed friction falls with the load as F_N^(-n/(n+1))",
            tolerance=TOLERANCE,
            meaning="d ln mu / d ln F_N at the slowest speed, least squares over the loads or depths. The law "
            "leaves out the slope of the macroscopic shape.",
        ),
        Claim(
            "eq17.level",
            "Eq. 17: friction at low speed has the level of the law",
            1.0,
            TOLERANCE,
            "mu over the law at the slowest speed, geometric mean over the loads or depths, with the rms slope "
            "as this dimensionality has it and every wave taken for the shortest.",
        ),
        Claim(
            "limit.slow",
            "Friction at the slowest speed is that of the exact limit of low speed",
            1.0,
            TOLERANCE,
            "Not of the paper: mu at the slowest speed over v tau times the mean of d2z/dx2 weighted with the "
            "pressure at rest (3D), or over Eq. 10 with the contact at rest (1D); geometric mean over the loads "
            "or depths, on the same surfaces. It tells a fault of a solver from the failure of a law. In 3D "
            "friction is found by that mean where the contact trails by less than a quarter of a pixel "
            "(docs/theory.md, Eq. 5e): the check is then of the pressure found in sliding.",
        ),
        Claim(
            "eq14.plateau",
            "Eq. 14: at high speed friction is sqrt(2) times the rms slope",
            1.0,
            TOLERANCE,
            "mu over that, times what Eq. 19 has there, at the fastest speed, geometric mean over the loads or "
            "depths at which xi is large.",
        ),
        Claim(
            "eq19.law",
            "Eq. 19: friction follows the law at all speeds and loads",
            0.0,
            2 * TOLERANCE,
            "rms over all points of ln mu less that of the law with alpha = 1.5, without what scatter adds.",
        ),
        Claim(
            "eq18.one-curve",
            "Eq. 18: friction over its plateau is one function of xi, whatever roughness and solid",
            0.0,
            2 * TOLERANCE,
            "rms of ln mu about one curve through all points of several series, none shifted, without what "
            "scatter adds.",
        ),
        Claim(
            "eq17.slope-exponent",
            "Eq. 17: friction at the slowest speed goes as the rms slope to the power 2",
            2.0,
            2 * TOLERANCE,
            "d ln mu / d ln of the rms slope, least squares over several rms heights, mean of the loads or "
            "depths at which all are at that limit, but for what Eq. 19 still lacks of it.",
        ),
        Claim(
            "eq14.slope-exponent",
            "Eq. 14: friction at the fastest speed goes as the rms slope to the power 1",
            1.0,
            TOLERANCE,
            "d ln mu / d ln of the rms slope, least squares over several rms heights, mean of the loads or "
            "depths at which all are at that limit, but for what Eq. 19 still lacks of it.",
        ),
        Claim(
            "pair.friction-slow",
            "Rough, at the slowest speed: friction in 1D is that in 3D",
            1.0,
            TOLERANCE,
            _RATIO,
        ),
        Claim("pair.friction-knee", "Rough, at the knee: friction in 1D is that in 3D", 1.0, TOLERANCE, _RATIO),
        Claim(
            "pair.friction-fast",
            "Rough, at the fastest speed: friction in 1D is that in 3D",
            1.0,
            TOLERANCE,
            _RATIO,
        ),
        Claim(
            "pair.smooth",
            "Smooth, at the slowest speed: friction in 1D is that in 3D",
            1.0,
            TOLERANCE,
            f"{_RATIO} It tends to 2 as the speed tends to zero.",
        ),
        *(
            Claim(f"rest.{name}-{side}", f"At rest, rough, {where}: {sentence}", 0.0, TOLERANCE, meaning)
            for name, sentence, meaning in (
                (
                    "depth",
                    "the depth under a load is the same in 1D and 3D",
                    "rms over loads of the difference of depths, over that of the smooth body.",
                ),
                (
                    "force",
                    "the force at a depth is the same in 1D and 3D",
                    "rms over depths of ln of the ratio of forces.",
                ),
            )
            for side, where in (("deep", "h0 at most 0.1 d"), ("shallow", "h0 above 0.1 d"))
        ),
        Claim(
            "rest.stiffness",
            "At rest, rough: the stiffness is the same in 1D and 3D",
            0.0,
            TOLERANCE,
            "rms over neighbouring loads or depths of ln of the ratio of dF/dd.",
        ),
        Claim(
            "smooth.rest-depth",
            "Smooth bodies at rest have the depth of Galin and Sneddon",
            0.0,
            CLOSED,
            "rms over the loads of the relative deviation from the closed form.",
        ),
        Claim(
            "smooth.rest-force",
            "Smooth bodies at rest have the force of Galin and Sneddon",
            0.0,
            CLOSED,
            "rms over the depths of the relative deviation from the closed form.",
        ),
        Claim(
            "smooth.pressed-in",
            "Smooth bodies pressed into a viscoelastic solid have the force of Lee and Radok",
            0.0,
            CLOSED,
            "rms over rates and depths of the relative deviation from the closed form at the depth reached.",
        ),
        *(
            Claim(
                f"pressed-in.{name}",
                f"Pressed in at the {name}est rate, rough: the force at the greatest depth is the same in 1D "
                "and 3D",
                0.0,
                TOLERANCE,
                _PRESSED,
            )
            for name in ("slow", "fast")
        ),
    )
}


def claim(name: str, measure: Callable[[Any], Any], dimension: str = BOTH, expected: float | None = None) -> Claim:
    """Claim of an id with what measures it in one place.

    expected : number that the law has there; that of the claim if absent
    """
    found = CLAIMS[name]
    number = found.expected if expected is None else expected
    return replace(found, measure=measure, dimension=dimension, expected=number)


def power(abscissae: np.ndarray, values: np.ndarray) -> float:
    """d ln y / d ln x, least squares; NaN where any of them has no logarithm."""
    x, y = np.log(abscissae), np.log(values)
    lever = x - x.mean()
    return float(lever @ y / (lever @ lever))


def geometric(ratios: np.ndarray) -> float:
    """Geometric mean."""
    return float(np.exp(np.mean(np.log(ratios))))


def at_xi(values: np.ndarray, words: str) -> str:
    """Regime in words, behind the range of xi in which a number was measured."""
    known = np.asarray(values)[np.isfinite(values)]
    reached = f"{known.min():.2g} to {known.max():.2g}" if known.size else "unknown"
    return f"xi {reached}; {words}"
