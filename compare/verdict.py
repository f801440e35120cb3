"""The judgement of a case: the few numbers that matter, each with its error and what it means."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot, nan

import numpy as np

from mdr1d import equations
from scene.scales import elastic_contact

from . import exact, metrics
from .cases import Case
from .commoncurve import Curve
from .mastercurve import Collapse, collapse, misfit_at
from .metrics import Record
from .study import Point
from .sweep import SweepResult
from .wording import explain, plus_minus, said

# Solver's name -> dimension, as the report writes it.
DIMENSIONS = {"MDR": "1D", "BEM": "3D"}
# Said wherever that change stands for an error.
UNDERSTATES = (
    "The change on halving the pixel understates the error of the coarse grid by 1 / (1 - 2^-p) at order p: "
    "at first order the error is twice the change."
)


@dataclass(frozen=True)
class Number:
    """One number that matters.

    name, written : what it is, and value and error in words, "undecided" where one of them is missing
    value, error : SI units or 1; the text says what the error is, NaN if undecided
    text : how it was measured and what it means
    """

    name: str
    written: str
    value: float
    error: float
    text: str


@dataclass(frozen=True)
class Judgement:
    """Everything that figures and report need.

    case : what was asked
    table : every point of every curve
    collapses : by solver's name; a solver whose curves could not be fitted is missing
    numbers : the few that matter
    checks : what stands behind them, and how far they can be trusted
    fields : of the scene's own point, by solver's name
    failures : what was solved and the reason why it failed
    seconds : processor time [s] of all solves by solver's name, those of earlier runs included
    """

    case: Case = field(repr=False)
    table: tuple[Record, ...] = field(repr=False)
    collapses: Mapping[str, Collapse] = field(repr=False)
    numbers: tuple[Number, ...]
    checks: tuple[Number, ...] = field(repr=False)
    fields: Mapping[str, Mapping[str, np.ndarray]] = field(repr=False)
    failures: tuple[tuple[str, str], ...]
    seconds: Mapping[str, float]

    def _repr_html_(self) -> str:
        from .report import fragment

        return fragment(self)


def judge(case: Case, points: Sequence[Point], swept: SweepResult) -> Judgement:
    """Judge a case from the outcomes of all its points."""
    table = tuple(metrics.records(points, swept.outcomes))
    collapses = _collapses(table)
    numbers = [
        *_smooth_limit(case, table),
        *_own_ratio(case, table),
        *_force_depth(table, smooth=case.roughness is None),
        *_misfits(case, collapses),
    ]
    checks = [*_discretisation(case, table), *_friction_spread(table)]
    if case.roughness:
        checks = [*_force_depth(table, smooth=True), *checks]
    checks = [*(_collapse_number(case, name, result) for name, result in collapses.items()), *checks]
    tasks = {task: swept.outcomes[task] for point in points for task in point.tasks}
    failures = [(task.label, row.reason) for task, outcome in tasks.items() for row in outcome.rows if row.reason]
    fields = {task.solver.name: outcome.fields for task, outcome in tasks.items() if outcome.fields}
    return Judgement(
        case, table, collapses, tuple(numbers), tuple(checks), fields, tuple(failures), _seconds(tasks)
    )


def load_curves(table: Sequence[Record], solver: str) -> list[Curve]:
    """ln mu against ln F at each speed, points without friction or load left out.

    The scatter between surfaces, relative to friction, is taken for the same at all points.
    """
    kept = [
        record
        for record in metrics.select(table, "load", solver)
        if record.normal_force.mean > 0 and record.friction_coefficient.mean > 0
    ]
    scatter = metrics.pooled_scatter(record.friction_coefficient for record in kept)
    curves = []
    for speed, records in metrics.by_speed(kept).items():
        friction, load = (
            np.array([getattr(record, name).mean for record in records])
            for name in ("friction_coefficient", "normal_force")
        )
        counts = np.array([record.friction_coefficient.count for record in records])
        curves.append(Curve(speed, np.log(load), np.log(friction), scatter / np.sqrt(counts)))
    return curves


def _seconds(outcomes):
    """A task that several curves share counts once."""
    spent: dict[str, float] = {}
    for task, outcome in outcomes.items():
        total = float(np.nansum([row.seconds for row in outcome.rows]))
        spent[task.solver.name] = spent.get(task.solver.name, 0.0) + total
    return spent


def _collapses(table):
    found = {}
    for solver in DIMENSIONS:
        try:
            found[solver] = collapse([curve for curve in load_curves(table, solver) if curve.log_load.size > 1])
        except ValueError:
            continue
    return found


def _smooth_limit(case, table):
    found = metrics.pairs(table, "smooth")
    if not found:
        return
    slow = min(found, key=lambda pair: pair[0].speed)
    value, _ = metrics.ratio(slow[0].friction_coefficient, slow[1].friction_coefficient)
    error = value * metrics.discretisation(table, slow[1], "friction_coefficient")
    yield Number(
        "1D / 3D friction of the smooth body, slow",
        plus_minus(value, error) + ", tends to 2",
        value,
        error,
        f"Measured at v τ / a = {smooth_speed(case, slow[0]):.2g}; as the speed tends to zero it tends to 2. "
        f"The error is the change of the 3D value when the pixel is halved. {UNDERSTATES}",
    )


def smooth_speed(case: Case, record: Record) -> float:
    """v tau / a with the radius of the smooth relaxed contact; tau is the retardation time."""
    contact = elastic_contact(case.scene)
    return record.speed * float(case.scene.solid.retardation()[2][0]) / contact.radius


def _own_ratio(case, table):
    if not (case.slides and case.motion.speed > 0):
        return
    for above, below in metrics.pairs(table, "own"):
        if not below.friction_coefficient.mean > 0:
            return
        value, error = metrics.ratio(above.friction_coefficient, below.friction_coefficient)
        grid = value * metrics.discretisation(table, below, "friction_coefficient")
        text = f"The body is smooth: the error is the change of 3D when the pixel is halved. {UNDERSTATES}"
        total = grid
        if not below.smooth:
            total = hypot(error, grid) if np.isfinite(grid) else error
            known = (
                f"together with the change of 3D when the pixel is halved. {UNDERSTATES}"
                if np.isfinite(grid)
                else "without that of the 3D grid."
            )
            text = (
                f"Means over {above.normal_force.count} profiles (1D), {below.normal_force.count} surfaces (3D). "
                f"The error is the standard error of the means {known}"
            )
        yield Number("1D / 3D friction at the scene's own point", plus_minus(value, total), value, total, text)


def _force_depth(table, smooth):
    found = [pair for pair in metrics.pairs(table, "force-depth", smooth) if pair[1].normal_force.mean > 0]
    if found:
        yield (_smooth_deviation if smooth else _rough_deviation)(table, found)


def _rough_deviation(table, found):
    """The most significant one: where roughness rules, the largest is the noisiest."""
    deviations = [(pair[1].depth, *_force_deviation(*pair)) for pair in found]
    known = [(depth, value, error) for depth, value, error in deviations if error > 0]
    if known:
        depth, value, error = max(known, key=lambda deviation: abs(deviation[1]) / deviation[2])
        chosen = f"The most significant of {len(found)} depths, {abs(value) / error:.1f} standard errors from zero"
    else:
        depth, value, error = max(deviations, key=lambda deviation: abs(deviation[1]))
        chosen = f"The largest of {len(found)} depths"
    return Number(
        "force at the same depth, 1D over 3D, rough: deviation",
        plus_minus(value, error, "%"),
        value,
        error,
        f"{chosen}, at {depth * 1e6:.3g} µm; the error is the standard error of the means. {len(found)} "
        "comparisons were made, on the same surfaces, and this one was chosen after the fact.",
    )


def _smooth_deviation(table, found):
    above, below = max(found, key=lambda pair: abs(_force_deviation(*pair)[0]))
    value, _ = _force_deviation(above, below)
    exact_there = [r for r in metrics.select(table, "force-depth", "exact") if r.depth == below.depth]
    error = abs(_force_deviation(below, exact_there[0])[0]) if exact_there else nan
    return Number(
        "force at the same depth, 1D over 3D, smooth: deviation",
        plus_minus(value, error, "%"),
        value,
        error,
        f"The largest of {len(found)} depths, at {below.depth * 1e6:.3g} µm; the error is how far the 3D force is "
        "from the closed form.",
    )


def _force_deviation(above, below):
    return metrics.relative_deviation(above.normal_force, below.normal_force)


def _misfits(case, collapses):
    """How far the curves miss one another once shifted as Eq. 23 predicts; value and error of the last one."""
    if not collapses:
        return
    predicted = predicted_exponent(case)
    misfits = {solver: misfit_at(result, predicted).rms for solver, result in collapses.items()}
    written = [
        f"{DIMENSIONS[solver]} {_percent(misfits[solver], 'no overlap')} "
        f"(scatter {_percent(result.scatter, 'unknown')})"
        for solver, result in collapses.items()
    ]
    *_, last = collapses
    yield Number(
        "misfit of the curves shifted as Eq. 23 predicts",
        ", ".join(written),
        misfits[last],
        collapses[last].scatter,
        f"Rms of ln mu (ln F) about one curve; value and error, the scatter between surfaces, are those of "
        f"{DIMENSIONS[last]}. A misfit beyond the scatter means that the curves are not one.",
    )


def predicted_exponent(case: Case) -> float:
    """d ln p / d ln v that Eq. 23 predicts for the shortest wave of the case, or of its 1D grid's cut-off."""
    speeds, rough = case.plan().load_speeds, case.roughness
    if rough is None or len(speeds) < 2:
        return equations.force_shift_exponent(1.0, case.indenter.exponent)
    q_max = rough.q_max(rough.longest / case.mdr.points)
    beta = exact.loss_exponent(case.scene.solid, q_max, speeds)
    return equations.force_shift_exponent(beta, case.indenter.exponent)


