"""The judgement of a study: for each of its series, what the claims of the paper come to in 1D and in 3D."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from scene import Program

from ..finding import Finding
from ..outcome import Outcome
from ..shifting import Shifting
from ..study import Task
from ..verdict import DIMENSIONS
from .catalogue import SIZES, STUDIES, Size, Study
from .claims import friction_findings
from .depthclaims import depth_findings, loading
from .families import family_findings
from .laws import Laws, laws
from .series import Series, Solved, collect
from .shiftclaims import shift_findings, shiftings, unshifted


@dataclass(frozen=True)
class JudgedSeries:
    """One series.

    solved : its answers
    laws : by solver's name; empty of a series that does not slide, or of which a solver has no rough answer
    shiftings : by solver's name, what shifts of its curves achieve; a solver with too few points is missing
    findings : what each claim comes to
    closed : force [N] on the smooth body pressed in at rates, (rates, depths), in closed form; None of others
    """

    solved: Solved
    laws: Mapping[str, Laws]
    shiftings: Mapping[str, Shifting]
    findings: tuple[Finding, ...]
    closed: np.ndarray | None = None


@dataclass(frozen=True)
class JudgedStudy:
    """A study.

    name, study, size : what was asked
    series : one after the other
    findings : of claims on several series together
    """

    name: str
    study: Study
    size: Size
    series: tuple[JudgedSeries, ...]
    findings: tuple[Finding, ...] = ()


def judge_study(name: str, size: str, series: list[Series], outcomes: Mapping[Task, Outcome]) -> JudgedStudy:
    """Judge everything that was solved for a study."""
    judged = tuple(judge_series(collect(each, outcomes)) for each in series)
    return JudgedStudy(name, STUDIES[name], SIZES[size], judged, tuple(family_findings(judged)))


def judge_series(solved: Solved) -> JudgedSeries:
    """What each claim comes to on one series."""
    if not solved.series.slides:
        series = solved.series
        closed = loading(series) if isinstance(series.scene.motion, Program) else None
        return JudgedSeries(solved, {}, {}, tuple(depth_findings(solved)), closed)
    ruled = {solver: laws(solved, solver) for solver in DIMENSIONS}
    if None in ruled.values():
        return JudgedSeries(solved, {}, {}, ())
    shifted, found = {}, []
    for solver, ruling in ruled.items():
        if both := shiftings(solved, solver):
            shifted[solver] = both[0]
            found += shift_findings(solver, both, ruling)
        else:
            found += unshifted(solved.series, solver, ruling)
    return JudgedSeries(solved, ruled, shifted, tuple(found + friction_findings(solved, ruled)))
