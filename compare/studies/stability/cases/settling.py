"""Sets of contact that are slow to settle, or would not: ties, plateaus, poor starts, cycles, no operators."""

from functools import partial

import numpy as np
from scipy.optimize import nnls

from bem3d import contact

from .hardcase import Check, Group, refusal
from .matrix import FINE, Matrix, Ring, conditions, rounds_at_once, solved

PLAIN = "Conditions of contact by a plain product to 1e-9."
BOUNDED = "Refused after a bounded number of sets of contact, with the violation that was left and the one wanted."
CASES = case = Group("settling")


def _rough(n, seed):
    return np.random.default_rng(seed).standard_normal((n, n))


def _round(n):
    """Square of the distance from the middle of a square of n points a side."""
    y, x = np.mgrid[:n, :n] - (n - 1) / 2
    return x**2 + y**2


def _apart(what, found, known):
    """Pressure is another to 1e-6 of its peak."""
    return Check(what, np.abs(found.ravel() - known.ravel()).max() / known.max(), 1e-6)


@case(
    "All heights are the same: no point is deeper than any other, and at rest all touch.",
    "At rest pressure as by elimination, to 1e-6 of its peak, as contact is solved to 1e-9; in a flow, which "
    "lifts the trailing points, conditions of contact by a plain product.",
)
def flat_punch_of_ties(size):
    still, flowing, heights = Matrix(10, 13), Matrix(10, 13, memory=5.0), np.zeros((10, 13))
    known = np.linalg.solve(still.values, np.ones(heights.size))
    found = solved(still, heights, load=1.0).pressure.ravel()
    yield Check("at rest, against elimination", np.abs(found - known / known.sum()).max() / found.max(), 1e-6)
    yield from conditions(flowing, heights, solved(flowing, heights, load=1.0), "flowing")


@case(
    "Heights take few values: most pixels tie with many others.",
    "Conditions of contact by a plain product to 1e-9; pressure as of nonnegative least squares, another "
    "algorithm, to 1e-6 of its peak.",
)
def terraces(size):
    n = 16
    heights = np.floor(_round(n) / 30) + np.random.default_rng(3).integers(0, 2, (n, n)) / 4
    matrix = Matrix(n, n)
    root = np.linalg.cholesky(matrix.values)
    for depth in (0.25, 1.0, 2.0):
        found = solved(matrix, heights, start=np.maximum(depth - heights, 0.0), depth=depth)
        yield from conditions(matrix, heights, found, f"depth {depth:g}")
        known, _ = nnls(root.T, np.linalg.solve(root, (depth - heights).ravel()), maxiter=10_000)
        yield _apart(f"depth {depth:g}: against least squares", found.pressure, known)


@case("Every second pixel is high: the shortest wave of the grid, all crests tied.", PLAIN)
def checkerboard(size):
    heights = np.indices((14, 14)).sum(axis=0) % 2 * 1.0
    for matrix in (Matrix(14, 14), Matrix(14, 14, memory=3.0)):
        for load in (0.5, 50.0):
            found = solved(matrix, heights, load=load)
            yield from conditions(matrix, heights, found, f"memory {matrix.memory:g}, load {load:g}")


@case(
    "The search starts on the highest point, on all, on those that will not touch, at 1e150 and at 1e-300.",
    "The same pressure from each start to 1e-6 of its peak: contact is unique, and solved to 1e-9.",
)
def wrong_start(size):
    rough = _rough(16, seed=7)
    starts = {
        "the highest point": (rough == rough.max()) * 1.0,
        "all points": np.ones(rough.shape),
        "what will not touch": np.where(rough > 0.5, 1.0, 0.0),
        "a pressure of 1e150": np.where(rough < 0, 1e150, 0.0),
        "a pressure of 1e-300": np.where(rough < 0, 1e-300, 0.0),
    }
    for matrix in (Matrix(16, 16), Matrix(16, 16, memory=8.0)):
        known = solved(matrix, rough, load=5.0).pressure
        for name, start in starts.items():
            found = solved(matrix, rough, start=start, load=5.0).pressure
            yield _apart(f"memory {matrix.memory:g}, from {name}", found, known)


@case(
    "On rough bodies under memories up to 1e4 pixels all trailing edges shed and gain points in each round.", PLAIN
)
def rough_and_fast(size):
    n = 24
    for memory in (1.0, 100.0, 1e4):
        matrix = Matrix(n, n, memory)
        for seed in (0, 1):
            heights = _round(n) / (5 * n) + 0.3 * _rough(n, seed)
            found = solved(matrix, heights, depth=0.5)
            yield from conditions(matrix, heights, found, f"memory {memory:g}, seed {seed}")


@case(
    "Rings of three points, each pushed by the next: dropping and adding at once never ends.",
    "It does cycle at once, and conditions of contact hold to 1e-9 all the same.",
)
def contact_set_cycles(size):
    ring, most = Ring(copies=8, coupling=1.5), 50
    heights = np.zeros(ring.shape) + 1e-3 * np.arange(3)
    start = np.zeros(ring.shape)
    start[:, 0] = 1.0
    rounds = rounds_at_once(ring, heights, 1.0, most, start > 0)
    yield Check("rounds at once, short of never", float(most - rounds), 0.0)
    yield from conditions(ring, heights, solved(ring, heights, start=start, depth=1.0), "ring")


def _unsettled(what, operator, words, tolerance=FINE, symmetric=True):
    heights = _rough(12, seed=2)
    ask = partial(contact.solve, operator, heights, np.maximum(1.0 - heights, 0.0), tolerance, depth=1.0)
    return refusal(what, contact.NotConverged, words, ask, symmetric=symmetric)


@case("An operator of seven digits is to be solved to thirteen.", BOUNDED)
def tolerance_out_of_reach(size):
    matrix = Matrix(12, 12)

    def rounded(plane, out):
        out[:] = matrix(plane.astype(np.float32)).astype(np.float32)
        return out

    yield _unsettled("thirteen digits of seven", rounded, "sets of contact | violation | 1.00e-13", 1e-13)


@case("An operator that is not positive definite: there may be no answer, or several.", BOUNDED)
def attracting_half_space(size):
    matrix = Matrix(12, 12)
    matrix.values = -matrix.values
    for symmetric in (True, False):
        yield _unsettled("an attracting half-space", matrix, "violation | 1.00e-09", symmetric=symmetric)
