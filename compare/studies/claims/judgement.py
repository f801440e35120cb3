"""Judgement of one series: laws, shifts of its curves, and what becomes of each claim in 1D and in 3D."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ...statistics.collapse import Collapse
from ...statistics.finding import Finding
from .claims_depth import depth_findings, rest_findings
from .claims_friction import collapses, friction_findings, shift_findings
from .claims_law import law_findings
from .laws import Laws, laws
from .series import COLLAPSE, DEPTH, FRICTION, PAIRS, SOLVERS, Contacts, Series


@dataclass(frozen=True)
class JudgedSeries:
    """One series, judged.

    contacts : its answers
    laws : by solver's name; empty of a series that does not slide, or of which a solver has no rough answer
    collapses : by solver's name, what shifts of its curves achieve on the fine grid; a solver with too few points
        is missing
    findings : what each claim comes to
    """

    contacts: Contacts
    laws: Mapping[str, Laws]
    collapses: Mapping[str, Collapse]
    findings: tuple[Finding, ...]

    @property
    def series(self) -> Series:
        """Series that was judged."""
        return self.contacts.series


def judge_series(contacts: Contacts) -> JudgedSeries:
    """Findings on one series, for the claims that it asks for."""
    series = contacts.series
    if not series.slides:
        return JudgedSeries(contacts, {}, {}, _asked(series, depth_findings(contacts), DEPTH))
    found = {each.name: laws(contacts, each.name) for each in series.models if FRICTION in each.answers}
    ruled = {solver: each for solver, each in found.items() if each is not None}
    reference = series.models.reference
    if reference not in ruled or not set(found) & set(SOLVERS) <= set(ruled):
        return JudgedSeries(contacts, {}, {}, ())
    shifted: dict[str, Collapse] = {}
    shifts: list[Finding] = []
    for solver, each in ruled.items():
        both = collapses(contacts, solver)
        if both is not None:
            shifted[solver] = both[0]
        shifts += shift_findings(contacts, solver, both, each)
    shifts += law_findings(contacts, ruled)
    friction = [*friction_findings(contacts, ruled), *rest_findings(contacts, ruled[reference].words())]
    findings = _asked(series, shifts, COLLAPSE) + _asked(series, friction, FRICTION)
    return JudgedSeries(contacts, ruled, shifted, findings)


def _asked(series: Series, found: Iterable[Finding], kind: str) -> tuple[Finding, ...]:
    """Findings of a kind that is asked; what compares the dimensionalities is a kind of its own."""
    kinds = ((PAIRS if "/" in each.dimension else kind, each) for each in found)
    return tuple(each for kind, each in kinds if kind in series.claims)
