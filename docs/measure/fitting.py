"""Fit of the models behind the trust map: scales of their processes, and factors on their intervals."""

import json
from dataclasses import asdict, replace

import numpy as np
from scipy.linalg import cho_solve, cholesky
from scipy.optimize import minimize

from compare.trustmap.model import (
    LEAST_VARIANCE,
    NORMAL,
    REGIONS,
    Fitted,
    Model,
    learned,
    lost,
    region_of,
    scattered,
    usable,
)
from compare.trustmap.regression import Process, Scales, bell, covariance, squares

# Where the search for scales begins, and how far it may go: of the inputs in standard deviations, of the values.
_START, _SHORTEST, _LONGEST, _LEAST = 3.0, 0.1, 100.0, 1e-4
# Spread of the logarithm of a length that is expected.
_SPREAD = 1.5
# Least standard deviation of an input: below it is what solvers leave.
_VARIES = 1e-4
# Points that scales are fitted to at most: the time of a fit grows with the cube of their number.
_MOST_FITTED = 2400
MOST_NOISE = 0.25  # beyond which a measured ratio says nothing
ALIKE = 150  # scenes of like error whose intervals widen alike
# Scenes that a process goes through at most: more take longer at each start, and hardly tell more.
MOST_TAKEN = 2600
# Share of the scenes left out that is to lie within, and that in a region of enough scenes: so large that 95 % of
# those lie within to which no scale was fitted, also where the narrower of two intervals is taken.
HELD, HELD_IN_PART, FEWEST = 0.96, 0.97, 40
# Least factor on an error: noise that is larger says little of it.
LEAST_FACTOR = 0.5


def fit(quantity, measured):
    """Model fitted to measurements; takes minutes for thousands of scenes."""
    enough = usable(measured)
    scatter = fitted(*scattered(measured.taken(enough)))
    # Where the noise lets it say something.
    noise = measured.taken(enough).variance(np.exp(scatter.mean(measured.groups[enough])))
    enough = enough[noise < MOST_NOISE**2]
    everything = fitted(*learned(quantity, measured.taken(enough), scatter))
    taken = most_informative(everything, MOST_TAKEN)
    widened = _widened(quantity, everything, taken, scatter)
    return Model(quantity, through(everything, taken), scatter, replace(widened, taken=enough[taken]))


def through(process, chosen):
    """Process of the same scales through some of the points."""
    return Process(process.inputs[chosen], process.values[chosen], process.variances[chosen], process.scales)


