"""Figures of a comparison: the tables behind each, from the answers, laws, shifts and findings of its series."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import nan
from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure
from pandas import DataFrame, concat

from mdr1d.equations import interpolation
from scene.files.reading import InvalidInput
from scene.printable import brief

from ...figures import (
    collapse,
    contact,
    family,
    force_depth,
    friction_load,
    friction_speed,
    history,
    law,
    slow_friction,
    smooth_limit,
)
from ...figures.plot import Plot
from ...figures.rendering import finished
from ...figures.views import view
from ...models.table import DEPTH, FORCE, FRICTION
from ...solving.curve import COARSE, FINE
from ...solving.words import number
from ...statistics import eq23
from ...statistics.finding import Finding
from ...statistics.intervals import Estimated
from ...statistics.jackknife import mean, mean_ratio
from . import around
from .answers import Answers
from .around import LOAD, OWN, ROUGH_DEPTH, SMOOTH_DEPTH, SMOOTH_SPEED, SPEED, Around
from .claims_law import SHALLOW, LawPoints
from .measures import Here, behind, closed_forms, loading, nominal_exponent
from .rough import ROUGH, SMOOTH, RoughSeries
from .series import Judged, Series, ratio_of
from .sweep import CONTACTS, means
from .together import Member, families, reduced

ENDS = "", "_low", "_high"
MU = "friction_coefficient"
LINES = "Lines: Eq. 19 and theories, not judged. Bars: 95 %."


def of_series(series: Series, answers: Answers, judged: Judged, points: DataFrame, tree) -> Iterator[Plot]:
    """Figures of one series."""
    folder = f"{series.folder}/" if series.folder else ""
    drawn: list[Plot | None] = []
    if isinstance(series, Around):
        drawn.append(_map(series, tree, folder))
        axis = series.curves[OWN].axis
        if axis in ("time", "displacement", "force"):
            frames = {
                (each,): _history(answers, each, axis) for each in series.models.labels if answers.has(OWN, each)
            }
            drawn.append(history.plot(stacked(frames, "model"), axis, series.scene, folder))
        else:
            drawn.append(_forces(series, answers, points, {ROUGH_DEPTH: "rough", SMOOTH_DEPTH: "smooth"}, folder))
            drawn += _friction(series, answers, judged, points, SPEED, LOAD, folder)
            drawn.append(_smooth_limit(series, answers, points[points["curve"] == SMOOTH_SPEED], folder))
    elif isinstance(series, RoughSeries):
        drawn += _friction(series, answers, judged, points, ROUGH, ROUGH, folder)
        if any(each.claim.id == "eq17.contact" for each in judged.findings):
            frames = {(model,): _causes(series, answers, model, own) for model, own in judged.laws.items()}
            drawn.append(slow_friction.plot(stacked(frames, "model"), folder))
        if judged.laws and (found := LawPoints.of(series, answers, judged.laws)):
            drawn.append(_law([found], judged.findings, folder))
        drawn.append(_forces(series, answers, points, {ROUGH: "rough", SMOOTH: "smooth"}, folder))
    else:
        drawn += _friction(series, answers, judged, points, CONTACTS, CONTACTS, folder)
    yield from (each for each in drawn if each is not None)


def of_several(series: Sequence[Series], members: Sequence[Member], every: Mapping[str, tuple[Answers, DataFrame]],
               findings: Sequence[Finding]) -> Iterator[Plot]:  # fmt: skip
    """Figures of several series together."""
    scenes = [each for each in series if isinstance(each, Around) and SPEED in each.curves]
    if len(scenes) > 1:
        parts = {(each.name,): _along(each, *every[each.name], SPEED) for each in scenes}
        points, ratios = (stacked({name: own[k] for name, own in parts.items()}, "case") for k in (0, 1))
        caption = "Friction of all scenes against speed, each at its own load or depth; below, ratios. Bars: 95 %."
        if (plot := friction_speed.plot(points, ratios, caption=caption)) is not None:
            yield plot
    if found := families(members):
        frames = {
            (model, shape): _reduced(own, model)
            for shape, own in found.items()
            for model in own[0].series.models.labels
        }
        yield family.plot(stacked(frames, "model", "shape"))
    laws = [own for each in members if (own := LawPoints.of(each.series, each.answers, each.laws))]
    if len(laws) > 1:
        yield _law(laws, findings)


def stacked(frames: Mapping[Any, DataFrame], *names: str) -> DataFrame:
    """Tables one below the other, with the words that name each in its first columns."""
    return concat(frames, names=names).reset_index(level=list(range(len(names)))).reset_index(drop=True)


def _at(series: Series, curve: str, numbers: Mapping[str, Any], moving: bool = True) -> DataFrame:
    """Speed, and load or depth, of the points of a curve, and numbers there, or intervals with both ends.

    moving : of the points that move alone; else of those first on the curve for which there are numbers
    """
    own = series.curves[curve]
    speeds = [each for each in own.speeds if each > 0 or not moving]
    places = [each.ravel() for each in np.meshgrid(speeds, own.values, indexing="ij")]
    columns = dict(zip(("speed", own.prescribed), places, strict=True))
    for name, found in numbers.items():
        found = found.ends if isinstance(found, Estimated) else found
        ends = zip(ENDS, found, strict=True) if isinstance(found, tuple) else [("", found)]
        columns |= {f"{name}{end}": np.ravel(each) for end, each in ends}
    count = min(map(np.size, columns.values()))
    return DataFrame({name: each[:count] for name, each in columns.items()})


def _mu(series: Series, answers: Answers, curve: str, *models: str) -> Estimated:
    """Friction of a model where it slides, or over that of another."""
    found = answers.compared(curve, models, ratio_of(MU, *models))
    return found.at(np.array(series.curves[curve].speeds) > 0)


def _along(series: Any, answers: Answers, points: DataFrame, curve: str) -> tuple[DataFrame, DataFrame, DataFrame]:
    """Points of the models of a curve that slides, their ratios to the reference, and lines of theories."""
    own = _known(points[(points["curve"] == curve) & (points["speed"] > 0)])
    judged = own["model"].isin([*series.models.labels])
    bodies = {"rough": curve} | ({"smooth": SMOOTH} if curve == ROUGH else {})
    return own[judged], _ratios(series, answers, bodies), own[~judged].assign(kind=friction_speed.THEORY)


def _ratios(series: Series, answers: Answers, bodies: Mapping[str, str]) -> DataFrame:
    """Friction of every model over that of the reference, on the curve of each body."""
    reference = series.models.reference
    frames = {
        (model.name, body): _at(series, curve, {"ratio": _mu(series, answers, curve, model.name, reference)})
        for body, curve in bodies.items()
        for model in answers.judged(curve, FRICTION)
    }
    return stacked(frames, "model", "body") if frames else DataFrame(columns=["speed"])


def _friction(
    series: Any, answers: Answers, judged: Judged, points: DataFrame, by_speed: str, by_load: str, folder: str
) -> Iterator[Plot | None]:
    """Friction against speed, against load or depth at several speeds, and shifted onto one curve."""
    shifted = collapse.plot(list(_shifted(series, judged)), folder=folder)
    for curve, figure in ((by_speed, friction_speed), (by_load, friction_load)):
        own = series.curves.get(curve)
        if own is None or not any(speed > 0 for speed in own.speeds) or not answers.claiming(curve, FRICTION):
            continue
        found, ratios, theories = _along(series, answers, points, curve)
        names = ["model", "kind", "speed", own.prescribed, MU]
        more = [theories.rename(columns={f"{MU}_mean": MU}), *_lines(series, judged, points, found, curve)]
        lines = concat(
            [each.reindex(columns=names) for each in more if len(each)] or [DataFrame()], ignore_index=True
        )
        several, alone = len(own.values) > 1, found["speed"].nunique() == 1
        if figure is friction_speed and not (several and alone):
            caption = f"Friction against speed; below, over the reference. {LINES}"
            yield friction_speed.plot(found, ratios, lines, caption, folder)
        elif figure is friction_load and several and not (shifted and isinstance(series, RoughSeries)):
            caption = f"Friction against load or depth, a curve for each speed. {LINES}"
            yield friction_load.plot(found, lines, caption, folder)
    yield shifted


def _lines(series: Any, judged: Judged, points: DataFrame, own: DataFrame, curve: str) -> Iterator[DataFrame]:
    """Eq. 19 beside the models, and the smooth body."""
    if isinstance(series, RoughSeries):
        smooth = points[(points["curve"] == SMOOTH) & (points["speed"] > 0)].rename(columns={f"{MU}_mean": MU})
        for model, laws in judged.laws.items():
            yield smooth[smooth["model"] == model].assign(kind=friction_speed.SMOOTH)
            yield _at(series, ROUGH, {MU: laws.law}).assign(model=model, kind=friction_speed.EQ_19)
    elif isinstance(series, Around) and "load" in own and "rms_slope_mean" in own:
        own = own[own["model"] == "MDR"].dropna(subset="rms_slope_mean")
        places = own[["speed", "load"]]
        if curve == SPEED and len(own) > 1:
            speeds = np.geomspace(own["speed"].min(), own["speed"].max(), 101)
            places = DataFrame({"speed": speeds, "load": own["load"].iloc[0]})
        if len(own):
            mu = around.friction_law(series.case, places["load"], places["speed"], own["rms_slope_mean"].iloc[0])
            yield places.assign(model="MDR", kind=friction_speed.EQ_19, **{MU: mu})


def _shifted(series: Any, judged: Judged) -> Iterator[collapse.ShiftedCurves]:
    """Curves of each dimension with their shifts, where it was asked about them."""
    for model, found in judged.collapses.items():
        label = series.models.labels[model]
        own = [each for each in judged.findings if each.dimension == label]
        named = {each.claim.id: each for each in own}
        if eq23.COLLAPSE.id not in named:
            continue
        expected, predicted = nan, None
        if isinstance(series, RoughSeries):
            laws = judged.laws[model]
            predicted = laws.shifts[[series.speeds.index(speed) for speed in found.speeds.tolist()]]
            expected = laws.exponent
        elif isinstance(series, Around):
            expected = around.predicted_exponent(series.case)
        yield collapse.ShiftedCurves(label, found, named, expected, eq23.leading(found, own), predicted)


def _known(points: DataFrame) -> DataFrame:
    """Points of curves without the columns of what is not prescribed, or not computed."""
    columns = [name for name in ("load", "depth", "rms_slope_mean") if name in points]
    return points.drop(columns=[name for name in columns if points[name].isna().all()])


def _forces(
    series: Any, answers: Answers, points: DataFrame, bodies: Mapping[str, str], folder: str
) -> Plot | None:
    """Force against depth, or depth against load, at rest and of a body that is pressed in at each rate."""
    pressed_in = isinstance(series, RoughSeries) and series.pressed_in and bool(series.speeds)
    own = points[points["curve"].isin([*bodies]) & (pressed_in | (points["speed"] == 0))]
    if own.empty:
        return None
    own = _known(own).assign(body=own["curve"].map(bodies)).rename(columns={"speed": "rate"} if pressed_in else {})
    prescribed = series.curves[next(iter(own["curve"]))].prescribed
    name = {"load": "depth_reached", "depth": "normal_force"}[prescribed]
    if isinstance(series, RoughSeries):
        own = own[own["model"].isin([*series.models.labels])]
        load, depth = closed_forms(series)
        known = dict(zip(series.values, depth if prescribed == "load" else load, strict=True))
        own["closed_form"] = own[prescribed].map(known)
        for _, rows in own.groupby(["model", "body"]) if pressed_in else ():
            moved = rows[rows["rate"] > 0]
            reached = moved["depth_reached_mean"].to_numpy().reshape(len(series.speeds), -1)
            own.loc[moved.index, "closed_form"] = loading(series, reached).ravel()
    less = {
        (model.name, body): _apart(series, answers, curve, model.name, name, slice(None if pressed_in else 1))
        for curve, body in bodies.items()
        for model in answers.judged(curve, DEPTH if prescribed == "load" else FORCE)
    }
    differences = stacked(less, "model", "body") if less else DataFrame(columns=["difference"])
    differences = differences[np.isfinite(differences["difference"])].rename(columns={"speed": "rate"})
    what = "Depth under prescribed loads" if prescribed == "load" else "Force at prescribed depths"
    how = "at rest and pressed in at constant rates" if pressed_in else "at rest"
    caption = (
        f"{what}, {how}: rough, and of the smooth body in closed form, or else in 3D; off that; 1D off 3D. Bars: "
        "95 %. Depth is that of the macroscopic tip, below zero where only the highest asperities touch."
    )
    return force_depth.plot(own, differences.drop(columns=[] if pressed_in else "rate"), caption, folder)


def _apart(series: Any, answers: Answers, curve: str, model: str, name: str, rows: slice) -> DataFrame:
    """Force of a model over that of the reference less one, or depth less that of the reference."""
    both = model, series.models.reference

    def apart(sample):
        one, three = (mean(sample[each], name)[rows] for each in both)
        return one - three if name == "depth_reached" else one / three - 1

    return _at(series, curve, {"difference": answers.compared(curve, both, apart)}, moving=False)


def _map(series: Around, tree: xarray.DataTree, folder: str) -> Plot | None:
    """Surfaces and pressure of the scene's own contact."""
    below = tree[series.folder].children.get("fields", xarray.DataTree())
    fields = {
        model: {str(name): each.values for name, each in node.variables.items()}
        for model, node in below.children.items()
    }
    seen = view(series.scene, series.case.bem, fields)
    return contact.plot(series.scene, seen, folder) if seen else None


