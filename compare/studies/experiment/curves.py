"""What friction curves of one ball, solid and roughness come to: shifts, straight parts, and where they break."""

from collections.abc import Mapping
from math import nan

import numpy as np

from ...statistics.collapse import collapse
from ...statistics.frictioncurves import SimulatedCurves
from .setup import SHIFT

# Change of slope below which two straight parts are one, and least points in each.
STRAIGHT, LEAST = 0.02, 2
TRIED = 401  # places of the break


def two_lines(x: np.ndarray, y: np.ndarray) -> tuple[float, float, float, float]:
    """Best continuous pair of straight lines: where they meet, slopes before and behind it, and the rms left."""
    found = []
    for place in np.linspace(x[LEAST - 1], x[-LEAST], TRIED):
        basis = np.stack([np.ones_like(x), np.minimum(x - place, 0.0), np.maximum(x - place, 0.0)], axis=1)
        numbers = np.linalg.lstsq(basis, y, rcond=None)[0]
        found.append((float(place), *numbers[1:].tolist(), _rms(y - basis @ numbers)))
    return min(found, key=lambda each: each[-1])


def measured(loads: np.ndarray, speeds: np.ndarray, shape: np.ndarray, rough: np.ndarray) -> Mapping[str, float]:
    """Numbers of one set of curves, by the ids of the claims; the break is a force [N].

    shape, rough : parts of the friction coefficient (speeds, loads)
    """
    mu, middle = shape + rough, len(speeds) // 2
    found = collapse(SimulatedCurves(speeds, np.broadcast_to(loads, mu.shape), mu * loads))
    x, y = np.log([loads, mu[middle]])[:, np.isfinite(mu[middle])]
    place, light, heavy, left = two_lines(x, y)
    straight, cubic = (_rms(y - np.polynomial.Polynomial.fit(x, y, degree)(x)) for degree in (1, 3))
    bent = abs(heavy - light) > STRAIGHT
    along, across = found.horizontal.misfit.value, found.vertical.misfit.value
    return {
        "unshifted": found.unshifted.misfit.value,
        "collapse": along,
        "along-friction": across,
        "predicted": found.misfit_at(SHIFT * np.log(found.speeds / speeds[middle])).value,
        "same": across - along,
        "exponent": found.horizontal.exponent.value,
        "one-line": straight,
        "two-lines": left,
        "over-cubic": left / cubic if bent else nan,
        "slope-light": light,
        "slope-heavy": heavy,
        "break": float(np.exp(place)) if bent else nan,
        "level": float(np.exp(y.max())),
        "ball-light": shape[middle, 0] / mu[middle, 0],
        "ball-heavy": shape[middle, -1] / mu[middle, -1],
    }


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
