"""Plots of a case: the tables behind each figure, from its curves and findings."""

from collections.abc import Sequence

import numpy as np
import xarray
from pandas import DataFrame, concat

from ...figures import collapse, contact_maps, force_depth, friction_load, friction_speed, smooth_limit
from ...figures.curves import averaged, of_curves
from ...report.page import Plot
from ...report.views import view
from ...statistics import eq23
from ..theory import THEORY
from .claims import ROUGH_FORCE, SMOOTH_FORCE, CaseFindings
from .curves import (
    LOAD,
    ROUGH_DEPTH,
    SMOOTH_DEPTH,
    SMOOTH_SPEED,
    SPEED,
    edge_slope,
    friction_law,
    predicted_exponent,
    scaled_speed,
    slow_friction,
)

EQ_19 = " Dashed: Eq. 19 with exponent 1.5 and the rms slope of the 1D profiles, without that of the smooth shape."


def plots_of_case(found: CaseFindings, fields: xarray.DataTree) -> list[Plot]:
    """Figures of a case. fields : of its own contact by solver"""
    case, folder, points = found.case, f"{found.folder}/", found.points
    arrays = {
        solver: {str(name): each.values for name, each in node.variables.items()}
        for solver, node in fields.children.items()
    }
    forces = [
        {"body": body, "solver": solver, "depth": depth, "difference": each.value, **_ends("difference", each)}
        for claim, body in ((ROUGH_FORCE, "rough"), (SMOOTH_FORCE, "smooth"))
        for solver, depth, each in found.forces(claim)
    ]
    at_rest = of_curves(points, points["curve"].isin((ROUGH_DEPTH, SMOOTH_DEPTH)))
    plots = [
        contact_maps.plot(view(case.scene, case.bem, arrays), folder),
        force_depth.plot(at_rest, DataFrame(forces), folder=folder),
        *_friction(found, folder),
        collapse.plot(_shifted(found), folder=folder),
        _smooth_limit(found, folder),
    ]
    return [each for each in plots if each is not None]


def friction_of_cases(cases: Sequence[CaseFindings]) -> Plot | None:
    """Friction of several scenes against speed, side by side."""
    every = [(each.name, _curve(each, SPEED)[0], _ratios(each)) for each in cases]
    points, ratios = (
        concat([row[k].assign(case=row[0]) for row in every if len(row[k])] or [DataFrame()], ignore_index=True)
        for k in (1, 2)
    )
    caption = "Coefficient of friction of all scenes against speed, each at its own load or depth; below, ratios."
    return friction_speed.plot(points, ratios, caption=caption) if len(points) else None


def _ends(name, found):
    return dict(zip((f"{name}_low", f"{name}_high"), found.interval, strict=True))


def _curve(found: CaseFindings, curve: str) -> tuple[DataFrame, DataFrame]:
    """Points of the models of a curve that slides, and lines of theories beside them."""
    own = of_curves(found.points, found.points["curve"] == curve)
    beside = own["solver"] == ("" if THEORY.name in found.models.labels else THEORY.name)
    lines = own[beside].rename(columns={"friction_coefficient_mean": "friction_coefficient"})
    return own[~beside], lines.assign(kind=friction_speed.THEORY)


def _eq_19(found: CaseFindings, points: DataFrame, places: DataFrame) -> DataFrame:
    """Eq. 19 at speeds and loads, with the slope of 1D profiles; nothing of a smooth body."""
    own = points[points["solver"] == "MDR"]
    slope = own["rms_slope_mean"].iloc[0] if len(own) and "rms_slope_mean" in own else np.nan
    mu = friction_law(found.case, places["load"], places["speed"], slope) if np.isfinite(slope) else []
    return (
        places.assign(solver="MDR", kind=friction_speed.EQ_19, friction_coefficient=mu) if len(mu) else places[:0]
    )


def _ratios(found: CaseFindings) -> DataFrame:
    body = "rough" if found.case.roughness else "smooth"
    rows = [
        {"solver": solver, "body": body, "speed": speed, "ratio": each.value, **_ends("ratio", each)}
        for solver, speed, each in found.at_speeds
    ]
    return DataFrame(rows)


def _friction(found: CaseFindings, folder: str) -> list[Plot | None]:
    """Friction against speed, and against load or depth at several speeds."""
    plots, motion = [], found.case.motion
    pressed = (
        f"load of {motion.greatest:g} N" if motion.load is not None else f"depth of {motion.greatest * 1e6:g} µm"
    )
    for curve in (SPEED, LOAD):
        points, lines = _curve(found, curve)
        if points.empty:
            continue
        law = points[:0]
        if "load" in points:
            places = points[points["solver"] == "MDR"][["speed", "load"]]
            if curve == SPEED and points["speed"].nunique() > 1:
                speeds = np.geomspace(points["speed"].min(), points["speed"].max(), 101)
                places = DataFrame({"speed": speeds, "load": points["load"].iloc[0]})
            law = _eq_19(found, points, places)
        told = (EQ_19 if len(law) else "") + (" Thin: Persson's theory (2001), not judged." if len(lines) else "")
        names = [
            "solver",
            "kind",
            "speed",
            *points.columns.intersection(["load", "depth"]),
            "friction_coefficient",
        ]
        frames = [each[names] for each in (lines, law) if len(each)]
        beside = concat(frames, ignore_index=True) if frames else None
        if curve == SPEED:
            caption = f"Friction against speed at a {pressed}; below, over the reference.{told} {averaged(points)}"
            plots.append(friction_speed.plot(points, _ratios(found), beside, caption, folder))
        else:
            caption = f"Friction against load or depth, a curve for each speed.{told} {averaged(points)}"
            plots.append(friction_load.plot(points, beside, caption, folder))
    return plots


def _shifted(found: CaseFindings) -> list[collapse.ShiftedCurves]:
    """Friction against load shifted onto one curve."""
    expected = predicted_exponent(found.case)
    return [
        collapse.ShiftedCurves(
            found.models[each.solver].label,
            each.collapse,
            {one.claim.id: one for one in each.findings},
            expected,
            lead=eq23.leading(each.collapse, each.findings),
        )
        for each in found.shifted
    ]


def _smooth_limit(found: CaseFindings, folder: str) -> Plot | None:
    """Friction of the smooth body from slow to fast."""
    points = found.points[found.points["curve"] == SMOOTH_SPEED]
    if points.empty:
        return None
    scaled = {speed: scaled_speed(found.case, speed) for speed in points["speed"]}
    slope = edge_slope(found.case)
    names = {
        f"friction_over_slope_{end}": points[f"friction_coefficient_{end}"] / slope
        for end in ("mean", "low", "high")
    }
    table = points[["solver", "speed"]].assign(v_tau_over_a=points["speed"].map(scaled), **names)
    ratios = [
        {"solver": solver, "v_tau_over_a": scaled[speed], "ratio": each.value, **_ends("ratio", each)}
        for solver, speed, each in found.ratios(SMOOTH_SPEED)
    ]
    limits = DataFrame(slow_friction(found.case, found.models).items(), columns=["solver", "friction_over_slope"])
    limits = limits[limits["solver"].isin(table["solver"])]
    return smooth_limit.plot(table, DataFrame(ratios), limits, folder)
