"""Figures of a comparison, as tables: every point, ratios to the reference, and lines of theories."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import nan
from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure
from pandas import DataFrame, concat

from scene import Refused, SelfAffine, SolveError
from scene.files.reading import InvalidInput
from scene.printable import brief

from ...figures import collapse, contact, force_depth, friction, history, law
from ...figures.plot import Plot, finished
from ...models.law.bands import Bands
from ...models.law.extended import coarsest_wave, slope, without
from ...models.table import DEPTH, FORCE, FRICTION
from ...solving.curve import Curve
from ...solving.words import number
from ...statistics import eq23
from ...statistics.finding import Finding
from ...statistics.jackknife import mean
from ...statistics.multilevel import MEANS
from .answers import LAW, Answers
from .around import EXACT, MU, OWN, SMOOTH_SPEED, Around
from .claims_law import SHALLOW, LawPoints
from .laws import laws
from .measures import ROUGH, SMOOTH, closed_forms, loading
from .rough import RoughSeries
from .series import Judged, Series
from .sweep import means

CUTS = 12  # shortest waves that the law is asked for, each in some 0.1 s
BEYOND = 10  # times as fine as the scene's own, in a spectrum that goes on
LINES = "Lines: Eq. 19 and theories, not judged. Bars: 95 %."


def of_series(judged: Judged, tree: xarray.DataTree) -> Iterator[Plot]:
    """Figures of a series."""
    series, answers = judged.series, judged.answers
    points = answers.points
    folder = f"{series.folder}/" if series.folder else ""
    drawn: list[Plot | None] = []
    if isinstance(series, Around):
        drawn.append(_map(series, tree, folder))
        if series.history:
            own = points[(points["curve"] == OWN) & points["model"].isin([*series.models.labels])]
            own = own.rename(columns=lambda name: name.removesuffix("_mean"))
            drawn.append(history.plot(own, series.curves[OWN].axis, series.scene, folder))
        drawn.append(_waves(series, points, folder))
    drawn += _friction(judged, folder)
    if isinstance(series, RoughSeries) and (found := LawPoints.of(series, answers)):
        drawn.append(_law(found, judged.findings, folder))
    drawn.append(_forces(series, answers, points, folder))
    yield from (each for each in drawn if each is not None)


def _stacked(frames: Mapping[Any, DataFrame], *names: str) -> DataFrame:
    """Tables one below the other, with the words that name each in its first columns."""
    found = concat(frames, names=names) if frames else DataFrame(columns=["speed"])
    return found.reset_index(level=list(range(len(names)) if frames else ())).reset_index(drop=True)


def _at(curve: Curve, columns: Mapping[str, Any]) -> DataFrame:
    """Speed, load or depth, and numbers on a curve; those of the first points, which rest, may be absent."""
    table = DataFrame({name: np.ravel(each) for name, each in columns.items()})
    places = DataFrame(curve.points, columns=["speed", curve.prescribed]).tail(len(table))
    return places.reset_index(drop=True).join(table)


def _beside(
    series: Series,
    answers: Answers,
    bodies: Mapping[str, str],
    quantity: str,
    measure: Callable[..., Any],
    name: str = "ratio",
) -> DataFrame:
    """A number of each model and the reference at every point, by the curve of each body."""
    frames = {}
    for curve, body in bodies.items():
        for model in answers.judged(curve, quantity):
            both = model.name, series.models.reference
            found = answers.compared(curve, both, lambda sample, both=both: measure(*map(sample.get, both)))
            frames[model.name, body] = _at(series.curves[curve], found.columns(name))
    return _stacked(frames, "model", "body")


def _ratios(series: Series, answers: Answers, bodies: Mapping[str, str]) -> DataFrame:
    """Ratio of friction of every model to friction of the reference where it slides, by the curve of each body."""
    measure = lambda one, three: mean(one, *MEANS[MU]) / mean(three, *MEANS[MU])  # noqa: E731
    found = _beside(series, answers, bodies, FRICTION, measure)
    return found[found["speed"] > 0]


def _along(series: Series, answers: Answers, curve: str) -> tuple[DataFrame, DataFrame, DataFrame]:
    """Points of the models of a curve that slides, their ratios to the reference, and the lines of theories."""
    moving = answers.points[answers.points["speed"] > 0]
    judged = moving["model"].isin([*series.models.labels])
    own, smooth = _known(moving[moving["curve"] == curve]), moving[judged & (moving["curve"] == SMOOTH)]
    bodies = {curve: "rough"} | ({SMOOTH: "smooth"} if curve == ROUGH else {})
    ruled = {model: laws(series.curves[curve], answers(curve, model)) for model in own["model"].unique()}
    lines = [
        own[~judged[own.index]].assign(kind=friction.THEORY),
        smooth.assign(kind=friction.SMOOTH),
        *(
            _at(series.curves[curve], {f"{MU}_mean": each.law}).assign(model=model, kind=friction.EQ_19)
            for model, each in ruled.items()
            if each
        ),
    ]
    names = ["model", "kind", "speed", series.curves[curve].prescribed, f"{MU}_mean"]
    every = concat([each[names] for each in lines if len(each)] or [DataFrame(columns=names)], ignore_index=True)
    return own[judged[own.index]], _ratios(series, answers, bodies), every.rename(columns={f"{MU}_mean": MU})


def _friction(judged: Judged, folder: str) -> Iterator[Plot | None]:
    """Friction against speed, against load or depth at several speeds, and shifted onto one curve."""
    series, answers = judged.series, judged.answers
    shifted = collapse.plot(list(_shifted(judged)), folder=folder)
    for curve, name in ((series.by_speed, friction.SPEED), (series.by_load or series.by_speed, friction.LOAD)):
        if not (answers.claiming(curve, FRICTION) and max(series.curves[curve].speeds) > 0):
            continue
        found, ratios, lines = _along(series, answers, curve)
        several, alone = len(series.curves[curve].values) > 1, found["speed"].nunique() == 1
        shown = several and not (shifted and isinstance(series, RoughSeries))
        if shown if name == friction.LOAD else not alone:
            across = "speed" if name == friction.SPEED else "load or depth"
            caption = f"Friction against {across}; below, over the reference. {LINES}"
            yield friction.plot(found, ratios, lines, caption, folder, name)
    yield shifted
    if isinstance(series, Around) and SMOOTH_SPEED in series.curves:
        caption = (
            "Friction of the smooth body from slow to fast; below, over the reference: 2 for a slow sphere in 1D "
            "over 3D. Bars: change on halving the grid."
        )
        yield friction.plot(*_along(series, answers, SMOOTH_SPEED), caption, folder, friction.SMOOTH_SPEED)


def _shifted(judged: Judged) -> Iterator[collapse.ShiftedCurves]:
    """Curves of each dimension with their shifts."""
    for model, found in judged.collapses.items():
        label, ruled = judged.series.models.labels[model], judged.laws.get(model)
        own = [each for each in judged.findings if each.dimension == label]
        named, expected, predicted = {each.claim.id: each for each in own}, nan, None
        if ruled:
            expected, predicted = ruled.exponent, ruled.shifts[np.isin(ruled.speeds, found.speeds)]
        yield collapse.ShiftedCurves(label, found, named, expected, eq23.leading(found, own), predicted)


def _known(points: DataFrame) -> DataFrame:
    """Points of curves without the columns of what is not prescribed."""
    return points.drop(
        columns=[name for name in ("load", "depth") if name in points and points[name].isna().all()]
    )


def _forces(series: Series, answers: Answers, points: DataFrame, folder: str) -> Plot | None:
    """Force against depth, or depth against load, at rest and of a body that is pressed in at each rate."""
    bodies = {curve: body for curve, body in series.bodies.items() if curve in series.curves}
    pressed_in = isinstance(series, RoughSeries) and series.pressed_in and bool(series.speeds)
    own = points[points["curve"].isin([*bodies]) & (pressed_in | (points["speed"] == 0))]
    own = own[own["model"].isin([*series.models.labels, EXACT])]
    if own.empty:
        return None
    own = _known(own).assign(body=own["curve"].map(bodies)).rename(columns={"speed": "rate"} if pressed_in else {})
    curve = series.curves[own["curve"].iloc[0]]
    if isinstance(series, RoughSeries):
        load, depth = closed_forms(curve)
        known = depth if curve.prescribed == "load" else load
        own["closed_form"] = own[curve.prescribed].map(dict(zip(curve.values, known, strict=True)))
        for _, rows in own.groupby(["model", "body"]) if pressed_in else ():
            moved = rows[rows["rate"] > 0]
            reached = moved["depth_reached_mean"].to_numpy().reshape(len(series.speeds), -1)
            own.loc[moved.index, "closed_form"] = loading(series.scene, series.speeds, reached).ravel()

    def apart(one, three):
        if curve.prescribed == "load":
            return mean(one, "depth_reached") - mean(three, "depth_reached")
        return mean(one, "normal_force") / mean(three, "normal_force") - 1

    quantity, what = (
        (DEPTH, "Depth under prescribed loads")
        if curve.prescribed == "load"
        else (FORCE, "Force at prescribed depths")
    )
    differences = _beside(series, answers, bodies, quantity, apart, "difference")
    differences = differences[pressed_in | (differences["speed"] == 0)].rename(columns={"speed": "rate"})
    how = "at rest and pressed in at constant rates" if pressed_in else "at rest"
    caption = (
        f"{what}, {how}: rough, and of the smooth body in closed form, or else in 3D; off that; 1D off 3D. Bars: "
        "95 %. Depth is the depth of the macroscopic tip, below zero where only the highest asperities touch."
    )
    differences = differences.drop(columns=[] if pressed_in else "rate")
    if "difference" in differences:
        differences = differences[np.isfinite(differences["difference"])]
    return force_depth.plot(own, differences, caption, folder)


def _map(series: Around, tree: xarray.DataTree, folder: str) -> Plot | None:
    """Surfaces and pressure of the scene's own contact."""
    below = tree[series.folder].children.get("fields", xarray.DataTree())
    fields = {
        model: {str(name): each.values for name, each in node.variables.items()}
        for model, node in below.children.items()
    }
    seen = contact.view(series.scene, series.case.bem, fields)
    return contact.plot(series.scene, seen, folder) if seen else None


