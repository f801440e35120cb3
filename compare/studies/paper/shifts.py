"""Figs. 5 to 7: friction against load at many speeds, shifted along the load.

The measured data were never published. The friction shifted here is simulated, on a solid whose loss is a power
of the frequency, Eq. 24.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
import xarray

from mdr1d import equations

from ...figures import collapse as figure
from ...figures.plot import Plot
from ...solving.curve import FINE, Curve
from ...statistics import eq23
from ...statistics.collapse import Collapse, collapse
from ...statistics.finding import FAILS, Finding
from ...statistics.frictioncurves import SimulatedCurves
from . import parameters

WHOLE, ROUGH = "whole friction", "less smooth body"
CLAIMS = (eq23.COLLAPSE.id, eq23.PREDICTED.id, eq23.EXPONENT.id)
MEANINGLESS = "the curves do not collapse, and their shifts have no meaning"


@dataclass(frozen=True)
class Rubber:
    """A rubber of Figs. 5 to 7, G = G_0 (1 + (i omega tau)^beta): the exponent beta and the time tau [s]."""

    exponent: float
    relaxation_time: float

    @property
    def name(self) -> str:
        """Ending of the names of files and grids."""
        return f"{self.exponent:g}-{self.relaxation_time:g}"

    @property
    def shift(self) -> float:
        """Exponent of the shifts against the speed that is expected, -beta (n+1)/n."""
        return equations.force_shift_exponent(self.exponent, parameters.SHAPES["sphere"].exponent)

    def where(self, of: str) -> str:
        """The rubber and what of its friction is shifted, in words."""
        return f"β = {self.exponent:g}, τ = {self.relaxation_time:g} s, {of}"

    def grids(self, profiles: int) -> dict[str, Curve]:
        """Contacts at each speed and load: rough, and of the smooth body."""
        scene = parameters.lossy(self.exponent, self.relaxation_time)
        few = min(profiles, parameters.LOSS_PROFILES)
        rough = parameters.grid(scene, parameters.SPEEDS, parameters.FORCES, few)
        smooth = replace(rough, scene=replace(scene, roughness=None))
        return {f"loss-{self.name}": rough, f"loss-{self.name}-smooth": smooth}

    def collapses(self, rough: xarray.Dataset, smooth: xarray.Dataset) -> dict[str, Collapse]:
        """Collapse, by shifts along the load, of the whole friction and of its excess over the smooth body."""
        whole, body = (SimulatedCurves.of(each.sel(level=FINE)) for each in (rough, smooth))
        of_body = (body.friction_force / body.load)[..., None] * whole.load
        excess = replace(whole, friction_force=whole.friction_force - of_body)
        return {WHOLE: collapse(whole), ROUGH: collapse(excess)}

    def findings(self, collapses: Mapping[str, Collapse]) -> Iterator[Finding]:
        """Whether curves fall onto one, if shifted as expected too, and the exponent of their shifts."""
        for of, found in collapses.items():
            middle, collapsed = found.speeds[found.speeds.size // 2], ""
            for each in eq23.findings(
                found,
                None,
                "1D",
                shifts=self.shift * np.log(found.speeds / middle),
                exponent=self.shift,
                where=self.where(of),
                horizontal=True,
            ):
                if each.claim.id == eq23.COLLAPSE.id:
                    collapsed = each.verdict
                if each.claim.id == eq23.EXPONENT.id and collapsed == FAILS:
                    each = replace(each, reason=MEANINGLESS)
                if each.claim.id in CLAIMS:
                    yield each

    def plot(self, collapses: Mapping[str, Collapse], findings: list[Finding]) -> Plot | None:
        """Curves as they are and shifted, and the shifts."""
        rows = [
            figure.ShiftedCurves(
                title=self.where(of),
                collapse=found,
                findings={each.claim.id: each for each in findings if each.where == self.where(of)},
                expected=self.shift,
            )
            for of, found in collapses.items()
        ]
        return figure.plot(rows, f"shifted-curves-{self.name}")


RUBBERS = [Rubber(*each) for each in parameters.LOSSES]
