"""Plots of the shifts of one series: its curves shifted onto one, and the shifts against the speed."""

from functools import partial

import numpy as np
from pandas import DataFrame, concat

from ...report.page import Plot
from ...statistics import eq23
from ...statistics.collapse import ENDS
from ...statistics.finding import FAILS, HOLDS
from ..claims.figures import friction as study_friction
from ..claims.figures.friction import ALONE, COMMON, FITTED, LAW, PREDICTED
from ..claims.judgement import JudgedSeries
from ..claims.points import each_dimension, force_at, friction_at, interval_columns, place_columns, stacked
from ..claims.series import SOLVERS


def collapse(judged: JudgedSeries) -> Plot:
    """Curves as they are, and shifted onto their common curve."""
    parts = {"collapse": _shifted, "collapse-curves": _curves, "collapse-fits": _fit}
    verdicts = [each for each in judged.findings if each.claim.id == eq23.COLLAPSE.id]
    return Plot(
        f"{judged.series.folder}/collapse",
        study_friction.collapse,
        {name: each_dimension(partial(table, judged)) for name, table in parts.items()},
        "Friction against normal force, a curve for each speed; below, shifted along the force (Eq. 23) onto "
        "their common curve, or by p(v) of Eq. 22 where it is undecided whether there is one. Last, where both "
        "have one: distance from that curve, tolerance in grey; δ, its rms without scatter. Bars: 95 %.",
        "; ".join(f"{each.dimension}: {each.verdict}" for each in verdicts),
        {"tolerance": eq23.TOLERANCE},
    )


def _fitted(judged, solver):
    """Collapse whose shifts are known, where it is decided whether the curves fall onto one; else None."""
    found = judged.collapses.get(solver)
    if found is None or (lead := _lead(judged, solver)).curve is None:
        return None
    own = (each for each in judged.findings if each.claim.id == eq23.COLLAPSE.id)
    verdicts = {each.verdict for each in own if each.dimension == SOLVERS[solver]}
    return found if lead is found.both or verdicts & {HOLDS, FAILS} else None


def _lead(judged, solver):
    """Alignment of the curves of a solver that its findings have as the answer."""
    own = [each for each in judged.findings if each.dimension == SOLVERS[solver]]
    return eq23.leading(judged.collapses[solver], own)


def _shifted(judged, solver) -> DataFrame:
    """Every point, shifted as fits best or, where no shifts are known, as theory has it."""
    contacts, series, found = judged.contacts, judged.series, _fitted(judged, solver)
    mu, load = friction_at(contacts, solver), force_at(contacts, solver).value
    frame = DataFrame(
        place_columns(series) | {"normal_force": load.ravel()} | interval_columns("friction_coefficient", mu)
    )
    if found is None:
        shift = np.broadcast_to(_predicted(judged, solver)[:, None], load.shape)
        how = np.full(load.shape, PREDICTED, object)
    else:
        shift, lift = np.full((2, *load.shape), np.nan)
        how, lead = np.full(load.shape, ALONE, object), _lead(judged, solver)
        for row, known, *by in zip(
            map(series.speeds.index, found.speeds.tolist()),
            found.data.known,
            lead.horizontal.value,
            lead.vertical.value,
            strict=True,
        ):
            (shift[row, known], lift[row, known]), how[row, known] = by, FITTED
    frame["shifted_force"] = (load * np.exp(shift)).ravel()
    frame["shifted_as"] = how.ravel()
    curve = np.nan if found is None else lead.curve(np.log(frame["shifted_force"])) - lift.ravel()
    for end in ENDS:
        positive = frame[f"friction_coefficient{end}"].where(lambda value: value > 0)
        frame[f"off_curve{end}"] = np.log(positive) - curve
        if found is not None and lead is found.both:
            frame[f"shifted_friction{end}"] = frame[f"friction_coefficient{end}"] * np.exp(lift.ravel())
    return frame


def _predicted(judged, solver):
    """ln p(v) of all speeds over that of the middle one, whose curve is not moved."""
    found, speeds, shifts = _fitted(judged, solver), judged.series.speeds, judged.laws[solver].shifts
    kept = speeds if found is None else found.speeds.tolist()
    return shifts - shifts[speeds.index(kept[len(kept) // 2])]


def _curves(judged, solver) -> DataFrame:
    """The common curve, and Eq. 19 at all points, which is one curve once shifted as theory has it."""
    laws, found, parts = judged.laws[solver], _fitted(judged, solver), []
    if found is not None:
        curve = _lead(judged, solver).curve
        first, last = curve.domain
        x = np.linspace(first, last, 201)
        columns = {"shifted_force": np.exp(x), "friction_coefficient": np.exp(curve(x))}
        parts.append(DataFrame({"curve": COMMON} | columns))
    load = (np.exp(_predicted(judged, solver))[:, None] * laws.load).ravel()
    law = DataFrame({"curve": LAW, "shifted_force": load, "friction_coefficient": laws.law.ravel()})
    return concat([*parts, law.dropna().sort_values("shifted_force")], ignore_index=True)


def _fit(judged, solver) -> DataFrame:
    found = judged.collapses.get(solver)
    if found is None:
        return DataFrame([{"misfit": np.nan, "reason": "too few points"}])
    lead = _lead(judged, solver)
    missed = _said(judged, solver, lead.misfit, eq23.BOTH if lead is found.both else eq23.COLLAPSE)
    row = {
        **{f"misfit{end}": each for end, each in zip(ENDS, missed, strict=True)},
        "rms": lead.rms,
        "degree": found.degree if lead.curve is None else lead.curve.degree(),
        "points_left_out": found.points_left_out,
        "surfaces_left_out": found.surfaces_left_out,
        "reason": lead.reason,
    }
    return DataFrame([row])


def _said(judged, solver, number, *claims):
    """A number and its interval as the first finding on some claims has them; its own where there is none."""
    findings = {each.claim.id: each for each in judged.findings if each.dimension == SOLVERS[solver]}
    for each in (findings[claim.id] for claim in claims if claim.id in findings):
        return each.value, *each.interval
    return number.value, *number.interval()


def shifts(judged: JudgedSeries) -> Plot | None:
    """Shifts against the speed; None where no solver has any."""
    fitted = {solver: found for solver in SOLVERS if (found := _fitted(judged, solver))}
    if not fitted:
        return None
    moved, fits = {}, {}
    for solver, found in fitted.items():
        dimension, lead = SOLVERS[solver], _lead(judged, solver)
        theory = judged.laws[solver].shifts[[judged.series.speeds.index(speed) for speed in found.speeds.tolist()]]
        moved[dimension,] = found.shifts(lead).assign(theory=theory - theory[len(theory) // 2])
        power = eq23.BESIDE if lead is found.both else eq23.ALONE
        numbers = _said(judged, solver, lead.exponent, eq23.EXPONENT, power)
        fits[dimension,] = DataFrame([{f"exponent{end}": each for end, each in zip(ENDS, numbers, strict=True)}])
    return Plot(
        f"{judged.series.folder}/shifts",
        study_friction.shifts,
        {"shifts": stacked(moved, "dimension"), "shifts-fits": stacked(fits, "dimension")},
        "Shifts that bring the curves onto one, zero at the middle speed, with intervals of 95 % over surfaces. "
        "(a) Along ln F_N, alone unless friction itself is shifted, and ln p(v) of Eq. 22 (line). (b) Their "
        "difference. (c) Along ln μ, both fitted; grey, the tolerance.",
        f"Shifts against speed in {' and '.join(SOLVERS[solver] for solver in fitted)}",
        {"tolerance": eq23.TOLERANCE},
    )