def _history(answers: Answers, model: str, axis: str) -> DataFrame:
    """Forces and depth of a model over time, or over the displacement."""
    columns = {axis: answers.two_levels(OWN, model)[axis].values}
    for name in history.QUANTITIES:
        found = answers.interval(OWN, model, name).ends
        columns |= {f"{name}{end}": np.ravel(each) for end, each in zip(ENDS, found, strict=True)}
    return DataFrame(columns)


def _smooth_limit(series: Around, answers: Answers, points: DataFrame, folder: str) -> Plot | None:
    """Friction of the smooth body from slow to fast."""
    if points.empty:
        return None
    slope = around.edge_slope(series.case)
    columns = {f"friction_over_slope{end}": points[f"{MU}{end}"] / slope for end in ("_mean", "_low", "_high")}
    table, ratios = (
        each.assign(v_tau_over_a=around.scaled_speed(series.case, each["speed"]))
        for each in (
            points[["model", "speed"]].assign(**columns),
            _ratios(series, answers, {"smooth": SMOOTH_SPEED}),
        )
    )
    slow = around.slow_friction(series.case, series.models)
    limits = DataFrame(slow.items(), columns=["model", "friction_over_slope"])
    return smooth_limit.plot(table, ratios, limits[limits["model"].isin(table["model"])], folder)


