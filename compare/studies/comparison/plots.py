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
from scene.printable import brief
from scene.reading import InvalidInput

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
from ...models.table import FORCE, FRICTION
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
from .rough import BODIES, ROUGH, SMOOTH, RoughSeries
from .series import Judged, Series, ratio_of
from .sweep import CONTACTS, SweepSeries, means
from .together import Member, families, reduced

ENDS = "", "_low", "_high"
MEANS = "_mean", "_low", "_high"
LINES = "Lines: Eq. 19 and theories, not judged. Bars: 95 %."


def of_series(series: Series, answers: Answers, judged: Judged, points: DataFrame, tree) -> Iterator[Plot]:
    """Figures of one series."""
    drawn: list[Plot | None]
    if isinstance(series, RoughSeries):
        drawn = [*_friction(series, answers, judged, points), *_rough(series, answers, judged)]
    elif isinstance(series, Around):
        drawn = [_maps(series, tree), *_around(series, answers, judged, points)]
    elif isinstance(series, SweepSeries):
        drawn = list(_friction(series, answers, judged, points))
    yield from (each for each in drawn if each is not None)


def of_several(series: Sequence[Series], members: Sequence[Member], every: Mapping[str, tuple[Answers, DataFrame]],
               findings: Sequence[Finding]) -> Iterator[Plot]:  # fmt: skip
    """Figures of several series together."""
    scenes = [each for each in series if isinstance(each, Around) and SPEED in each.curves]
    if len(scenes) > 1:
        parts = [(each, *_along(each, *every[each.name], SPEED)[:2]) for each in scenes]
        points, ratios = (
            concat([row[k].assign(case=row[0].name) for row in parts], ignore_index=True) for k in (1, 2)
        )
        caption = "Friction of all scenes against speed, each at its own load or depth; below, ratios. Bars: 95 %."
        if (plot := friction_speed.plot(points, ratios, caption=caption)) is not None:
            yield plot
    if found := families(members):
        frames = {
            (model, shape): _reduced(own, model)
            for shape, own in found.items()
            for model in own[0].series.models.labels
        }
        yield family.plot(_stacked(frames, "model", "shape"))
    laws = [own for each in members if (own := LawPoints.of(each.series, each.answers, each.laws))]
    if len(laws) > 1:
        yield _law(laws, findings)


def _stacked(frames: Mapping[Any, DataFrame], *names: str) -> DataFrame:
    """Tables one below the other, with the words that name each in its first columns."""
    return concat(frames, names=names).reset_index(level=list(range(len(names)))).reset_index(drop=True)


def _named(name: str, found: Any, endings: Sequence[str] = ENDS) -> dict[str, np.ndarray]:
    """Columns of numbers and both ends of their intervals."""
    return {f"{name}{end}": np.ravel(each) for end, each in zip(endings, found, strict=True)}


def _places(series, curve: str, speed: str = "speed") -> dict[str, np.ndarray]:
    """Speed, and load or depth, of each point of a curve that moves."""
    own = series.curves[curve]
    speeds, values = np.meshgrid([each for each in own.speeds if each > 0], own.values, indexing="ij")
    return {speed: speeds.ravel(), own.prescribed: values.ravel()}


# Friction.


def _along(series, answers: Answers, points: DataFrame, curve: str) -> tuple[DataFrame, DataFrame, DataFrame]:
    """Points of the models of a curve that slides, their ratios to the reference, and lines of theories."""
    own = points[(points["curve"] == curve) & (points["speed"] > 0)].dropna(axis=1, how="all")
    beside = ~own["model"].isin([*series.models.labels])
    bodies = {"rough": curve} | ({"smooth": SMOOTH} if curve == ROUGH else {})
    ratios = {
        (model.name, body): DataFrame(
            _places(series, each) | _named("ratio", _ratio(series, answers, each, model.name).ends)
        )
        for body, each in bodies.items()
        for model in answers.judged(each, FRICTION)
    }
    lines = own[beside].rename(columns={"friction_coefficient_mean": "friction_coefficient"})
    found = _stacked(ratios, "model", "body") if ratios else DataFrame()
    return own[~beside], found, lines.assign(kind=friction_speed.THEORY)


def _ratio(series, answers, curve, model) -> Estimated:
    """Friction of a model over that of the reference where it slides."""
    both = model, series.models.reference
    found = answers.compared(curve, both, ratio_of("friction_coefficient", *both))
    return found.at(np.array(series.curves[curve].speeds) > 0)


