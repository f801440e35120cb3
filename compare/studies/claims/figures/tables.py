"""Plots of a study: the tables behind each figure, from its answers, laws, shifts and findings."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import product

import numpy as np
from pandas import DataFrame, concat

from mdr1d.equations import interpolation

from ....report.page import Plot
from ....solving.parameter_grid import COARSE, FINE
from ....statistics.collapse import ENDS
from ....statistics.finding import Finding
from ....statistics.jackknife import friction, mean, mean_ratio
from ....statistics.means import Interval
from ...mastercurve import figures as shift_plots
from ..claims_depth import closed_forms, loading
from ..claims_friction import WHY, behind, nominal_exponent
from ..claims_law import LawPoints
from ..families import families, reduced
from ..judgement import JudgedSeries
from ..points import each_dimension, force_at, friction_at, interval, interval_columns, place_columns, stacked
from ..series import BODIES, ROUGH, SMOOTH, SOLVERS, Contacts, resting
from . import depth as study_depth
from . import friction as study_friction
from . import law as study_law


def plots_of_study(series: Sequence[JudgedSeries], together: Sequence[Finding]) -> Iterator[Plot]:
    """Several series against one variable.

    together : findings on several series
    """
    found = families(series)
    if found and together and all(set(SOLVERS) <= set(each.contacts.labels) for each in series):
        yield _family(found)
    if together and all(set(SOLVERS) <= set(each.contacts.labels) for each in series):
        yield from _law_of_all(series, together)


def plots_of_series(judged: JudgedSeries) -> Iterator[Plot]:
    """Friction, or depth and force."""
    series = judged.series
    # The figures of a series show one dimension against three.
    if not set(SOLVERS) <= set(judged.contacts.labels):
        return
    if judged.laws:
        yield (collapsed := shift_plots.collapse(judged))
        if shifted := shift_plots.shifts(judged):
            yield shifted
        yield from _law(judged, collapsed)
        yield _levels(judged)
        if any(each.claim.id in WHY.values() for each in judged.findings):
            yield _behind(judged)
    yield _depth(judged.contacts)
    if series.pressed_in and series.speeds:
        yield _pressed_in(judged.contacts)


def _each_body(table: Callable[[str], dict]) -> DataFrame:
    """Columns of the rough and of the smooth body as tables one below the other, with the body in front."""
    return stacked({(body,): DataFrame(table(body)) for body in BODIES}, "body")


def _levels(judged) -> Plot:
    contacts, series = judged.contacts, judged.series

    def memories(solver):
        groups = judged.laws[solver].ratios
        return place_columns(series) | {name: groups[name].ravel() for name, _ in study_friction.MEMORIES.values()}

    def friction_of(solver):
        laws, columns = judged.laws[solver], memories(solver)
        columns |= interval_columns("friction_coefficient", friction_at(contacts, solver))
        columns["smooth"] = friction_at(contacts, solver, SMOOTH).value.ravel()
        return DataFrame(columns | {"eq_19": laws.law.ravel()})

    def ratio(sample):
        one, three = (friction(sample[solver])[1:] for solver in SOLVERS)
        return one / three

    ratios = _each_body(
        lambda body: (
            memories("BEM") | interval_columns("friction_1d_over_3d", interval(ratio, contacts, body, *SOLVERS))
        )
    )
    tables = {"levels": each_dimension(friction_of), "levels-ratios": ratios}
    told = ""
    if theories := contacts.theories:
        tables[study_friction.THEORY] = stacked(
            {(name,): _friction_of_theory(series, each) for name, each in theories.items()}, "solver"
        )
        told = " Thin: Persson's theory (2001, green), the law in 3D (dotted)."
    return Plot(
        f"{series.folder}/levels",
        study_friction.levels,
        tables,
        f"Friction against speed at the least, a middle and the greatest {series.prescribed}: rough (markers), "
        f"smooth (thin), Eq. 19 (pale dashes).{told} Below: 1D over 3D, rough and smooth; lines at 1 and at 2, "
        "the limit of smooth bodies at low speed. Bars: 95 %.",
        f"Friction of {series.title} in both dimensionalities",
    )


def _friction_of_theory(series, answers) -> DataFrame:
    mu = answers["friction_coefficient"].transpose("speed", series.prescribed).values
    return DataFrame(place_columns(series) | {"friction_coefficient": mu.ravel()})


def _law(judged, shifted: Plot) -> Iterator[Plot]:
    """Master curve of a series beside its curves in one dimension, shifted as in another plot."""
    if (points := LawPoints.of(judged.contacts, judged.laws)) is not None:
        tables = (shifted.tables[name] for name in ("collapse", "collapse-curves", "collapse-fits"))
        paper, curves, fits = (table[table["dimension"] == "1D"] for table in tables)
        first = curves["curve"].iloc[0]
        fitted = study_friction.misfit(fits.iloc[0]) if first == study_friction.COMMON else ""
        if "shifted_friction" in paper and paper["shifted_friction"].notna().any():
            lifted = {f"friction_coefficient{end}": paper[f"shifted_friction{end}"] for end in ENDS}
            paper = paper.assign(**lifted)
        paper = paper.assign(series=judged.series.title)
        curve, folder = curves[curves["curve"] == first], f"{judged.series.folder}/"
        yield study_law.plot([points], paper, curve, judged.findings, folder, fitted)


def _law_of_all(series: Sequence[JudgedSeries], together: Sequence[Finding]) -> Iterator[Plot]:
    """Master curve of several series, beside friction in one dimension against xi."""
    found = [(each, points) for each in series if each.laws and (points := LawPoints.of(each.contacts, each.laws))]
    if len(found) > 1:
        paper = concat([_reduced([each], "MDR") for each, _ in found], ignore_index=True)
        xi = np.geomspace(paper["xi"].min(), paper["xi"].max(), 101)
        curve = DataFrame({"curve": "Eq. 19", "xi": xi, "friction_over_plateau": interpolation(xi)})
        yield study_law.plot([points for _, points in found], paper, curve, together)


def _behind(judged) -> Plot:
    contacts, series = judged.contacts, judged.series

    def of(solver):
        def over_the_first(name, below=None):
            return lambda sample: (values := mean(sample[solver], name, below)[1]) / values[0]

        load = force_at(contacts, solver).value[0]
        law = nominal_exponent(series.models[solver].draws, judged.laws[solver].exponent_of_load)
        columns = {"normal_force": load, "contact_law": (load / load[0]) ** law, "drag_law": 1.0, "slope_law": 1.0}
        for name, (variable, below) in behind(judged.series.models[solver].draws).items():
            columns |= interval_columns(name, interval(over_the_first(variable, below), contacts, ROUGH, solver))
        return DataFrame(columns)

    return Plot(
        f"{series.folder}/behind",
        study_friction.behind,
        {"behind": each_dimension(of)},
        "Behind Eq. 17, at the slowest speed, over the numbers under the least load: (a) real contact, a length "
        "in 1D and an area in 3D; (b) friction over it; (c) rms slope of what touches. Dashed: as the paper "
        "derives it, contact like the nominal one, the others constant. Bars: 95 %.",
        f"What makes slow friction of {series.title} depend on the load",
    )


def _depth(contacts: Contacts) -> Plot:
    series = contacts.series
    load, depth = closed_forms(series)
    at_load = series.prescribed == "load"
    name, known, unit = (
        ("depth_reached", depth, series.scene.roughness.rms_height) if at_load else ("normal_force", load, load)
    )
    places = {series.prescribed: series.values}

    def at_rest(solver):
        columns = places | {"closed_form": known}
        for body in BODIES:
            found = interval(lambda sample: mean(sample[solver], name)[0], contacts, body, solver)
            less = Interval(*((each - known) / unit for each in found))
            columns |= interval_columns(body, found) | interval_columns(f"{body}_deviation", less)
        return DataFrame(columns)

    def apart(sample):
        one, three = (mean(sample[solver], name)[0] for solver in SOLVERS)
        return (one - three) / depth if at_load else one / three - 1

    differences = _each_body(
        lambda body: places | interval_columns("difference", interval(apart, contacts, body, *SOLVERS))
    )
    stiffness = DataFrame(columns=["dimension", "normal_force", "stiffness", "stiffness_low", "stiffness_high"])
    if len(series.values) > 1:
        closed = {"normal_force": np.sqrt(load[1:] * load[:-1]), "stiffness": np.diff(load) / np.diff(depth)}
        frames = [
            each_dimension(partial(_stiffness, contacts)),
            DataFrame({"dimension": study_depth.CLOSED, **closed}),
        ]
        stiffness = concat(frames, ignore_index=True)
    what = "Depth under prescribed loads" if at_load else "Force at prescribed depths"
    return Plot(
        f"{series.folder}/depth",
        study_depth.depth,
        {"depth": each_dimension(at_rest), "depth-differences": differences, "depth-stiffness": stiffness},
        f"{what} at rest: (a) less the closed form of the smooth body, (b) 1D against 3D, (c) stiffness between "
        "neighbours. Bars: 95 %; points are drawn apart along the axis. Depth is that of the macroscopic tip, "
        "below zero where only the highest asperities touch.",
        f"{what}, one dimension against three",
    )


def _stiffness(contacts, solver) -> DataFrame:
    """dF/dd [N/m] between neighbouring loads or depths at rest, on the same surfaces."""

    def secants(sample):
        rest = resting(sample[solver])
        names = "normal_force", "depth_reached"
        force, depth = (np.diff(rest[name].transpose(..., "surface").values, axis=0) for name in names)
        return mean_ratio(force, depth).value

    force = mean(contacts.sample(FINE, ROUGH, solver)[solver], "normal_force")[0]
    columns = interval_columns("stiffness", interval(secants, contacts, ROUGH, solver))
    return DataFrame({"normal_force": np.sqrt(force[1:] * force[:-1]), **columns})


def _pressed_in(contacts: Contacts) -> Plot:
    series = contacts.series

    def forces(solver):
        columns = place_columns(series, "rate") | interval_columns("normal_force", force_at(contacts, solver))
        columns["smooth_normal_force"] = force_at(contacts, solver, SMOOTH).value.ravel()
        return DataFrame(columns | {study_depth.CLOSED.replace(" ", "_"): loading(series).ravel()})

    def apart(sample):
        one, three = (mean(sample[solver], "normal_force")[1:] for solver in SOLVERS)
        return one / three - 1

    ratios = place_columns(series, "rate")
    for body in BODIES:
        ratios |= interval_columns(f"{body}_difference", interval(apart, contacts, body, *SOLVERS))
    return Plot(
        f"{series.folder}/pressed-in",
        study_depth.pressed_in,
        {"pressed-in": each_dimension(forces), "pressed-in-ratios": DataFrame(ratios)},
        "Force at the end of an indentation at a constant rate, by colour: rough (markers), smooth (lines), Lee "
        "and Radok (crosses). Right: 1D over 3D at the same depth and rate, less one; in 3D the last half step "
        "is still to come, which the claims allow for and the figure does not. Bars are intervals of 95 %.",
        "Force against depth at each rate, one dimension against three",
    )


def _family(found) -> Plot:
    points = {}
    for (shape, members), (solver, dimension) in product(found.items(), SOLVERS.items()):
        points[shape, dimension] = frame = _reduced(members, solver)
        for end in ENDS:
            frame[f"over_eq_19{end}"] = frame[f"friction_over_plateau{end}"] / interpolation(frame["xi"])
    return Plot(
        "family",
        study_friction.family,
        {"family": stacked(points, "shape", "dimension")},
        "Friction over that of Eq. 19 at the same ξ (Eq. 18) and plateau (Eq. 14), for all roughness and solids "
        "of a shape, by colour of the load. If they count through ξ alone, the points of a shape are one curve. "
        "Bars: 95 %, cut at the frame.",
        "Friction over Eq. 19 against ξ, left 1D, right 3D",
    )


def _reduced(members, solver) -> DataFrame:
    """Friction over its plateau against xi of every point of several series."""
    fine, coarse = (reduced(members, solver, grid) for grid in (FINE, COARSE))
    frames = []
    for k, each in enumerate(members):
        mu, other = (mean_ratio(data.friction_force[k], data.load[k]) for data in (fine, coarse))
        columns = interval_columns("friction_over_plateau", Interval.of(mu, np.abs(mu.value - other.value)))
        xi = 1 / mean_ratio(fine.load[k]).value
        pressed = place_columns(each.series) | {"normal_force": force_at(each.contacts, solver).value.ravel()}
        count = len(pressed["speed"])
        frame = DataFrame({"series": each.series.title, "xi": xi, **columns})[:count].assign(**pressed)
        frames.append(frame)
    return concat(frames, ignore_index=True)
