"""BEM in steady sliding: points, tolerance, the estimates of friction, and the solver's own word on its error."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import nan

import numpy as np

from bem3d import BEM
from scene import Scene, Slide, Sphere, StandardLinearSolid

from ...statistics.convergence import MeasuredLadder
from .convergence import Convergence, points_and_tolerances
from .diagram import reported
from .reference import DEPTH, FORCE, FRICTION, Known, Quantity, Reference, closed_form, finer, slow_limit
from .scenes import FULL, KELVIN, QUICK, SPHERE, at, powers, rough, slid, some

TIGHT = BEM(tolerance=1e-7)
POINTS = {"quick": (32, 64, 128), "full": powers(32, 512)}
ROUGH_POINTS = {"quick": (64, 128, 256), "full": powers(64, 512)}
TOLERANCES = {"quick": (1e-2, 1e-4, 1e-6), "full": (1e-2, 1e-3, 1e-4, 1e-6)}
AT = {"quick": 64, "full": 256}
REFERENCE, ROUGH_REFERENCE = {"quick": 512, "full": 1024}, 1024
FLOWS = {"quick": (1.0,), "full": (0.1, 1.0, 10.0)}
SPEEDS = {"quick": (0.1,), "full": (0.1, 1.0)}
SLOW = 2e-4  # m/s, at which the limit of low speed is the truth
# Depth [mm] and mu R [mm] by v tau_c [mm] of a sphere, R = 10 mm, 0.533333 N, E_g/E_r = 2: two independent codes,
# good to a millionth of a millimetre and to 1e-4.
TABLE = {0.1: (0.099824, 0.045249), 1.0: (0.091508, 0.157664), 10.0: (0.070553, 0.041906)}
TABLE_ERRORS = 1e-9, 1e-4


def _over_load(row, _, name):
    return row.measures.get(name, nan) / row.normal_force if row.normal_force else nan


def _indicated(row, _):
    return row.measures.get("friction_disagreement", nan) / row.friction_coefficient


# The answer joins traction, loss and curvature; work stands beside.
JOINED = Quantity("friction", FRICTION.label, FRICTION.of, "joined")
BESIDE = TRACTION, LOSS, CURVATURE, WORK = tuple(
    Quantity(f"friction_by_{by}", FRICTION.label, partial(_over_load, name=f"friction_by_{by}"), f"by {by}")
    for by in ("traction", "loss", "curvature", "work")
)
# What a solver says itself of the error of its friction, relative: no error, but drawn as one.
INDICATOR = Quantity("friction_disagreement", FRICTION.label, _indicated, "indicator")
ESTIMATES = (JOINED, *BESIDE, INDICATOR)


def estimates_of(reference: Reference) -> Reference:
    """Reference of friction, said of all of its estimates; the indicator counts from zero."""

    def known(asked, outcomes):
        own = [each for each in asked if each not in (*BESIDE, INDICATOR)]
        found = dict(reference.values(own, outcomes))
        beside = {each.name: found[JOINED.name] for each in BESIDE}
        return found | beside | {INDICATOR.name: Known(0.0, scale=1.0)}

    return replace(reference, values=known)


def contacts(size: str) -> Sequence[Convergence]:
    """Smooth at several speeds, rough at low speed and above."""
    smooth = [_smooth(flow, size) for flow in some(FLOWS, size)]
    tabulated = [] if size == QUICK else [_tabulated(memory, size) for memory in TABLE]
    return [*smooth, *tabulated, _slow(size), *(_rough(speed, size) for speed in some(SPEEDS, size))]


def _smooth(flow, size):
    scene = slid(SPHERE, KELVIN, flow)
    truth = estimates_of(finer(scene, replace(TIGHT, points=at(REFERENCE, size)), "{} points"))
    title = f"sphere, Kelvin, v τ = {_times(flow)}a"
    return Convergence(f"kelvin-{flow:g}", title, truth, (FORCE, *ESTIMATES), _ladders(scene, POINTS, size))


def _tabulated(memory, size):
    # The retardation time is twice the relaxation time.
    solid = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=2e6, relaxation_time=5e-4)
    scene = Scene(Sphere(radius=10e-3), solid, Slide(speed=memory, load=0.533333))
    (depth, arm), (depth_error, error) = TABLE[memory], TABLE_ERRORS
    values = {DEPTH.name: Known(1e-3 * depth, depth_error), JOINED.name: Known(arm / 10, error * arm / 10)}
    truth = estimates_of(closed_form("two independent codes", values))
    title = f"sphere, standard linear, v τ = {_times(memory)}a"
    return Convergence(f"standard-{memory:g}", title, truth, (DEPTH, *ESTIMATES), _ladders(scene, POINTS, size))


def _times(factor):
    return "" if factor == 1 else f"{factor:g} "


def _slow(size):
    scene = rough(SLOW)
    truth = estimates_of(slow_limit(scene, replace(TIGHT, points=ROUGH_REFERENCE)))
    title = f"rough sphere, {1e3 * SLOW:g} mm/s"
    return Convergence("rough-slow", title, truth, ESTIMATES, _ladders(scene, ROUGH_POINTS, size)[:1])


def _rough(speed, size):
    scene = rough(speed)
    reference = replace(TIGHT, points=ROUGH_REFERENCE)
    truth = estimates_of(finer(scene, reference, "{} points on the same surface"))
    ladders = _ladders(scene, ROUGH_POINTS, size)[: None if size == FULL else 1]
    return Convergence(f"rough-{speed:g}", f"rough sphere, {speed:g} m/s", truth, ESTIMATES, ladders)


def _ladders(scene, points, size):
    settings = at(points, size), at(AT, size), at(TOLERANCES, size)
    return points_and_tolerances(scene, TIGHT, *settings)


def estimates(found: Mapping[str, list[MeasuredLadder]]) -> Iterator:
    """Mean error of each estimate over all contacts, and what the indicator is worth."""
    every = [each for own in found.values() for each in own]
    for quantity in (JOINED, *BESIDE):
        own = (each.errors for each in every if each.quantity == quantity.name and each.setting == "points")
        errors = np.concatenate([np.empty(0), *own])
        errors = errors[np.isfinite(errors) & (errors > 0)]
        value = float(np.exp(np.log(errors).mean())) if errors.size else nan
        sentence = f"Error of friction {quantity.by}, geometric mean over all grids"
        yield reported(f"sliding.estimate-{quantity.by.split()[-1]}", sentence, value)
    ratios = _over_indicator(every)
    sentence = "Error of friction over the solver's own indicator (friction_disagreement)"
    for name, of in (("median", np.median), ("largest", np.max)):
        value = float(of(ratios)) if ratios.size else nan
        why = "no error stands out from the reference"
        yield reported(f"sliding.indicator-{name}", f"{sentence}, {name}", value, missing=why)


def _over_indicator(every):
    """Ratios where the reference is good enough to tell."""
    ratios = [np.empty(0)]
    said = {(each.contact, each.ladder): each.errors for each in every if each.quantity == INDICATOR.name}
    for each in every:
        if each.quantity == JOINED.name:
            error, indicated = each.errors, said[each.contact, each.ladder]
            told = np.isfinite(error) & np.isfinite(indicated) & (error > each.reference_error) & (indicated > 0)
            ratios.append(error[told] / indicated[told])
    return np.concatenate(ratios)