def _friction(series: Any, answers: Answers, judged: Judged, points: DataFrame) -> Iterator[Plot | None]:
    """Friction against speed, against load or depth at several speeds, and shifted onto one curve."""
    by_speed, by_load = SPEED, LOAD
    if not isinstance(series, Around):
        by_speed = by_load = ROUGH if isinstance(series, RoughSeries) else CONTACTS
    folder = f"{series.folder}/" if series.folder else ""
    shifted = list(_shifted(series, judged))
    for curve, figure in ((by_speed, friction_speed), (by_load, friction_load)):
        if not any(speed > 0 for speed in getattr(series.curves.get(curve), "speeds", ())):
            continue
        found, ratios, lines = _along(series, answers, points, curve)
        if found.empty or not answers.claiming(curve, FRICTION):
            continue
        more = [lines, *_lines(series, answers, judged, found, curve)]
        names = ["model", "kind", *_places(series, curve), "friction_coefficient"]
        frames = [each[names] for each in more if len(each)]
        beside = concat(frames, ignore_index=True) if frames else None
        several = len(series.curves[curve].values) > 1, sum(speed > 0 for speed in series.curves[curve].speeds) > 1
        if figure is friction_speed and (several[1] or not several[0]):
            caption = f"Friction against speed; below, over the reference. {LINES}"
            yield friction_speed.plot(found, ratios, beside, caption, folder)
        elif figure is friction_load and several[0] and not (shifted and isinstance(series, RoughSeries)):
            caption = (
                "Friction against load or depth, a curve for each speed. Lines: Eq. 19 and theories. Bars: 95 %."
            )
            yield friction_load.plot(found, beside, caption, folder)
    yield collapse.plot(shifted, folder=folder)


def _lines(series: Any, answers: Answers, judged: Judged, points: DataFrame, curve: str) -> Iterator[DataFrame]:
    """Eq. 19 beside the models, and the smooth body."""
    if isinstance(series, RoughSeries):
        for model, laws in judged.laws.items():
            mu = {friction_speed.EQ_19: laws.law, friction_speed.SMOOTH: _mu(answers, SMOOTH, model).value}
            for kind, each in mu.items():
                yield DataFrame(_places(series, ROUGH) | {"friction_coefficient": each.ravel()}).assign(
                    model=model, kind=kind
                )
    elif isinstance(series, Around) and "load" in points and "rms_slope_mean" in points:
        own = points[points["model"] == "MDR"]
        places = own[["speed", "load"]]
        if curve == SPEED and own["speed"].nunique() > 1:
            speeds = np.geomspace(own["speed"].min(), own["speed"].max(), 101)
            places = DataFrame({"speed": speeds, "load": own["load"].iloc[0]})
        if len(own) and np.isfinite(own["rms_slope_mean"].iloc[0]):
            mu = around.friction_law(series.case, places["load"], places["speed"], own["rms_slope_mean"].iloc[0])
            yield places.assign(model="MDR", kind=friction_speed.EQ_19, friction_coefficient=mu)


def _mu(answers: Answers, curve: str, model: str) -> Estimated:
    """Friction of a model where it slides."""
    return answers.compared(curve, (model,), ratio_of("friction_coefficient", model)).at(slice(1, None))


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
        lead = eq23.leading(found, own)
        yield collapse.ShiftedCurves(label, found, named, expected, lead=lead, predicted=predicted)


# A scene as it stands.


def _maps(series: Around, tree: xarray.DataTree) -> Plot | None:
    """Surfaces and pressure of the scene's own contact."""
    below = tree[series.folder].children.get("fields", xarray.DataTree())
    fields = {
        model: {str(name): each.values for name, each in node.variables.items()}
        for model, node in below.children.items()
    }
    seen = view(series.scene, series.case.bem, fields)
    return contact.plot(series.scene, seen, folder=f"{series.folder}/") if seen else None


def _around(series: Around, answers: Answers, judged: Judged, points: DataFrame) -> Iterator[Plot | None]:
    folder, axis = f"{series.folder}/", series.curves[OWN].axis
    if axis in ("time", "displacement", "force"):
        yield history.plot(_history(series, answers, axis), axis, folder)
        return
    rest = points[points["curve"].isin((ROUGH_DEPTH, SMOOTH_DEPTH))].dropna(axis=1, how="all")
    bodies = {ROUGH_DEPTH: "rough", SMOOTH_DEPTH: "smooth"}
    yield force_depth.plot(
        rest.assign(body=rest["curve"].map(bodies)), _differences(series, answers, bodies), folder=folder
    )
    yield from _friction(series, answers, judged, points)
    if SMOOTH_SPEED in series.curves:
        yield _smooth_limit(series, answers, points[points["curve"] == SMOOTH_SPEED], folder)


