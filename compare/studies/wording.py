"""Findings in words: what is claimed, what was measured, and both of its errors."""

from math import isfinite

from ..finding import Finding


def written(finding: Finding) -> str:
    """Value and the interval that holds both errors, in words."""
    if not isfinite(finding.value):
        return "not measured"
    low, high = finding.interval
    if not (isfinite(low) and isfinite(high)):
        return f"{number(finding.value)}, interval unknown"
    return f"{number(finding.value)} ({number(low)} to {number(high)})"


def errors(finding: Finding) -> str:
    """Both errors one by one, and the number of draws, in words."""
    draws = f"{finding.surfaces} draws" if finding.surfaces else "no roughness"
    if not isfinite(finding.value):
        return draws
    low, high = finding.statistical
    scatter = f"scatter {number(low)} to {number(high)}" if isfinite(low) and isfinite(high) else "scatter unknown"
    grid = f"± {finding.grid:.2g}" if isfinite(finding.grid) else "unknown"
    return ", ".join((draws, scatter, f"grid {grid}") if finding.surfaces else (draws, f"grid {grid}"))


def claimed(finding: Finding) -> str:
    """The number claimed and its tolerance."""
    return f"{finding.expected:.4g} ± {finding.tolerance:.2g}"


def number(value: float) -> str:
    """Three digits; what is not known says so."""
    return f"{value:.3g}" if isfinite(value) else "unknown"


def line(finding: Finding) -> str:
    """A finding in one line: verdict, claim, number with both errors, and why there is no verdict."""
    why = f"; {finding.undecidable}" if finding.undecidable else ""
    return (
        f"{finding.dimension:5s} {finding.verdict:9s}  {finding.claim}: {written(finding)}, "
        f"claimed {claimed(finding)} ({errors(finding)}{why})"
    )