def _causes(series: RoughSeries, answers: Answers, model: str, laws: Any) -> DataFrame:
    """Causes of the dependence of slow friction on the load, over the numbers under the least load."""
    here = Here(series, laws, series.models[model])
    load = answers.interval(ROUGH, model, "normal_force").value[1]
    columns = {"normal_force": load, "contact_law": (load / load[0]) ** nominal_exponent(here)}
    for name, (variable, below) in behind(here.model.draws).items():

        def over_the_first(sample, variable=variable, below=below):
            values = mean(sample[model], variable, below)[1]
            return values / values[0]

        found = answers.compared(ROUGH, (model,), over_the_first).ends
        columns |= {f"{name}{end}": each for end, each in zip(ENDS, found, strict=True)}
    return DataFrame(columns).assign(drag_law=1.0, slope_law=1.0)


def _law(members: Sequence[LawPoints], findings: Sequence[Finding], folder: str = "") -> Plot:
    """Master curve in three dimensions."""
    frames = {}
    for each in members:
        measured = tuple(map(each.law.measured, _mu(each.series, each.answers, ROUGH, each.model).ends))
        numbers = {"pressure_ratio": each.law.x, "measured_share": measured}
        numbers |= {"share_of_full_contact": each.law.share, "height_over_depth": each.height}
        found = _at(each.series, ROUGH, numbers)
        frames[(each.series.title,)] = found[each.counted.ravel()]
    points = stacked(frames, "series")
    points["claimed"] = points["height_over_depth"] <= SHALLOW
    x = np.geomspace(points["pressure_ratio"].min(), points["pressure_ratio"].max(), 101)
    shares = np.array([share(x) for each in members for share in each.curves])
    ends = {"share_of_full_contact_low": shares.min(axis=0), "share_of_full_contact_high": shares.max(axis=0)}
    words = {"law3d.collapse": "median", "law3d.collapse-most": "nine in ten"}
    own = {each.claim.id: 100 * each.value for each in findings if np.isfinite(each.value)}
    missed = ", ".join(f"{number(own[name], 2)} % ({word})" for name, word in words.items() if name in own)
    return law.plot(points, DataFrame({"pressure_ratio": x} | ends), missed and f"off by {missed}", folder)