def _differences(series, answers, bodies) -> DataFrame:
    """Force of each model over that of the reference less one, at every depth at which that one touches."""
    rows = []
    for curve, body in bodies.items():
        for model in answers.judged(curve, FORCE) if curve in series.curves else ():
            both = model.name, series.models.reference
            found = answers.compared(curve, both, ratio_of("normal_force", *both)).ends
            for at, depth in series.touched(answers, curve, both[1]):
                numbers = (float(each[at]) - 1 for each in found)
                rows.append({"model": model.name, "body": body, "depth": depth} | _row("difference", numbers))
    return DataFrame(rows)


def _row(name, numbers):
    return dict(zip((f"{name}{end}" for end in ENDS), numbers, strict=True))


def _history(series, answers, axis) -> DataFrame:
    """Forces and depth of every model over time, or over the displacement."""
    frames = {}
    for model in series.models:
        if answers.has(OWN, model.name):
            columns = {axis: answers.two_levels(OWN, model.name)[axis].values}
            for name in ("normal_force", "depth_reached", "friction_force"):
                columns |= _named(name, answers.interval(OWN, model.name, name).ends, MEANS)
            frames[(model.name,)] = DataFrame(columns)
    return _stacked(frames, "model")


def _smooth_limit(series: Around, answers: Answers, points: DataFrame, folder: str) -> Plot | None:
    """Friction of the smooth body from slow to fast."""
    scaled = {speed: around.scaled_speed(series.case, speed) for speed in points["speed"]}
    slope = around.edge_slope(series.case)
    columns = {f"friction_over_slope{end}": points[f"friction_coefficient{end}"] / slope for end in MEANS}
    table = points[["model", "speed"]].assign(v_tau_over_a=points["speed"].map(scaled), **columns)
    ratios = {
        (model.name,): DataFrame(
            {"v_tau_over_a": [*map(scaled.get, series.curves[SMOOTH_SPEED].speeds)]}
            | _named("ratio", _ratio(series, answers, SMOOTH_SPEED, model.name).ends)
        )
        for model in answers.judged(SMOOTH_SPEED, FRICTION)
    }
    slow = around.slow_friction(series.case, series.models)
    limits = DataFrame(slow.items(), columns=["model", "friction_over_slope"])
    limits = limits[limits["model"].isin(table["model"])]
    return smooth_limit.plot(table, _stacked(ratios, "model") if ratios else DataFrame(), limits, folder)


# A rough series.


def _rough(series: RoughSeries, answers: Answers, judged: Judged) -> Iterator[Plot | None]:
    folder, laws = f"{series.folder}/", judged.laws
    if any(each.claim.id == "eq17.contact" for each in judged.findings):
        yield slow_friction.plot(_causes(series, answers, laws), folder)
    if laws and (found := LawPoints.of(series, answers, laws)):
        yield _law([found], judged.findings, folder)
    yield _depth(series, answers, folder)


def _causes(series, answers, laws) -> DataFrame:
    """What makes slow friction depend on the load, over the numbers under the least load."""
    frames = {}
    for model, own in laws.items():
        here = Here(series, own, series.models[model])
        load = answers.interval(ROUGH, model, "normal_force").value[1]
        columns = {"normal_force": load, "contact_law": (load / load[0]) ** nominal_exponent(here)}
        columns |= {"drag_law": 1.0, "slope_law": 1.0}
        for name, (variable, below) in behind(here.model.draws).items():

            def over_the_first(sample, variable=variable, below=below, model=model):
                values = mean(sample[model], variable, below)[1]
                return values / values[0]

            columns |= _named(name, answers.compared(ROUGH, (model,), over_the_first).ends)
        frames[(model,)] = DataFrame(columns)
    return _stacked(frames, "model")


