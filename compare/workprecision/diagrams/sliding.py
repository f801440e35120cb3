"""BEM in steady sliding: points, tolerance, the estimates of friction, and the solver's own word on its error."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bem3d import BEM
from scene import Scene, Slide, Sphere, StandardLinearSolid

from .. import wording
from ..contest import DEPTH, FORCE, ClosedForm, Contest, Finer, Judged, Known, Ladder
from ..diagram import Diagram
from . import estimates
from .estimates import INDICATOR, JOINED, OTHERS, OfFriction
from .scenes import KELVIN, SPHERE, powers, rough, slid
from .slowlimit import SlowLimit

TIGHT = BEM(tolerance=1e-7)
POINTS = {"quick": (32, 64, 128), "full": powers(32, 512)}
ROUGH_POINTS = {"quick": (64, 128, 256), "full": powers(64, 512)}
TOLERANCES = {"quick": (1e-2, 1e-4, 1e-6), "full": (1e-2, 1e-3, 1e-4, 1e-6)}
AT = {"quick": 64, "full": 256}
REFERENCE, ROUGH_REFERENCE = {"quick": 512, "full": 1024}, {"quick": 1024, "full": 1024}
FLOWS = {"quick": (1.0,), "full": (0.1, 1.0, 10.0)}
SPEEDS = {"quick": (0.1,), "full": (0.1, 1.0)}
SLOW = 2e-4  # m/s, at which the limit of low speed is the truth
# Depth [mm] and mu R [mm] by v tau_c [mm] of a sphere, R = 10 mm, 0.533333 N, E_g/E_r = 2: two independent codes,
# good to a millionth of a millimetre and to 1e-4.
TABLE = {0.1: (0.099824, 0.045249), 1.0: (0.091508, 0.157664), 10.0: (0.070553, 0.041906)}
TABLE_ERRORS = 1e-9, 1e-4
LEVELS = (1e-2, 1e-3, 1e-4)
# The indicator times these is compared with the error.
FACTORS = (0.1, 1, 3)


def contests(size: str) -> Sequence[Contest]:
    """Smooth at several speeds, rough at low speed and above."""
    smooth = [_smooth(flow, size) for flow in FLOWS[size]]
    tabulated = [_tabulated(memory, size) for memory in TABLE] if size == "full" else []
    return [*smooth, *tabulated, _slow(size), *(_rough(speed, size) for speed in SPEEDS[size])]


def _smooth(flow, size):
    scene = slid(SPHERE, KELVIN, flow)
    reference = replace(TIGHT, points=REFERENCE[size])
    truth = OfFriction(Finer.of(scene, reference, f"{reference.points} points"))
    title = f"sphere, Kelvin, v τ = {_times(flow)}a"
    return Contest(f"kelvin-{flow:g}", title, truth, (FORCE, *estimates.ALL), _ladders(scene, POINTS, size))


def _tabulated(memory, size):
    # The retardation time is twice the relaxation time.
    solid = StandardLinearSolid(rubbery_modulus=1e6, glassy_modulus=2e6, relaxation_time=5e-4)
    scene = Scene(Sphere(radius=10e-3), solid, Slide(speed=memory, load=0.533333))
    (depth, arm), (depth_error, error) = TABLE[memory], TABLE_ERRORS
    values = {DEPTH.name: Known(1e-3 * depth, depth_error), JOINED.name: Known(arm / 10, error * arm / 10)}
    truth = OfFriction(ClosedForm("two independent codes", values))
    title = f"sphere, standard linear, v τ = {_times(memory)}a"
    return Contest(f"standard-{memory:g}", title, truth, (DEPTH, *estimates.ALL), _ladders(scene, POINTS, size))


def _times(factor):
    return "" if factor == 1 else f"{factor:g} "


def _slow(size):
    scene = rough(SLOW)
    truth = OfFriction(SlowLimit.of(scene, replace(TIGHT, points=ROUGH_REFERENCE[size])))
    title = f"rough sphere, {1e3 * SLOW:g} mm/s"
    return Contest("rough-slow", title, truth, estimates.ALL, _by_points(scene, ROUGH_POINTS, size))


def _rough(speed, size):
    scene = rough(speed)
    reference = replace(TIGHT, points=ROUGH_REFERENCE[size])
    truth = OfFriction(Finer.of(scene, reference, f"{reference.points} points on the same surface"))
    ladders = _by_points(scene, ROUGH_POINTS, size) if size == "quick" else _ladders(scene, ROUGH_POINTS, size)
    return Contest(f"rough-{speed:g}", f"rough sphere, {speed:g} m/s", truth, estimates.ALL, ladders)


def _by_points(scene, points, size):
    return (Ladder.of("BEM, by points", scene, TIGHT, "points", points[size]),)


def _ladders(scene, points, size):
    label = f"BEM, by tolerance at {AT[size]}²"
    by_tolerance = Ladder.of(label, scene, BEM(points=AT[size]), "tolerance", TOLERANCES[size])
    return *_by_points(scene, points, size), by_tolerance


def advice(found: Sequence[Judged]) -> str:
    """Points for a level, the tolerance that is enough, the best estimate, and what the indicator is worth."""
    said = []
    for judged in found:
        points, *others = judged.climbed
        levels, order = (
            wording.levels(judged, points, JOINED.name, LEVELS),
            wording.order(judged, points, JOINED.name),
        )
        enough = "".join(f"; {wording.enough(each, JOINED.name)}" for each in others)
        said.append(f"For the {JOINED.label} of the {judged.contest.title}, {levels}; {order}{enough}.")
    return f"{' '.join(said)} {_estimates(found)} {_indicator(found)}{wording.failures(found)}"


def _estimates(found):
    """Geometric means over the ladders of points of all contests."""
    mean = {}
    for each in (JOINED, *OTHERS):
        errors = np.concatenate([judged.climbed[0].errors[each.name] for judged in found])
        errors = errors[np.isfinite(errors) & (errors > 0)]
        mean[each.by] = float(np.exp(np.log(errors).mean())) if errors.size else np.inf
    if not np.isfinite(list(mean.values())).all():
        return "Which estimate of friction is best cannot be told."
    ranked = ", ".join(f"{by} {wording.share(mean[by])}" for by in sorted(mean, key=mean.get))
    return f"Over all rungs by points, the mean errors of the estimates of friction are: {ranked}."


def _indicator(found):
    """How often it bounds the error, where the reference is good enough to tell."""
    ratios = []
    for judged in found:
        own = judged.known[JOINED.name].relative_error
        for climbed in judged.climbed:
            error, said = climbed.errors[JOINED.name], climbed.errors[INDICATOR.name]
            told = np.isfinite(error) & np.isfinite(said) & (error > own) & (said > 0)
            ratios += list(error[told] / said[told])
    if not ratios:
        return "What the solver says of its own error cannot be tested, as no error stands out from the reference."
    ratios = np.array(ratios)
    within = " and ".join(
        f"below {factor:g} times it in {np.count_nonzero(ratios <= factor)}" for factor in FACTORS
    )
    return (
        "The solver's own indicator is friction_disagreement over the friction coefficient. Of "
        f"{len(ratios)} rungs whose error stands out from the reference, the error is {within}; in the median it "
        f"is {np.median(ratios):.2g} times the indicator, at most {ratios.max():.2g} times."
    )


DIAGRAM = Diagram(
    "sliding",
    "Three dimensions in steady sliding: error against points and tolerance",
    "BEM in steady sliding: smooth spheres against finer grids and the table of two independent codes, rough ones "
    "against the same surface refined and, at low speed, against the limit by curvature. That is the estimate by "
    "curvature on a finer grid: there the joined estimate is tested in its pressure only. All estimates of "
    "friction come from the same solves, and the solver's own indicator is drawn beside them.",
    contests,
    advice,
)
