"""Claims on several rough series together: roughness and rheology count through one variable alone."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...solving.curve import COARSE, FINE
from ...statistics import eq23
from ...statistics.collapse import collapse
from ...statistics.finding import Finding
from ...statistics.frictioncurves import SimulatedCurves
from ...statistics.intervals import RmsMisfit
from ...statistics.jackknife import draws_of, friction, measured, off_the_ratio, strata_of
from .claims import CLAIMS, geometric, power
from .claims_law import LawPoints, drawn_of, law_findings_of
from .measures import FAST, ROUGH, SLOW
from .rough import RoughSeries, sliding
from .series import Judged, Series


def families(members: Sequence[Judged]) -> dict[str, list[Judged]]:
    """Members by their family, where roughness or solid differ.

    All members of a family have the same number of surfaces; of several such families of a shape the largest
    counts.
    """
    found: dict[tuple[str, str], list[Judged]] = {}
    for each in members:
        found.setdefault((each.series.family, str(each.series.drawn[ROUGH].counts)), []).append(each)
    rising = sorted(found.items(), key=lambda family: len(family[1]))
    return {family: own for (family, _), own in rising if _differ(own)}


def alike(series: Sequence[Series]) -> list[list[str]]:
    """Names of series that slide, by their family, which are to have as many surfaces as each other."""
    found: dict[str, list[str]] = {}
    for each in series:
        if isinstance(each, RoughSeries) and each.slides:
            found.setdefault(each.family, []).append(each.name)
    return list(found.values())


def reduced(members: Sequence[Judged], model: str, level: str = FINE) -> SimulatedCurves:
    """mu over the plateau against 1/xi, a curve for each series; `speeds` count the series."""
    rows = []
    for each in members:
        answers, laws = sliding(each.answers(ROUGH, model, level)), each.laws[model]
        force, drag = (draws_of(answers, name) for name in ("normal_force", "friction_force"))
        load = off_the_ratio(force)[0]
        unit = (1 / laws.xi_under(load) / load)[..., None]
        rows.append(np.array([force * unit, drag * unit / laws.plateau]).reshape(2, -1, force.shape[-1]))
    # Series with fewer points end with unknown ones.
    both = np.full((2, len(rows), max(each.shape[1] for each in rows), rows[0].shape[2]), np.nan)
    for k, row in enumerate(rows):
        both[:, k, : row.shape[1]] = row
    strata = strata_of(members[0].answers(ROUGH, model))
    load, drag = both
    return SimulatedCurves(np.arange(1.0, len(members) + 1), load, drag, strata, model)


def together(members: Sequence[Judged]) -> Iterator[Finding]:
    """Findings for each family and dimensionality, then those on all series, whatever their shape."""
    for family, own in families(members).items():
        for model in own[0].laws:
            for each in (_one_curve(own, model), *_slope_exponents(own, model)):
                yield replace(each, where=family, curve=family)
    points = [found for each in members if (found := LawPoints.of(each.series, each.answers))]
    if len(points) > 1:
        yield from law_findings_of(points)


def _one_curve(members, model):
    fine, coarse = (_missed(members, model, level) for level in (FINE, COARSE))
    unknown = "" if np.isfinite(fine.value + coarse.value) else "too few points or surfaces have an answer"
    found = eq23.finding(CLAIMS["eq18.one-curve"], fine, coarse, unknown)
    first, words = members[0].series, _words(members, model)
    return replace(found, dimension=first.models.labels[model], draws=first.draws[model], regime=words)


def _missed(members, model, level):
    """Misfit of all points to one curve; unknown where there are too few."""
    try:
        return collapse(reduced(members, model, level)).unshifted.misfit
    except ValueError:
        return RmsMisfit()


def _slope_exponents(members, model):
    """Findings at the loads or depths where all are slow, or all are fast."""
    alike = [each for each in members if _but_for_height(each) == _but_for_height(members[0])]
    if len(alike) < 3:
        return
    laws = [each.laws[model] for each in alike]
    # The same surfaces are left out of all series.
    fine, coarse = (drawn_of(alike, model, level) for level in (FINE, COARSE))
    slow = np.all([(each.xi[0] <= SLOW) & (each.slowest_loss <= SLOW) for each in laws], axis=0)
    fast = np.all([each.xi[-1] >= FAST for each in laws], axis=0)
    for name, place, values in (("eq17.slope-exponent", 0, slow), ("eq14.slope-exponent", -1, fast)):
        # What Eq. 19 still lacks of either limit.
        power_of_xi = CLAIMS[name].expected - 1
        lacking = [each.law[place] / (each.plateau * each.xi[place] ** power_of_xi) for each in laws]

        def exponent(sample, place=place, values=values, lacking=lacking):
            found = [friction(each)[1:][place] for each in sample.values()]
            levels = [geometric((mu / less)[values]) for mu, less in zip(found, lacking, strict=True)]
            return power(np.array([each.plateau for each in laws]), np.array(levels))

        if values.any():
            dimension = members[0].series.models.labels[model]
            asked = replace(CLAIMS[name], measure=exponent, dimension=dimension)
            yield measured(asked, fine, coarse, "", _words(alike, model, (place, values)))


def _but_for_height(member):
    """What a series has apart from its rms height."""
    each = member.series
    rough = replace(each.scene.roughness, rms_height=1.0)
    return each.speeds, each.values, replace(each.scene, roughness=rough)


def _differ(members):
    """Whether roughness or solid differ between series."""
    scenes = [each.series.scene for each in members]
    return any(each.roughness != scenes[0].roughness or each.elastomer != scenes[0].elastomer for each in scenes)


def _words(members, model, place=...):
    """The regimes of all, at some points."""
    return "; ".join(dict.fromkeys(each.laws[model].words(place) for each in members))
