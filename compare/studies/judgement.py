"""The judgement of a study: for each of its series, what the claims of the paper come to in 1D and in 3D."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from scene import Program

from ..finding import Finding
from ..outcome import Outcome
from ..shifting import Shifting
from ..store import Task
from ..verdict import DIMENSIONS
from .catalogue import Size, Study
from .claims import friction_findings
from .depthclaims import depth_findings, loading
from .families import family_findings
from .laws import Laws, laws
from .question import BOTH
from .series import COLLAPSE, DEPTH, FRICTION, PAIRS, Series, Solved, collect
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


def judge_study(
    name: str, study: Study, size: Size, series: Iterable[Series], outcomes: Mapping[Task, Outcome]
) -> JudgedStudy:
    """Judge everything that was solved for a study."""
    judged = tuple(judge_series(collect(each, outcomes)) for each in series)
    return JudgedStudy(name, study, size, judged, tuple(family_findings(judged)))


def judge_series(solved: Solved) -> JudgedSeries:
    """What each claim comes to on one series, of those that it asks."""
    series = solved.series
    if not series.slides:
        closed = loading(series) if isinstance(series.scene.motion, Program) else None
        return JudgedSeries(solved, {}, {}, _asked(series, depth_findings(solved), DEPTH), closed)
    found = {solver: laws(solved, solver) for solver in DIMENSIONS}
    ruled = {solver: ruling for solver, ruling in found.items() if ruling is not None}
    if len(ruled) < len(found):
        return JudgedSeries(solved, {}, {}, ())
    shifted: dict[str, Shifting] = {}
    collapse: list[Finding] = []
    for solver, ruling in ruled.items():
        if both := shiftings(solved, solver):
            shifted[solver] = both[0]
            collapse += shift_findings(solver, both, ruling)
        else:
            collapse += unshifted(series, solver, ruling)
    findings = _asked(series, collapse, COLLAPSE) + _asked(series, friction_findings(solved, ruled), FRICTION)
    return JudgedSeries(solved, ruled, shifted, findings)


def _asked(series: Series, found: Iterable[Finding], kind: str) -> tuple[Finding, ...]:
    """Those of a kind that are asked; what compares the dimensionalities is a kind of its own."""
    kinds = ((PAIRS if each.dimension == BOTH else kind, each) for each in found)
    return tuple(each for kind, each in kinds if kind in series.claims)
