"""Plots of a study: the tables behind each figure, from its answers, laws, shifts and findings."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from pandas import DataFrame, concat

from mdr1d.equations import interpolation

from ...figures import collapse, family, force_depth, friction_load, friction_speed, law, slow_friction
from ...report.page import Plot
from ...solving.parameter_grid import COARSE, FINE
from ...solving.words import number
from ...statistics import eq23
from ...statistics.finding import Finding
from ...statistics.jackknife import friction, mean, mean_ratio
from ...statistics.means import Interval
from .claims_depth import closed_forms, loading
from .claims_friction import WHY, behind, nominal_exponent
from .claims_law import SHALLOW, LawPoints
from .families import families, reduced
from .judgement import JudgedSeries
from .points import force_at, friction_at, interval, interval_columns, place_columns, stacked
from .series import BODIES, ROUGH, SMOOTH, SOLVERS, Contacts


def plots_of_study(series: Sequence[JudgedSeries], together: Sequence[Finding]) -> Iterator[Plot]:
    """Several series against one variable. together : findings on several series"""
    if together and all(set(SOLVERS) <= set(each.contacts.labels) for each in series):
        if found := families(series):
            yield _family(found)
        points = [each for judged in series if judged.laws and (each := _law_points(judged))]
        if len(points) > 1:
            yield _law(points, together)


def plots_of_series(judged: JudgedSeries) -> Iterator[Plot]:
    """Friction, or depth and force, of one dimension against three."""
    if not set(SOLVERS) <= set(judged.contacts.labels):
        return
    folder = f"{judged.series.folder}/"
    if judged.laws:
        points, ratios, lines = _friction(judged)
        shifted = collapse.plot(list(_shifted(judged)), folder=folder)
        caption = (
            f"Friction against speed at the least, a middle and the greatest {judged.series.prescribed}: rough, "
            "the smooth body, Eq. 19 and theories (lines). Below: 1D over 3D. Bars: 95 %."
        )
        drawn = [
            shifted or friction_load.plot(points, lines, folder=folder),
            friction_speed.plot(points, ratios, lines, caption, folder),
            _slow_friction(judged) if any(each.claim.id in WHY.values() for each in judged.findings) else None,
            _law([found], judged.findings, folder) if (found := _law_points(judged)) else None,
        ]
        yield from (each for each in drawn if each)
    yield _force_depth(judged.contacts, folder)


def _shifted(judged: JudgedSeries) -> Iterator[collapse.ShiftedCurves]:
    """Curves of each dimension with their shifts, where it was asked about them."""
    speeds = judged.series.speeds
    for solver, found in judged.collapses.items():
        own = [each for each in judged.findings if each.dimension == judged.contacts.labels[solver]]
        named, laws = {each.claim.id: each for each in own}, judged.laws[solver]
        if eq23.COLLAPSE.id in named:
            predicted = laws.shifts[[speeds.index(speed) for speed in found.speeds.tolist()]]
            yield collapse.ShiftedCurves(
                judged.contacts.labels[solver],
                found,
                named,
                laws.exponent,
                lead=eq23.leading(found, own),
                predicted=predicted,
            )


def _means(name: str, found: Interval) -> dict[str, np.ndarray]:
    return dict(zip((f"{name}_mean", f"{name}_low", f"{name}_high"), map(np.ravel, found), strict=True))


def _by_solver(table: Callable[[str], dict]) -> DataFrame:
    return stacked({(solver,): DataFrame(table(solver)) for solver in SOLVERS}, "solver")


def _friction(judged: JudgedSeries) -> tuple[DataFrame, DataFrame, DataFrame]:
    """Friction of the rough body, in 1D over 3D of both bodies, and lines beside it."""
    contacts, places = judged.contacts, place_columns(judged.series)

    def ratio(sample):
        one, three = (friction(sample[solver])[1:] for solver in SOLVERS)
        return one / three

    ratios = {
        ("MDR", body): DataFrame(places | interval_columns("ratio", interval(ratio, contacts, body, *SOLVERS)))
        for body in BODIES
    }
    lines = {(solver, friction_speed.EQ_19): judged.laws[solver].law for solver in SOLVERS}
    lines |= {(each, friction_speed.SMOOTH): friction_at(contacts, each, SMOOTH).value for each in SOLVERS}
    for name, answers in contacts.theories.items():
        mu = answers["friction_coefficient"].transpose("speed", judged.series.prescribed).values
        lines[name, friction_speed.THEORY] = mu
    return (
        _by_solver(lambda solver: places | _means("friction_coefficient", friction_at(contacts, solver))),
        stacked(ratios, "solver", "body"),
        stacked(
            {key: DataFrame(places | {"friction_coefficient": mu.ravel()}) for key, mu in lines.items()},
            "solver",
            "kind",
        ),
    )


def _slow_friction(judged: JudgedSeries) -> Plot:
    contacts, series = judged.contacts, judged.series

    def of(solver):
        def over_the_first(name, below=None):
            return lambda sample: (values := mean(sample[solver], name, below)[1]) / values[0]

        load, draws = force_at(contacts, solver).value[0], series.models[solver].draws
        power = nominal_exponent(draws, judged.laws[solver].exponent_of_load)
        columns = {
            "normal_force": load,
            "contact_law": (load / load[0]) ** power,
            "drag_law": 1.0,
            "slope_law": 1.0,
        }
        for name, (variable, below) in behind(draws).items():
            columns |= interval_columns(name, interval(over_the_first(variable, below), contacts, ROUGH, solver))
        return columns

    return slow_friction.plot(_by_solver(of), f"{series.folder}/")


def _law_points(judged: JudgedSeries) -> LawPoints | None:
    return LawPoints.of(judged.contacts, judged.laws)


def _law(members: Sequence[LawPoints], findings: Sequence[Finding], folder: str = "") -> Plot:
    """Master curve in three dimensions."""
    frames = []
    for each in members:
        place, series = each.law, each.contacts.series
        measured = Interval(*map(place.measured, friction_at(each.contacts, each.solver)))
        columns = {"series": series.title} | place_columns(series) | {"pressure_ratio": place.x.ravel()}
        columns |= interval_columns("measured_share", measured)
        columns |= {"share_of_full_contact": place.share.ravel(), "height_over_depth": each.height.ravel()}
        frames.append(DataFrame(columns)[each.counted.ravel()])
    points = concat(frames, ignore_index=True)
    points["claimed"] = points["height_over_depth"] <= SHALLOW
    x = np.geomspace(points["pressure_ratio"].min(), points["pressure_ratio"].max(), 101)
    shares = np.array([share(x) for each in members for share in each.curves])
    ends = {"share_of_full_contact_low": shares.min(axis=0), "share_of_full_contact_high": shares.max(axis=0)}
    told = {"law3d.collapse": "median", "law3d.collapse-most": "nine in ten"}
    own = {each.claim.id: 100 * each.value for each in findings if np.isfinite(each.value)}
    missed = ", ".join(f"{number(own[name], 2)} % ({word})" for name, word in told.items() if name in own)
    return law.plot(points, DataFrame({"pressure_ratio": x} | ends), missed and f"off by {missed}", folder)


def _force_depth(contacts: Contacts, folder: str) -> Plot:
    """Depth or force at rest, and of a body that is pressed in at each rate."""
    series = contacts.series
    load, depth = closed_forms(series)
    at_load, places = series.prescribed == "load", {series.prescribed: series.values}
    name, known = ("depth_reached", depth) if at_load else ("normal_force", load)
    pressed = bool(series.pressed_in and series.speeds)

    def apart(rows):
        def difference(sample):
            one, three = (mean(sample[solver], name)[rows] for solver in SOLVERS)
            return one - three if at_load else one / three - 1

        return difference

    def measured(solver, body):
        found = interval(lambda sample: mean(sample[solver], name)[0], contacts, body, solver)
        parts = [DataFrame({"rate": 0.0} | places | {"closed_form": known} | _means(name, found))]
        if pressed:  # a march answers for the middle of its last step
            reached = mean(contacts.sample(FINE, body, solver)[solver], "depth_reached")[1:]
            columns = place_columns(series, "rate") | {"closed_form": loading(series, reached).ravel()}
            parts.append(DataFrame(columns | _means(name, force_at(contacts, solver, body))))
        return concat(parts, ignore_index=True)

    def differences(body):
        found = interval(apart(0), contacts, body, *SOLVERS)
        parts = [DataFrame({"rate": 0.0} | places | interval_columns("difference", found))]
        if pressed:
            found = interval(apart(slice(1, None)), contacts, body, *SOLVERS)
            parts.append(DataFrame(place_columns(series, "rate") | interval_columns("difference", found)))
        return concat(parts, ignore_index=True)

    points = stacked(
        {(solver, body): measured(solver, body) for solver in SOLVERS for body in BODIES}, "solver", "body"
    )
    less = stacked({("MDR", body): differences(body) for body in BODIES}, "solver", "body")
    if not pressed:
        points, less = points.drop(columns="rate"), less.drop(columns="rate")
    what = "Depth under prescribed loads" if at_load else "Force at prescribed depths"
    how = "at rest and pressed in at constant rates" if pressed else "at rest"
    caption = (
        f"{what}, {how}: rough, and of the smooth body in closed form; off that; 1D off 3D. Bars: 95 %. Depth is "
        "that of the macroscopic tip, below zero where only the highest asperities touch."
    )
    plot = force_depth.plot(points, less, caption, folder)
    assert plot is not None
    return plot


def _family(found) -> Plot:
    frames = {(solver, shape): _reduced(members, solver) for shape, members in found.items() for solver in SOLVERS}
    return family.plot(stacked(frames, "solver", "shape"))


def _reduced(members, solver) -> DataFrame:
    """Friction over that of Eq. 19 against xi of every point of several series."""
    fine, coarse = (reduced(members, solver, grid) for grid in (FINE, COARSE))
    frames = []
    for k, each in enumerate(members):
        mu, other = (mean_ratio(data.friction_force[k], data.load[k]) for data in (fine, coarse))
        xi = 1 / mean_ratio(fine.load[k]).value
        found = Interval.of(mu, np.abs(mu.value - other.value))
        columns = interval_columns("over_eq_19", Interval(*(end / interpolation(xi) for end in found)))
        pressed = place_columns(each.series) | {"normal_force": force_at(each.contacts, solver).value.ravel()}
        frame = DataFrame({"series": each.series.title, "xi": xi, **columns})
        frames.append(frame[: len(pressed["speed"])].assign(**pressed))
    return concat(frames, ignore_index=True)
