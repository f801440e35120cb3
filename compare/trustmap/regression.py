"""Regression of a Gaussian process on some hundred measured points, each with the variance of its own noise."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import cho_solve, cholesky, solve_triangular

BLOCK = 256  # rows of a covariance that are found together: they stay in a cache


@dataclass(frozen=True)
class Scales:
    """Scales of a process: what is fitted, and nothing else.

    middle, spread : mean and standard deviation of each input (D,); 0 for an input that varies by rounding alone
    lengths : over which values change, of each input in its standard deviations (D,)
    amplitude : of the changes
    slope : of the straight part along each input
    noise : standard deviation that the stated noise leaves out
    """

    middle: np.ndarray
    spread: np.ndarray
    lengths: np.ndarray
    amplitude: float
    slope: float
    noise: float

    def standard(self, inputs: np.ndarray) -> np.ndarray:
        """Inputs (M, D) from their middle, in standard deviations; one without is dropped."""
        varies = self.spread > 0
        return (inputs - self.middle) * np.where(varies, 1 / np.where(varies, self.spread, 1.0), 0.0)


@dataclass(frozen=True, eq=False)
class Process:
    """Gaussian process through measured points.

    inputs : of the points (N, D)
    values : measured (N,)
    variances : of the noise of each value (N,)
    scales : fitted
    """

    inputs: np.ndarray
    values: np.ndarray
    variances: np.ndarray
    scales: Scales

    def mean(self, inputs: np.ndarray) -> np.ndarray:
        """Means (M,) at new inputs (M, D)."""
        return self._common(inputs) @ self.weights + self.values.mean()

    def predicted(self, inputs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Means (M,) and variances (M,) at new inputs (M, D), without the noise of a measurement."""
        left = solve_triangular(self.factor, self._common(inputs).T, lower=True, check_finite=False)
        scales = self.scales
        own = scales.amplitude**2 + scales.slope**2 * np.sum(scales.standard(inputs) ** 2, axis=1) + 1
        return self.mean(inputs), own - np.sum(left**2, axis=0) + scales.noise**2

    def _common(self, inputs):
        scales = self.scales
        return covariance(scales.standard(inputs), scales.standard(self.inputs), scales)

    @cached_property
    def factor(self):
        standard = self.scales.standard(self.inputs)
        matrix = np.empty((self.values.size, self.values.size))
        for start in range(0, len(matrix), BLOCK):
            rows = slice(start, start + BLOCK)
            matrix[rows, start:] = covariance(standard[rows], standard[start:], self.scales)
        matrix[np.diag_indices_from(matrix)] += self.variances + self.scales.noise**2
        # Transposed, it is in the order of LAPACK, which then copies nothing and reads its lower triangle alone.
        return cholesky(matrix.T, lower=True, overwrite_a=True, check_finite=False)

    @cached_property
    def weights(self):
        return cho_solve((self.factor, True), self.values - self.values.mean(), check_finite=False)


def squares(first, second):
    """Squared distances (N, M) between points (N, D), (M, D)."""
    found = np.sum(first**2, axis=1)[:, None] + np.sum(second**2, axis=1)
    found -= 2 * first @ second.T
    return np.maximum(found, 0.0, out=found)


def bell(squares):
    """Bells of squared distances, in their place: of thousands of points each array takes 50 MB."""
    squares /= -2
    return np.exp(squares, out=squares)


def covariance(first, second, scales):
    """Covariances (N, M) between standard inputs (N, D), (M, D); a constant of variance 1 is not known before."""
    found = bell(squares(first / scales.lengths, second / scales.lengths))
    found *= scales.amplitude**2
    straight = first @ second.T
    straight *= scales.slope**2
    found += straight
    found += 1
    return found