def _law(found: LawPoints, findings: Sequence[Finding], folder: str) -> Plot:
    """Master curve in three dimensions."""
    mu = found.answers.interval(ROUGH, found.model, *MEANS[MU]).at(slice(1, None))
    numbers = {name: found.law.measured(each) for name, each in mu.columns("measured_share").items()}
    numbers |= {"pressure_ratio": found.law.x, "share_of_full_contact": found.law.share}
    numbers |= {"height_over_depth": found.height}
    points = _at(found.series.curves[ROUGH], numbers)[found.counted.ravel()]
    points["claimed"] = points["height_over_depth"] <= SHALLOW
    x = np.geomspace(points["pressure_ratio"].min(), points["pressure_ratio"].max(), 101)
    shares = np.array([share(x) for share in found.curves])
    ends = {"share_of_full_contact_low": shares.min(axis=0), "share_of_full_contact_high": shares.max(axis=0)}
    words = {"law3d.collapse": "median", "law3d.collapse-most": "nine in ten"}
    own = {each.claim.id: 100 * each.value for each in findings if np.isfinite(each.value)}
    missed = ", ".join(f"{number(own[name], 2)} % ({word})" for name, word in words.items() if name in own)
    return law.plot(points, DataFrame({"pressure_ratio": x} | ends), missed and f"off by {missed}", folder)


