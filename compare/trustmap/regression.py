"""Regression of a Gaussian process on some hundred measured points, each with the variance of its own noise."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.linalg import cho_solve, cholesky, solve_triangular

# Where the search for scales begins, and how far it may go: of the inputs in standard deviations, of the values.
_START, _SHORTEST, _LONGEST, _LEAST = 3.0, 0.1, 100.0, 1e-4
# Spread of the logarithm of a length that is expected.
_SPREAD = 1.5
# Least standard deviation of an input: below it is what solvers leave.
_VARIES = 1e-4
# Points that scales are fitted to at most: the time of a fit grows with the cube of their number.
_MOST_FITTED = 2400


@dataclass(frozen=True)
class Scales:
    """Scales of a process: what is fitted, and nothing else.

    middle, spread : mean and standard deviation of each input (D,); 0 of one that rounding alone moves
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

    @classmethod
    def fitted(cls, inputs: np.ndarray, values: np.ndarray, variances: np.ndarray) -> "Process":
        """Process of the scales under which the values are likeliest: where there are many, some of them drawn."""
        from scipy.optimize import minimize  # slow, and only a fit needs it

        everything, count = (inputs, values, variances), inputs.shape[1]
        if values.size > _MOST_FITTED:
            drawn = np.random.default_rng(0).permutation(values.size)[:_MOST_FITTED]
            inputs, values, variances = (each[drawn] for each in everything)
        spread = np.where(inputs.std(axis=0) > _VARIES, inputs.std(axis=0), 0.0)
        units = Scales(inputs.mean(axis=0), spread, np.ones(count), 1.0, 1.0, 1.0)
        start = np.log([_START] * count + [np.std(values), 0.1 * np.std(values), 10 * _LEAST])
        bounds = [(np.log(_SHORTEST), np.log(_LONGEST))] * count + [(np.log(_LEAST), np.log(_LONGEST))] * 3
        given = units.standard(inputs), values - values.mean(), variances
        found = minimize(_unlikeliness, start, given, "L-BFGS-B", jac=True, bounds=bounds)
        *lengths, amplitude, slope, noise = np.exp(found.x).tolist()
        scales = replace(units, lengths=np.array(lengths), amplitude=amplitude, slope=slope, noise=noise)
        return cls(*everything, scales)

    def telling(self, most: int) -> np.ndarray:
        """Numbers of so many points, in order, that together tell most of all of them.

        One after the other is taken where what is not known yet, and a measurement would tell, is most.
        """
        if self.values.size <= most:
            return np.arange(self.values.size)
        standard, noise = self._standard(self.inputs), self.variances + self.scales.noise**2
        rest = np.diag(_covariance(standard, standard, self.scales)).copy()
        rows, chosen = np.empty((most, rest.size)), np.empty(most, int)
        for k in range(most):
            next_one = chosen[k] = int(np.argmax(rest**2 / (rest + noise)))
            row = _covariance(standard[next_one][None], standard, self.scales)[0]
            row -= rows[:k, next_one] @ rows[:k]
            rows[k] = row / np.sqrt(rest[next_one] + noise[next_one])
            rest = np.maximum(rest - rows[k] ** 2, 0.0)
            rest[next_one] = 0.0
        return np.sort(chosen)

    def taken(self, chosen: np.ndarray) -> "Process":
        """Process of the same scales through some of the points."""
        return Process(self.inputs[chosen], self.values[chosen], self.variances[chosen], self.scales)

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
        return self.scales.standard(inputs)

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
    *lengths, amplitude, slope, noise = np.exp(logarithms).tolist()
    scaled, diagonal = inputs / np.array(lengths), np.diag_indices(values.size)
    bell, straight = amplitude**2 * _bell(_squares(scaled, scaled)), slope**2 * (inputs @ inputs.T)
    matrix = bell + straight + 1
    matrix[diagonal] += variances + noise**2
    factor = cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)
    inverse = cho_solve((factor, True), np.eye(values.size), overwrite_b=True, check_finite=False)
    weights = inverse @ values
    slack = inverse - np.outer(weights, weights)
    # sum_ij w_ij (z_i - z_j)^2 over each input, without an array of all three.
    weighted = slack * bell
    moved = np.sum(scaled**2 * weighted.sum(axis=1)[:, None], axis=0) - np.sum(
        scaled * (weighted @ scaled), axis=0
    )
    # Lengths are expected near _START: one that nothing decides stays there.
    apart = (logarithms[:-3] - np.log(_START)) / _SPREAD
    value = values @ weights / 2 + np.sum(np.log(np.diag(factor))) + np.sum(apart**2) / 2
    others = np.sum(weighted), np.sum(slack * straight), np.trace(slack) * noise**2
    return value, np.concatenate([moved + apart / _SPREAD, others])