def _percent(value, otherwise):
    return f"{value:.1%}" if np.isfinite(value) else otherwise


def _collapse_number(case, solver, result):
    predicted = predicted_exponent(case)
    as_predicted = misfit_at(result, predicted)
    fitted = plus_minus(result.exponent if result.overlaps and result.separable else nan, result.exponent_error)
    return Number(
        f"collapse by horizontal shifts, {DIMENSIONS[solver]}",
        f"misfit {_percent(as_predicted.rms, 'without overlap')} as predicted, {result.after.rms:.1%} at best; "
        f"exponent {fitted} (predicted {predicted:.4g})",
        as_predicted.rms,
        result.scatter,
        f"Rms misfit of ln mu (ln F) to one curve, {result.before.rms:.0%} before shifting. Shifted as Eq. 23 "
        f"predicts, p ~ v^{predicted:.4g}: {said(as_predicted)} Best shifts: {explain(result)} "
        "The scatter is the rms standard error of the points; the same surfaces stand behind all of them.",
    )


def _discretisation(case, table):
    quantity = "normal_force" if case.motion.load is None else "depth_reached"
    if case.slides and case.motion.speed > 0:
        quantity = "friction_coefficient"
    for own in metrics.select(table, "own", "BEM"):
        value = metrics.discretisation(table, own, quantity)
        yield Number(
            f"change of the 3D {quantity.removesuffix('_reached').replace('_', ' ')} with the pixel halved",
            f"{value:.2%}" if np.isfinite(value) else "undecided",
            value,
            nan,
            f"The scene's own point, one surface, {own.points} against {2 * own.points} points a side: an "
            f"estimate of the error of discretisation, no bound. {UNDERSTATES}",
        )


def _friction_spread(table):
    found = [record for record in metrics.select(table, "speed", "BEM") if np.isfinite(record.friction_spread)]
    if not found:
        return
    worst = max(found, key=lambda record: record.friction_spread)
    value = worst.friction_spread
    yield Number(
        "spread of the two estimates of 3D friction",
        f"at most {value:.2%}",
        value,
        nan,
        f"The two estimates of 3D friction, from traction and from energy lost, differ by at most {value:.2%} "
        f"(at v = {worst.speed:.3g} m/s) over {len(found)} speeds: an indicator of the error of discretisation "
        "at every point, no bound.",
    )