def _waves(series: Around, points: DataFrame, folder: str) -> Plot | None:
    """Friction against the shortest wave that is kept, by the law; None where it has no answer."""
    rough: Any = series.scene.roughness
    try:
        if not rough or MU not in series.own_means or LAW.refusals(series.scene):
            return None
        finest = rough.shortest / (BEYOND if isinstance(rough, SelfAffine) else 1)
        waves = np.geomspace(finest, coarsest_wave(rough), CUTS)
        kept = [without(series.scene, each) for each in waves]
        found = [LAW.solve(each) for each in kept]
    except (Refused, SolveError, ArithmeticError):  # a map may be directed without its finest waves
        return None
    curve = (
        DataFrame([each.measures for each in found])
        .filter(like="friction_")
        .assign(
            friction=[each.friction_coefficient for each in found],
            rms_slope=[slope(Bands.of(each.roughness)) for each in kept],  # type: ignore[arg-type]
            shortest=waves,
        )
    )
    return law.waves_plot(curve, points[points["curve"] == OWN].assign(shortest=rough.shortest), folder)


def figure_of(dataset: xarray.Dataset) -> Figure:
    """Friction of a sweep against speed, or against load if there is one speed. Raises InvalidInput."""
    if not isinstance(dataset, xarray.Dataset):
        raise InvalidInput(f"dataset = {brief(repr(dataset))}: the Dataset of a sweep is needed")
    points = means(dataset)
    points = points[points["speed"] > 0]
    name = friction.SPEED if points["speed"].nunique() > 1 else friction.LOAD
    if (plot := friction.plot(points, name=name)) is None:
        raise InvalidInput("dataset: nothing slides, so that there is no friction to draw")
    return finished(plot)
