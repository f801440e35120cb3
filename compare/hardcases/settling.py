"""Sets of contact that are slow to settle, or would not: ties, plateaus, poor starts, cycles, no operators."""

from functools import partial

import numpy as np
from scipy.optimize import nnls

from bem3d import contact

from .hardcase import Check, Group, refusal
from .matrix import Matrix, Ring, conditions, rounds_at_once, solved

FINE = 1e-9  # tolerance of problems given as a matrix
CASES = case = Group("settling")


@case(
    "All heights are the same: no point is deeper than any other, and at rest all touch.",
    "At rest pressure as by elimination, to 1e-6 of its peak, as contact is solved to 1e-9; in a flow, which "
    "lifts the trailing points, conditions of contact by a plain product.",
)
def flat_punch_of_ties(size):
    still, heights = Matrix(10, 13), np.zeros((10, 13))
    known = np.linalg.solve(still.values, np.ones(heights.size))
    found = solved(still, heights, FINE, load=1.0).pressure.ravel()
    yield Check("at rest, against elimination", np.abs(found - known / known.sum()).max() / found.max(), 1e-6)
    flowing = Matrix(10, 13, memory=5.0)
    yield from conditions(flowing, heights, solved(flowing, heights, FINE, load=1.0), FINE, "flowing")


@case(
    "Heights take few values: most pixels tie with many others.",
    "Conditions of contact by a plain product to 1e-9; pressure as of nonnegative least squares, another "
    "algorithm, to 1e-6 of its peak.",
)
def terraces(size):
    n = 16
    y, x = np.mgrid[:n, :n] - (n - 1) / 2
    heights = np.floor((x**2 + y**2) / 30) + np.random.default_rng(3).integers(0, 2, (n, n)) / 4
    matrix = Matrix(n, n)
    root = np.linalg.cholesky(matrix.values)
    for depth in (0.25, 1.0, 2.0):
        found = solved(matrix, heights, FINE, start=np.maximum(depth - heights, 0.0), depth=depth)
        yield from conditions(matrix, heights, found, FINE, f"depth {depth:g}")
        known, _ = nnls(root.T, np.linalg.solve(root, (depth - heights).ravel()), maxiter=10_000)
        apart = np.abs(found.pressure.ravel() - known).max() / known.max()
        yield Check(f"depth {depth:g}: against least squares", apart, 1e-6)


@case(
    "Every second pixel is high: the shortest wave of the grid, all crests tied.",
    "Conditions of contact by a plain product to 1e-9.",
)
def checkerboard(size):
    heights = np.indices((14, 14)).sum(axis=0) % 2 * 1.0
    for memory in (0.0, 3.0):
        matrix = Matrix(14, 14, memory)
        for load in (0.5, 50.0):
            found = solved(matrix, heights, FINE, load=load)
            yield from conditions(matrix, heights, found, FINE, f"memory {memory:g}, load {load:g}")


@case(
    "The search starts on the highest point, on all, on those that will not touch, at 1e150 and at 1e-300.",
    "The same pressure from each start to 1e-6 of its peak: contact is unique, and solved to 1e-9.",
)
def wrong_start(size):
    n = 16
    rough = np.random.default_rng(7).standard_normal((n, n))
    starts = {
        "the highest point": (rough == rough.max()) * 1.0,
        "all points": np.ones((n, n)),
        "what will not touch": np.where(rough > 0.5, 1.0, 0.0),
        "a pressure of 1e150": np.where(rough < 0, 1e150, 0.0),
        "a pressure of 1e-300": np.where(rough < 0, 1e-300, 0.0),
    }
    for memory in (0.0, 8.0):
        matrix = Matrix(n, n, memory)
        known = solved(matrix, rough, FINE, load=5.0)
        for name, start in starts.items():
            found = solved(matrix, rough, FINE, start=start, load=5.0)
            apart = np.abs(found.pressure - known.pressure).max() / known.pressure.max()
            yield Check(f"memory {memory:g}, from {name}", apart, 1e-6)


@case(
    "On rough bodies under memories up to 1e4 pixels all trailing edges shed and gain points in each round.",
    "Conditions of contact by a plain product to 1e-9.",
)
def rough_and_fast(size):
    n = 24
    y, x = np.mgrid[:n, :n] - (n - 1) / 2
    for memory in (1.0, 100.0, 1e4):
        matrix = Matrix(n, n, memory)
        for seed in (0, 1):
            heights = (x**2 + y**2) / (5 * n) + 0.3 * np.random.default_rng(seed).standard_normal((n, n))
            found = solved(matrix, heights, FINE, depth=0.5)
            yield from conditions(matrix, heights, found, FINE, f"memory {memory:g}, seed {seed}")


@case(
    "Rings of three points, each pushed by the next: dropping and adding at once never ends.",
    "It does cycle at once, and conditions of contact hold to 1e-9 all the same.",
)
def contact_set_cycles(size):
    ring = Ring(copies=8, coupling=1.5)
    heights = np.zeros(ring.shape) + 1e-3 * np.arange(3)
    start = np.zeros(ring.shape)
    start[:, 0] = 1.0
    most = 50
    yield Check(
        "rounds at once, short of never", float(most - rounds_at_once(ring, heights, 1.0, most, start > 0)), 0.0
    )
    found = contact.solve(ring, heights, start, FINE, depth=1.0)
    yield from conditions(ring, heights, found, FINE, "ring")


@case(
    "An operator of seven digits is to be solved to thirteen.",
    "Refused after a bounded number of sets of contact, with the violation that was left and the one wanted.",
)
def tolerance_out_of_reach(size):
    matrix = Matrix(12, 12)

    def rounded(plane, out):
        out[:] = matrix(plane.astype(np.float32)).astype(np.float32)
        return out

    heights = np.random.default_rng(2).standard_normal((12, 12))
    start = np.maximum(1.0 - heights, 0.0)
    ask = partial(contact.solve, rounded, heights, start, 1e-13, depth=1.0, symmetric=True)
    words = "sets of contact | violation | 1.00e-13"
    yield refusal("thirteen digits of seven", contact.NotConverged, words, ask)


@case(
    "An operator that is not positive definite: there may be no answer, or several.",
    "Refused after a bounded number of sets of contact, with the violation that was left and the one wanted.",
)
def attracting_half_space(size):
    matrix = Matrix(12, 12)
    matrix.values = -matrix.values
    heights = np.random.default_rng(2).standard_normal((12, 12))
    start = np.maximum(1.0 - heights, 0.0)
    for symmetric in (True, False):
        ask = partial(contact.solve, matrix, heights, start, FINE, depth=1.0, symmetric=symmetric)
        yield refusal("an attracting half-space", contact.NotConverged, "violation | 1.00e-09", ask)
