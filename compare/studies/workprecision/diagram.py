"""A diagram: contacts solved along ladders of settings, the findings on them, their plots and tables."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

import xarray

from ...library.ready import DIAGRAMS
from ...report.page import Plot, Table
from ...statistics.finding import Claim, Finding
from .convergence import Convergence
from .ensemble import Ensemble


@dataclass(frozen=True)
class Judged:
    """What the Datasets of a diagram come to."""

    findings: Sequence[Finding] = ()
    tables: Sequence[Table] = ()
    plots: Sequence[Plot] = ()


@dataclass(frozen=True)
class Diagram:
    """Diagram: measurements and findings of the command under one name.

    name : of library.ready.DIAGRAMS, and of files
    contacts : at a size
    judge : function of the Datasets of all contacts
    """

    name: str
    contacts: Callable[[str], Sequence[Convergence | Ensemble]]
    judge: Callable[[xarray.DataTree], Judged]

    @property
    def title(self) -> str:
        """Title for people."""
        return DIAGRAMS[self.name].title


def reported(
    id: str,
    sentence: str,
    value: float,
    where: str = "",
    unit: str = "1",
    dimension: str = "3D",
    missing: str = "",
    meaning: str = "",
    **more: Any,
) -> Finding:
    """Finding of a number that is reported without a claim. missing : why, where it is not known"""
    claim = Claim(f"workprecision.{id}", sentence, meaning=meaning, unit=unit, dimension=dimension)
    return Finding(claim, value, where=where, reason="" if isfinite(value) else missing, **more)
