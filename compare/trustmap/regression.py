"""Regression of a Gaussian process on some hundred measured points, each with the variance of its own noise."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import cho_solve, cholesky, solve_triangular

# Where the search for scales begins, and how far it may go: of the inputs in standard deviations, of the values.
_START, _SHORTEST, _LONGEST, _LEAST = 3.0, 0.1, 100.0, 1e-4
# Spread of the logarithm of a length that is expected.
_SPREAD = 1.5
# Least standard deviation of an input: below it is what solvers leave.
_VARIES = 1e-4


@dataclass(frozen=True)
class Scales:
    """Scales of a process: what is fitted, and nothing else.

    lengths : over which values change, of each input in its standard deviations (D,)
    amplitude : of the changes
    slope : of the straight part along each input
    noise : standard deviation that the stated noise leaves out
    """

    lengths: np.ndarray
    amplitude: float
    slope: float
    noise: float

    @classmethod
    def of(cls, logarithms: np.ndarray) -> "Scales":
        """Scales of their logarithms (D + 3,)."""
        *lengths, amplitude, slope, noise = np.exp(logarithms).tolist()
        return cls(np.array(lengths), amplitude, slope, noise)


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

    @classmethod
    def fitted(cls, inputs: np.ndarray, values: np.ndarray, variances: np.ndarray) -> "Process":
        """Process of the scales under which the values are likeliest."""
        from scipy.optimize import minimize  # slow, and only a fit needs it

        count = inputs.shape[1]
        start = np.log([_START] * count + [np.std(values), 0.1 * np.std(values), 10 * _LEAST])
        bounds = [(np.log(_SHORTEST), np.log(_LONGEST))] * count + [(np.log(_LEAST), np.log(_LONGEST))] * 3
        given = _standard(inputs, inputs), values - values.mean(), variances
        found = minimize(_unlikeliness, start, given, "L-BFGS-B", jac=True, bounds=bounds)
        return cls(inputs, values, variances, Scales.of(found.x))

    def mean(self, inputs: np.ndarray) -> np.ndarray:
        """Means (M,) at new inputs (M, D)."""
        return self._common(inputs) @ self._weights + self.values.mean()

    def predicted(self, inputs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Means (M,) and variances (M,) at new inputs (M, D), without the noise of a measurement."""
        left = solve_triangular(self._factor, self._common(inputs).T, lower=True, check_finite=False)
        scales = self.scales
        own = scales.amplitude**2 + scales.slope**2 * np.sum(self._standard(inputs) ** 2, axis=1) + 1
        return self.mean(inputs), own - np.sum(left**2, axis=0) + scales.noise**2

    def left_out(self) -> tuple[np.ndarray, np.ndarray]:
        """Errors (N,) of each value predicted from all others, and their variances (N,), its noise included."""
        inverse = np.diag(cho_solve((self._factor, True), np.eye(self.values.size)))
        return self._weights / inverse, 1 / inverse

    def distances(self, place: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Distances (M,) of inputs (D,) from points (M, D), in lengths over which values change."""
        apart = self._standard(points) - self._standard(place[None])
        return np.sqrt(np.sum((apart / self.scales.lengths) ** 2, axis=1))

    def _standard(self, inputs):
        return _standard(inputs, self.inputs)

    def _common(self, inputs):
        return _covariance(self._standard(inputs), self._standard(self.inputs), self.scales)

    @cached_property
    def _factor(self):
        standard = self._standard(self.inputs)
        matrix = _covariance(standard, standard, self.scales)
        matrix[np.diag_indices(self.values.size)] += self.variances + self.scales.noise**2
        # Transposed, it is the same in the order of LAPACK, which then copies nothing.
        return cholesky(matrix.T, lower=True, overwrite_a=True, check_finite=False)

    @cached_property
    def _weights(self):
        return cho_solve((self._factor, True), self.values - self.values.mean(), check_finite=False)


def _standard(inputs, among):
    """Inputs (M, D) in standard deviations of those of many (N, D); one that rounding alone moves is dropped."""
    spread = among.std(axis=0)
    return (inputs - among.mean(axis=0)) * np.where(spread > _VARIES, 1 / np.maximum(spread, _VARIES), 0.0)


def _squares(first, second):
    """Squared distances (N, M) between points (N, D), (M, D)."""
    found = np.sum(first**2, axis=1)[:, None] + np.sum(second**2, axis=1)
    found -= 2 * first @ second.T
    return np.maximum(found, 0.0, out=found)


def _bell(squares):
    """Bells of squared distances, in their place: of thousands of points each array takes 50 MB."""
    squares /= -2
    return np.exp(squares, out=squares)


def _covariance(first, second, scales):
    """Covariances (N, M) between standard inputs (N, D), (M, D); a constant of variance 1 is not known before."""
    found = _bell(_squares(first / scales.lengths, second / scales.lengths))
    found *= scales.amplitude**2
    straight = first @ second.T
    straight *= scales.slope**2
    found += straight
    found += 1
    return found


def _unlikeliness(logarithms, inputs, values, variances):
    """Minus the logarithm of the likelihood, and its gradient with the logarithms of the scales."""
    scales, diagonal = Scales.of(logarithms), np.diag_indices(values.size)
    scaled = inputs / scales.lengths
    bell, straight = scales.amplitude**2 * _bell(_squares(scaled, scaled)), scales.slope**2 * (inputs @ inputs.T)
    matrix = bell + straight + 1
    matrix[diagonal] += variances + scales.noise**2
    factor = cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)
    inverse = cho_solve((factor, True), np.eye(values.size), overwrite_b=True, check_finite=False)
    weights = inverse @ values
    slack = inverse - np.outer(weights, weights)
    # sum_ij w_ij (z_i - z_j)^2 over each input, without an array of all three.
    weighted = slack * bell
    lengths = np.sum(scaled**2 * weighted.sum(axis=1)[:, None], axis=0) - np.sum(
        scaled * (weighted @ scaled), axis=0
    )
    # Lengths are expected near _START: one that nothing decides stays there.
    apart = (logarithms[:-3] - np.log(_START)) / _SPREAD
    value = values @ weights / 2 + np.sum(np.log(np.diag(factor))) + np.sum(apart**2) / 2
    others = np.sum(weighted), np.sum(slack * straight), np.trace(slack) * scales.noise**2
    return value, np.concatenate([lengths + apart / _SPREAD, others])