def _widened(quantity, everything, taken, scatter):
    """Fitted part of a model: factors by which errors grow for as many of the values left out to lie within."""
    (error, own), inputs = _left_out(everything, taken), everything.inputs
    # How wide each error has to be for its value to lie within, without the noise of what was measured.
    needed = np.sqrt(np.maximum((error / NORMAL) ** 2 - everything.variances, 0))
    counted = np.flatnonzero(~lost(inputs)) if quantity == "depth" else np.arange(own.size)
    alike = np.array_split(counted[np.argsort(own[counted])], max(1, counted.size // ALIKE))
    errors = np.array([np.median(own[few]) for few in alike])
    factors = np.array([max(LEAST_FACTOR, np.quantile(needed[few] / own[few], HELD)) for few in alike])
    parts, here = np.ones(np.prod(REGIONS)), region_of(inputs)[counted]
    found = Fitted(everything.scales, taken, scatter.scales, errors, factors, parts)
    needed = needed / found.widened(own, inputs)
    regions = [needed[counted[here == region]] for region in range(parts.size)]
    widest = [max(1.0, np.quantile(few, HELD_IN_PART)) if few.size >= FEWEST else 1.0 for few in regions]
    return replace(found, parts=np.array(widest))


def _left_out(everything, taken):
    """Errors (N,) of each value predicted from all others that are taken, and their standard errors, noiseless."""
    process = through(everything, taken)
    found, variance = process.predicted(everything.inputs)
    error = everything.values - found
    error[taken], variance[taken] = left_out(process)
    variance[taken] -= process.variances
    return error, np.sqrt(np.maximum(variance, LEAST_VARIANCE))


def fitted(inputs, values, variances):
    """Process of the scales under which the values are likeliest: where there are many, some of them drawn."""
    everything, count = (inputs, values, variances), inputs.shape[1]
    if values.size > _MOST_FITTED:
        drawn = np.random.default_rng(0).permutation(values.size)[:_MOST_FITTED]
        inputs, values, variances = (each[drawn] for each in everything)
    spread = inputs.std(axis=0)
    units = Scales(inputs.mean(axis=0), spread * (spread > _VARIES), np.ones(count), 1.0, 1.0, 1.0)
    start = np.log([_START] * count + [np.std(values), 0.1 * np.std(values), 10 * _LEAST])
    bounds = [(np.log(_SHORTEST), np.log(_LONGEST))] * count + [(np.log(_LEAST), np.log(_LONGEST))] * 3
    given = units.standard(inputs), values - values.mean(), variances
    found = minimize(_unlikeliness, start, given, "L-BFGS-B", jac=True, bounds=bounds)
    *lengths, amplitude, slope, noise = np.exp(found.x).tolist()
    return Process(*everything, Scales(units.middle, units.spread, np.array(lengths), amplitude, slope, noise))


def most_informative(process, most):
    """Numbers of the points, in order, that together are most informative.

    One after the other is taken where what is not known yet, and a measurement would tell, is most.
    """
    if process.values.size <= most:
        return np.arange(process.values.size)
    standard, noise = process.scales.standard(process.inputs), process.variances + process.scales.noise**2
    rest = np.diag(covariance(standard, standard, process.scales)).copy()
    rows, chosen = np.empty((most, rest.size)), np.empty(most, int)
    for k in range(most):
        next_one = chosen[k] = int(np.argmax(rest**2 / (rest + noise)))
        row = covariance(standard[next_one][None], standard, process.scales)[0]
        row -= rows[:k, next_one] @ rows[:k]
        rows[k] = row / np.sqrt(rest[next_one] + noise[next_one])
        rest = np.maximum(rest - rows[k] ** 2, 0.0)
        rest[next_one] = 0.0
    return np.sort(chosen)


def left_out(process):
    """Errors (N,) of each value predicted from all others, and their variances (N,), its noise included."""
    inverse = np.diag(cho_solve((process.factor, True), np.eye(process.values.size)))
    return process.weights / inverse, 1 / inverse


def _unlikeliness(logarithms, inputs, values, variances):
    """Minus the logarithm of the likelihood, and its gradient with the logarithms of the scales."""
    *lengths, amplitude, slope, noise = np.exp(logarithms).tolist()
    scaled, diagonal = inputs / np.array(lengths), np.diag_indices(values.size)
    bells, straight = amplitude**2 * bell(squares(scaled, scaled)), slope**2 * (inputs @ inputs.T)
    matrix = bells + straight + 1
    matrix[diagonal] += variances + noise**2
    factor = cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)
    inverse = cho_solve((factor, True), np.eye(values.size), overwrite_b=True, check_finite=False)
    weights = inverse @ values
    slack = inverse - np.outer(weights, weights)
    # sum_ij w_ij (z_i - z_j)^2 over each input, without an array of all three.
    weighted = slack * bells
    moved = np.sum(scaled**2 * weighted.sum(axis=1)[:, None], axis=0) - np.sum(
        scaled * (weighted @ scaled), axis=0
    )
    # Lengths are expected near _START: one that nothing decides stays there.
    apart = (logarithms[:-3] - np.log(_START)) / _SPREAD
    value = values @ weights / 2 + np.sum(np.log(np.diag(factor))) + np.sum(apart**2) / 2
    others = np.sum(weighted), np.sum(slack * straight), np.trace(slack) * noise**2
    return value, np.concatenate([moved + apart / _SPREAD, others])


def as_json(models):
    """Fitted parts of models by quantity, as the JSON that the package holds."""
    return json.dumps({name: asdict(each.fitted) for name, each in models.items()}, default=_rounded)


def _rounded(array):
    return array.tolist() if array.dtype.kind == "i" else [float(f"{each:.5g}") for each in array]