def _reduced(members: Sequence[Member], model: str) -> DataFrame:
    """Friction over that of Eq. 19 against xi of every point of several series."""
    fine, coarse = (reduced(members, model, level) for level in (FINE, COARSE))
    frames = {}
    for k, each in enumerate(members):
        mu, other = (mean_ratio(data.friction_force[k], data.load[k]) for data in (fine, coarse))
        xi = 1 / mean_ratio(fine.load[k]).value
        friction = replace(mu, grid=np.abs(mu.value - other.value))
        over = tuple(end / interpolation(xi) for end in friction.ends)
        force = each.answers.interval(ROUGH, model, "normal_force").value[1:]
        frames[(each.series.title,)] = _at(
            each.series, ROUGH, {"xi": xi, "over_eq_19": over, "normal_force": force}
        )
    return stacked(frames, "series")


def figure_of(dataset: xarray.Dataset) -> Figure:
    """Friction of a sweep against speed, or against load if there is one speed. Raises InvalidInput."""
    if not isinstance(dataset, xarray.Dataset):
        raise InvalidInput(f"dataset = {brief(repr(dataset))}: the Dataset of a sweep is needed")
    points = means(dataset)
    points = points[points["speed"] > 0]
    plot = friction_speed if points["speed"].nunique() > 1 else friction_load
    return finished(plot.plot(points))
