"""Claims on several series together: roughness and rheology count through one variable alone."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...solving.parameter_grid import COARSE, FINE
from ...statistics import eq23, jackknife
from ...statistics.collapse import collapse
from ...statistics.finding import Finding
from ...statistics.frictioncurves import SimulatedCurves
from ...statistics.intervals import RmsMisfit
from ...statistics.jackknife import DrawSet, mean_ratio, measured, strata_of
from .claims import CLAIMS, claim, geometric, power
from .claims_friction import FAST, SLOW
from .claims_law import law_findings_of_all
from .judgement import JudgedSeries
from .series import FAMILIES, ROUGH, Series, sliding

PLOT = "family"


def families(series: Sequence[JudgedSeries]) -> dict[str, list[JudgedSeries]]:
    """Series that slide, by the name of their shape, where roughness or solid differ.

    All of a family have as many surfaces; of several such families of one shape it is the largest.
    """
    found: dict[tuple[str, str], list[JudgedSeries]] = {}
    for judged in series:
        each = judged.series
        if judged.laws and FAMILIES in each.claims:
            found.setdefault((_shape(each), str(each.drawn.counts)), []).append(judged)
    rising = sorted(found.items(), key=lambda family: len(family[1]))
    return {shape: members for (shape, _), members in rising if _differ(members)}


def alike(series: Sequence[Series]) -> list[list[str]]:
    """Names of series that slide, by their shape, which are to have as many surfaces as each other."""
    found: dict[str, list[str]] = {}
    for each in series:
        if each.slides and FAMILIES in each.claims:
            found.setdefault(_shape(each), []).append(each.name)
    return list(found.values())


def every(series: Series) -> str:
    """Place of findings on all series of its shape."""
    return f"every {_shape(series)}"


def _shape(series):
    return type(series.scene.indenter).__name__.lower()


def reduced(members: Sequence[JudgedSeries], solver: str, grid: str = FINE) -> SimulatedCurves:
    """mu over the plateau against 1/xi, a curve for each series; `speeds` count the series."""
    loads, frictions = [], []
    for judged in members:
        answers, laws = sliding(judged.contacts(solver, ROUGH, grid)), judged.laws[solver]
        force, drag = (
            answers[name].transpose(..., "surface").values for name in ("normal_force", "friction_force")
        )
        mean = mean_ratio(force).value[..., None]
        unit = 1 / laws.xi_under(mean[..., 0])[..., None] / mean
        loads.append((force * unit).reshape(-1, force.shape[2]))
        frictions.append((drag * unit / laws.plateau).reshape(loads[-1].shape))
    most = max(map(len, loads))
    load, friction = (np.array([_filled(each, most) for each in stack]) for stack in (loads, frictions))
    strata = strata_of(members[0].contacts(solver))
    return SimulatedCurves(np.arange(1.0, len(members) + 1), load, friction, strata, solver)


def family_findings(series: Sequence[JudgedSeries]) -> Iterator[Finding]:
    """Findings for each shape and dimensionality, then those on all series, whatever their shape."""
    for shape, members in families(series).items():
        for solver in members[0].laws:
            yield _one_curve(members, solver, shape)
            yield from _slope_exponents(members, solver, shape)
    asked = [each for each in series if each.laws and FAMILIES in each.series.claims]
    yield from law_findings_of_all([(each.contacts, each.laws) for each in asked])


def _one_curve(members, solver, shape):
    fine, coarse = (_missed(members, solver, grid) for grid in (FINE, COARSE))
    unknown = "" if np.isfinite(fine.value + coarse.value) else "too few points or surfaces have an answer"
    found = eq23.finding(CLAIMS["eq18.one-curve"], fine, coarse, unknown)
    return replace(
        found,
        dimension=members[0].contacts.labels[solver],
        where=every(members[0].series),
        draws=members[0].series.draws[solver],
        regime=_words(members, solver),
        plot=PLOT,
    )


def _missed(members, solver, grid):
    """Misfit of all points to one curve; unknown where there are too few."""
    try:
        return collapse(reduced(members, solver, grid)).unshifted.misfit
    except ValueError:
        return RmsMisfit.unknown()


def _slope_exponents(members, solver, shape):
    """Findings at the loads or depths where all are slow, or all are fast."""
    alike = _apart_by_height(members)
    if len(alike) < 3:
        return
    laws = [judged.laws[solver] for judged in alike]
    plateaus = np.array([each.plateau for each in laws])
    # The same surfaces are left out of all series.
    fine, coarse = (
        DrawSet({each.series.name: each.contacts.sample(grid, ROUGH, solver)[solver] for each in alike})
        for grid in (FINE, COARSE)
    )
    slow = np.all([(each.xi[0] <= SLOW) & (each.slowest_loss <= SLOW) for each in laws], axis=0)
    fast = np.all([each.xi[-1] >= FAST for each in laws], axis=0)
    for name, place, values, expected in (
        ("eq17.slope-exponent", 0, slow, 2.0),
        ("eq14.slope-exponent", -1, fast, 1.0),
    ):
        if not values.any():
            continue
        # What Eq. 19 still lacks of either limit.
        lacking = [each.law[place] / (each.plateau * each.xi[place] ** (expected - 1)) for each in laws]

        def exponent(sample, place=place, values=values, lacking=lacking):
            pairs = zip(sample.values(), lacking, strict=True)
            levels = [geometric((jackknife.friction(each)[1:][place] / less)[values]) for each, less in pairs]
            return power(plateaus, np.array(levels))

        words = _words(alike, solver, (place, values))
        asked = claim(name, exponent, members[0].contacts.labels[solver])
        yield measured(asked, fine, coarse, every(members[0].series), words, PLOT)


def _apart_by_height(members):
    """The first and those that differ from it in the rms height alone."""

    def but_for_height(judged):
        each = judged.series
        rough = replace(each.scene.roughness, rms_height=1.0)
        return each.speeds, each.values, replace(each.scene, roughness=rough)

    return [judged for judged in members if but_for_height(judged) == but_for_height(members[0])]


def _differ(members):
    """Whether roughness or solid differ between series."""
    scenes = [judged.series.scene for judged in members]
    return any(each.roughness != scenes[0].roughness or each.elastomer != scenes[0].elastomer for each in scenes)


def _words(members, solver, place=...):
    """The regimes of all, at some points."""
    return "; ".join(dict.fromkeys(judged.laws[solver].words(place) for judged in members))


def _filled(rows, count):
    """Series with fewer points end with unknown ones."""
    return np.vstack([rows, np.full((count - len(rows), rows.shape[1]), np.nan)])