def _law(members: Sequence[LawPoints], findings: Sequence[Finding], folder: str = "") -> Plot:
    """Master curve in three dimensions."""
    frames = []
    for each in members:
        measured = map(each.law.measured, _mu(each.answers, ROUGH, each.model).ends)
        columns = {"series": each.series.title} | _places(each.series, ROUGH)
        columns |= {"pressure_ratio": each.law.x.ravel()} | _named("measured_share", measured)
        columns |= {"share_of_full_contact": each.law.share.ravel(), "height_over_depth": each.height.ravel()}
        frames.append(DataFrame(columns)[each.counted.ravel()])
    points = concat(frames, ignore_index=True)
    points["claimed"] = points["height_over_depth"] <= SHALLOW
    x = np.geomspace(points["pressure_ratio"].min(), points["pressure_ratio"].max(), 101)
    shares = np.array([share(x) for each in members for share in each.curves])
    ends = {"share_of_full_contact_low": shares.min(axis=0), "share_of_full_contact_high": shares.max(axis=0)}
    words = {"law3d.collapse": "median", "law3d.collapse-most": "nine in ten"}
    own = {each.claim.id: 100 * each.value for each in findings if np.isfinite(each.value)}
    missed = ", ".join(f"{number(own[name], 2)} % ({word})" for name, word in words.items() if name in own)
    return law.plot(points, DataFrame({"pressure_ratio": x} | ends), missed and f"off by {missed}", folder)


def _depth(series: RoughSeries, answers: Answers, folder: str) -> Plot | None:
    """Depth or force at rest, and of a body that is pressed in at each rate."""
    load, depth = closed_forms(series)
    at_load = series.prescribed == "load"
    name, known = ("depth_reached", depth) if at_load else ("normal_force", load)
    models, reference = series.models.labels, series.models.reference
    rows = slice(None) if series.pressed_in and series.speeds else slice(1)
    points, less = {}, {}
    own = series.curves[ROUGH]
    places = [each.ravel() for each in np.meshgrid(own.speeds, own.values, indexing="ij")]
    where = DataFrame({"rate": places[0], series.prescribed: places[1]})
    for body in BODIES:
        for model in models:
            found = answers.interval(body, model, name).at(rows).ends
            reached = mean(answers(body, model), "depth_reached")[1:]
            closed = np.vstack([known, loading(series, reached)]) if rows == slice(None) else known
            count = np.size(found[0])
            points[model, body] = where[:count].assign(closed_form=np.ravel(closed), **_named(name, found, MEANS))
            if model != reference:

                def apart(sample, model=model):
                    one, three = (mean(sample[each], name)[rows] for each in (model, reference))
                    return one - three if at_load else one / three - 1

                difference = answers.compared(body, (model, reference), apart).ends
                less[model, body] = where[:count].assign(**_named("difference", difference))
    moving = [] if rows == slice(None) else ["rate"]
    what = "Depth under prescribed loads" if at_load else "Force at prescribed depths"
    how = "at rest" if moving else "at rest and pressed in at constant rates"
    caption = (
        f"{what}, {how}: rough, and of the smooth body in closed form; off that; 1D off 3D. Bars: 95 %. Depth is "
        "that of the macroscopic tip, below zero where only the highest asperities touch."
    )
    both = [_stacked(each, "model", "body").drop(columns=moving) for each in (points, less)]
    return force_depth.plot(both[0], both[1], caption, folder)


def _reduced(members: Sequence[Member], model: str) -> DataFrame:
    """Friction over that of Eq. 19 against xi of every point of several series."""
    fine, coarse = (reduced(members, model, level) for level in (FINE, COARSE))
    frames = []
    for k, each in enumerate(members):
        mu, other = (mean_ratio(data.friction_force[k], data.load[k]) for data in (fine, coarse))
        xi = 1 / mean_ratio(fine.load[k]).value
        found = replace(mu, grid=np.abs(mu.value - other.value))
        columns = _named("over_eq_19", [end / interpolation(xi) for end in found.ends])
        places = _places(each.series, ROUGH)
        places["normal_force"] = each.answers.interval(ROUGH, model, "normal_force").value[1:].ravel()
        frame = DataFrame({"series": each.series.title, "xi": xi, **columns})
        frames.append(frame[: len(places["speed"])].assign(**places))
    return concat(frames, ignore_index=True)


def figure_of(dataset: xarray.Dataset) -> Figure:
    """Friction of a sweep against speed, or against load if there is one speed. Raises InvalidInput."""
    if not isinstance(dataset, xarray.Dataset):
        raise InvalidInput(f"dataset = {brief(repr(dataset))}: the Dataset of a sweep is needed")
    points = means(dataset)
    points = points[points["speed"] > 0]
    plot = friction_speed if points["speed"].nunique() > 1 else friction_load
    return finished(plot.plot(points))
