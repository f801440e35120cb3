"""Plots of a study: the tables behind each figure, from its answers, laws, shifts and findings."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import product

import numpy as np
from pandas import DataFrame, concat

from mdr1d.equations import interpolation

from ..finding import FAILS, HOLDS, Finding, claimed, table
from ..page import Plot
from ..plots import study_depth, study_friction, study_verdicts
from ..plots.study_friction import ALONE, COMMON, FITTED, LAW, PREDICTED
from ..rectangle import COARSE, FINE
from ..statistics import eq23
from ..statistics.collapse import ENDS
from ..statistics.jackknife import friction, mean, mean_ratio
from ..statistics.means import Interval
from .claims_depth import closed_forms, loading
from .claims_friction import behind, nominal_exponent
from .families import families, reduced
from .judgement import JudgedSeries
from .points import force_at, friction_at, interval, stacked
from .series import BODIES, ROUGH, SMOOTH, SOLVERS, Contacts, resting


def plots_of_study(series: Sequence[JudgedSeries], findings: Sequence[Finding], together: bool) -> Iterator[Plot]:
    """Verdicts on every claim, and several series against one variable.

    together : whether findings on several series are among them
    """
    judged = claimed(findings)
    if len({each.where for each in judged}) > 1:
        known = {each.series.name: each.series.title for each in series}
        titles = [(place, known.get(place, place)) for place in dict.fromkeys(each.where for each in judged)]
        yield Plot(
            "verdicts",
            study_verdicts.verdicts,
            {"verdicts": table(judged)},
            "Claims (rows) in each series (columns): verdict, and the number measured, with its interval of 95 % "
            "where there is room. The darker a field, the farther the number lies from the one claimed, in "
            "tolerances. Claims that compare both dimensionalities stand last.",
            _counted(judged),
            {"titles": titles},
        )
    found = families(series)
    if found and together:
        yield _family(found)


def plots_of_series(judged: JudgedSeries) -> Iterator[Plot]:
    """Distance of each claim from what was measured; friction, or depth and force."""
    series = judged.series
    if claims := claimed(judged.findings):
        yield Plot(
            f"{series.folder}/effects",
            study_verdicts.effects,
            {"effects": table(claims)},
            "Distance of what was measured from what is claimed, in tolerances; grey, within; logarithmic beyond "
            "one, arrows beyond 100. Lines, intervals of 95 %: thick from the scatter of surfaces, thin with the "
            "error of the grid. Dot: holds; cross: fails; circle: undecided. Right: the number measured with its "
            "interval.",
            _counted(claims),
        )
    if judged.laws:
        yield _collapse(judged)
        if fitted := {solver: found for solver in SOLVERS if (found := _fitted(judged, solver))}:
            yield _shifts(judged, fitted)
        yield _levels(judged)
        if any(each.claim.id.startswith("why17.") for each in judged.findings):
            yield _behind(judged)
    yield _depth(judged.contacts)
    if series.pressed_in and series.speeds:
        yield _pressed_in(judged.contacts)


def _counted(findings):
    """Number of findings of each verdict, in words."""
    verdicts = [each.verdict for each in findings]
    return ", ".join(f"{name} {verdicts.count(name)}" for name in dict.fromkeys(verdicts))


def _each_dimension(table: Callable[[str], DataFrame]) -> DataFrame:
    """Tables of the solvers by their names, one below the other, with the dimension in front."""
    return stacked({(dimension,): table(solver) for solver, dimension in SOLVERS.items()}, "dimension")


def _each_body(table: Callable[[str], dict]) -> DataFrame:
    """Columns of the rough and of the smooth body as tables one below the other, with the body in front."""
    return stacked({(body,): DataFrame(table(body)) for body in BODIES}, "body")


def _columns(name: str, found: Interval) -> dict[str, np.ndarray]:
    """Numbers and both ends of their intervals, flat, under a name."""
    return {f"{name}{end}": np.ravel(each) for end, each in zip(("", "_low", "_high"), found, strict=True)}


def _places(series, name="speed") -> dict[str, np.ndarray]:
    """Speed, and load or depth, of each point, flat."""
    speeds, values = np.meshgrid(series.speeds, series.values, indexing="ij")
    return {name: speeds.ravel(), series.prescribed: values.ravel()}


def _collapse(judged) -> Plot:
    parts = {"collapse": _shifted, "collapse-curves": _curves, "collapse-fits": _fit}
    verdicts = [each for each in judged.findings if each.claim.id == eq23.COLLAPSE.id]
    return Plot(
        f"{judged.series.folder}/collapse",
        study_friction.collapse,
        {name: _each_dimension(partial(table, judged)) for name, table in parts.items()},
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
    frame = DataFrame(_places(series) | {"normal_force": load.ravel()} | _columns("friction_coefficient", mu))
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
    missed = eq23.BOTH if lead is found.both else eq23.COLLAPSE
    own = [each for each in judged.findings if each.claim.id == missed.id]
    ends = [each.interval for each in own if each.dimension == SOLVERS[solver]]
    low, high = ends[0] if ends else lead.misfit.interval()
    row = {
        "misfit": lead.misfit.value,
        "misfit_low": low,
        "misfit_high": high,
        "rms": lead.rms,
        "degree": found.degree,
        "points_left_out": found.points_left_out,
        "surfaces_left_out": found.surfaces_left_out,
        "reason": lead.reason,
    }
    return DataFrame([row])


def _shifts(judged, fitted) -> Plot:
    shifts, fits = {}, {}
    for solver, found in fitted.items():
        dimension, lead = SOLVERS[solver], _lead(judged, solver)
        theory = judged.laws[solver].shifts[[judged.series.speeds.index(speed) for speed in found.speeds.tolist()]]
        shifts[dimension,] = found.shifts(lead).assign(theory=theory - theory[len(theory) // 2])
        numbers = (lead.exponent.value, *lead.exponent.interval())
        fits[dimension,] = DataFrame([{f"exponent{end}": each for end, each in zip(ENDS, numbers, strict=True)}])
    return Plot(
        f"{judged.series.folder}/shifts",
        study_friction.shifts,
        {"shifts": stacked(shifts, "dimension"), "shifts-fits": stacked(fits, "dimension")},
        "Shifts that bring the curves onto one, zero at the middle speed, with intervals of 95 % over surfaces. "
        "(a) Along ln F_N, alone unless friction itself is shifted, and ln p(v) of Eq. 22 (line). (b) Their "
        "difference. (c) Along ln μ, both fitted; grey, the tolerance.",
        f"Shifts against speed in {' and '.join(SOLVERS[solver] for solver in fitted)}",
        {"tolerance": eq23.TOLERANCE},
    )


def _levels(judged) -> Plot:
    contacts, series = judged.contacts, judged.series

    def memories(solver):
        groups = judged.laws[solver].ratios
        return _places(series) | {name: groups[name].ravel() for name, _ in study_friction.MEMORIES.values()}

    def friction_of(solver):
        laws, columns = judged.laws[solver], memories(solver)
        columns |= _columns("friction_coefficient", friction_at(contacts, solver))
        columns["smooth"] = friction_at(contacts, solver, SMOOTH).value.ravel()
        return DataFrame(columns | {"eq_19": laws.law.ravel()})

    def ratio(sample):
        one, three = (friction(sample[solver])[1:] for solver in SOLVERS)
        return one / three

    ratios = _each_body(
        lambda body: memories("BEM") | _columns("friction_1d_over_3d", interval(ratio, contacts, body))
    )
    return Plot(
        f"{series.folder}/levels",
        study_friction.levels,
        {"levels": _each_dimension(friction_of), "levels-ratios": ratios},
        f"Friction against speed at the least, a middle and the greatest {series.prescribed}: rough (markers), "
        "smooth (thin), Eq. 19 (pale dashes). Below: 1D over 3D, rough and smooth; lines at 1 and at 2, the limit "
        "of smooth bodies at low speed. Bars: 95 %.",
        f"Friction of {series.title} in both dimensionalities",
    )


def _behind(judged) -> Plot:
    contacts, series = judged.contacts, judged.series

    def of(solver):
        def over_the_first(name, below=None):
            return lambda sample: (values := mean(sample[solver], name, below)[1]) / values[0]

        load = force_at(contacts, solver).value[0]
        law = nominal_exponent(solver, judged.laws[solver].exponent_of_load)
        columns = {"normal_force": load, "contact_law": (load / load[0]) ** law, "drag_law": 1.0, "slope_law": 1.0}
        for name, (variable, below) in behind(solver).items():
            columns |= _columns(name, interval(over_the_first(variable, below), contacts, ROUGH, solver))
        return DataFrame(columns)

    return Plot(
        f"{series.folder}/behind",
        study_friction.behind,
        {"behind": _each_dimension(of)},
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
            columns |= _columns(body, found) | _columns(f"{body}_deviation", less)
        return DataFrame(columns)

    def apart(sample):
        one, three = (mean(sample[solver], name)[0] for solver in SOLVERS)
        return (one - three) / depth if at_load else one / three - 1

    differences = _each_body(lambda body: places | _columns("difference", interval(apart, contacts, body)))
    stiffness = DataFrame(columns=["dimension", "normal_force", "stiffness", "stiffness_low", "stiffness_high"])
    if len(series.values) > 1:
        closed = {"normal_force": np.sqrt(load[1:] * load[:-1]), "stiffness": np.diff(load) / np.diff(depth)}
        frames = [
            _each_dimension(partial(_stiffness, contacts)),
            DataFrame({"dimension": study_depth.CLOSED, **closed}),
        ]
        stiffness = concat(frames, ignore_index=True)
    what = "Depth under prescribed loads" if at_load else "Force at prescribed depths"
    return Plot(
        f"{series.folder}/depth",
        study_depth.depth,
        {"depth": _each_dimension(at_rest), "depth-differences": differences, "depth-stiffness": stiffness},
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
        force, depth = (np.diff(rest[name].transpose(..., "draw").values, axis=0) for name in names)
        return mean_ratio(force, depth).value

    force = mean(contacts.sample(FINE, ROUGH, solver)[solver], "normal_force")[0]
    columns = _columns("stiffness", interval(secants, contacts, ROUGH, solver))
    return DataFrame({"normal_force": np.sqrt(force[1:] * force[:-1]), **columns})


def _pressed_in(contacts: Contacts) -> Plot:
    series = contacts.series

    def forces(solver):
        columns = _places(series, "rate") | _columns("normal_force", force_at(contacts, solver))
        columns["smooth_normal_force"] = force_at(contacts, solver, SMOOTH).value.ravel()
        return DataFrame(columns | {study_depth.CLOSED.replace(" ", "_"): loading(series).ravel()})

    def apart(sample):
        one, three = (mean(sample[solver], "normal_force")[1:] for solver in SOLVERS)
        return one / three - 1

    ratios = _places(series, "rate")
    for body in BODIES:
        ratios |= _columns(f"{body}_difference", interval(apart, contacts, body))
    return Plot(
        f"{series.folder}/pressed-in",
        study_depth.pressed_in,
        {"pressed-in": _each_dimension(forces), "pressed-in-ratios": DataFrame(ratios)},
        "Force at the end of an indentation at a constant rate, by colour: rough (markers), smooth (lines), Lee "
        "and Radok (crosses). Right: 1D over 3D at the same depth and rate, less one; in 3D the last half step "
        "is still to come, which the claims allow for and the figure does not. Bars are intervals of 95 %.",
        "Force against depth at each rate, one dimension against three",
    )


def _family(found) -> Plot:
    points, laws = {}, {}
    for (shape, members), (solver, dimension) in product(found.items(), SOLVERS.items()):
        points[shape, dimension] = frame = _reduced(members, solver)
        known = frame["xi"].dropna()
        if known.size:
            xi = np.geomspace(known.min(), known.max(), 101)
            laws[shape, dimension] = DataFrame({"xi": xi, "friction_over_plateau": interpolation(xi)})
    return Plot(
        "family",
        study_friction.family,
        {"family": stacked(points, "shape", "dimension"), "family-law": stacked(laws, "shape", "dimension")},
        "Friction over its plateau (Eq. 14) against ξ (Eq. 18), a panel for each roughness or solid; points of "
        "one load are joined, in its colour. Grey: Eq. 19. If roughness, solid, speed and load count through ξ "
        "alone, all panels show one curve. Bars: 95 %.",
        f"{len(points)} panels of friction against ξ",
    )


def _reduced(members, solver) -> DataFrame:
    """Friction over its plateau against xi of every point of several series."""
    fine, coarse = (reduced(members, solver, grid) for grid in (FINE, COARSE))
    frames = []
    for k, each in enumerate(members):
        mu, other = (mean_ratio(data.friction_force[k], data.load[k]) for data in (fine, coarse))
        columns = _columns("friction_over_plateau", Interval.of(mu, np.abs(mu.value - other.value)))
        xi = 1 / mean_ratio(fine.load[k]).value
        pressed = _places(each.series) | {"normal_force": force_at(each.contacts, solver).value.ravel()}
        count = len(pressed["speed"])
        frame = DataFrame({"series": each.series.title, "xi": xi, **columns})[:count].assign(**pressed)
        frames.append(frame)
    return concat(frames, ignore_index=True)
