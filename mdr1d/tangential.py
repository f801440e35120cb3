"""Friction in the interface in one dimension: each normal spring has a tangential one, held by its load.

A spring of tangential stiffness G* = 4G/(2 - nu) per length, drawn by u, carries G* u until that is more than the
coefficient of friction times its normal force; from there on it slips. At rest the normal force is linear between
the nodes of the profile, so that everything is integrated exactly. Popov and Hess, Method of Dimensionality
Reduction in Contact Mechanics and Friction (2015), ch. 5.
"""

from dataclasses import dataclass, replace

import numpy as np

from scene import Result, Scene, SolveError
from scene.effects.terms import Rubbed
from scene.plan import Plan

from .term import Term

SPRINGS = 10  # arrays along the profile, while they are drawn


class Interface(Rubbed, Term):
    """Coulomb's friction: all of the contact slips in steady sliding, none at rest; `Drawn` is between the two."""

    def completed(self, result: Result) -> Result:
        return self.rubbed(result)


class Drawn(Term):
    """A contact at rest that is drawn along the surface: it sticks in part and slips in part."""

    def planned(self, plan: Plan, scene: Scene) -> Plan:
        springs = 8 * SPRINGS * plan.shape[0]
        return replace(plan, method=f"{plan.method}; then tangential springs", memory=plan.memory + springs)

    def completed(self, result: Result) -> Result:
        springs = Springs.of(result)
        stretch = springs.stretched(self.part)
        force, stick = springs.forces(stretch), springs.longer_than(stretch)
        touching = result.fields["contact"]
        held = np.minimum(springs.stretches, stretch)
        return replace(
            result,
            friction_force=result.friction_force + float(force.sum() * springs.pixel),
            measures={
                **result.measures,
                "friction_in_interface": float(force.sum() * springs.pixel),
                "tangential_displacement": stretch,
                "stick_length": stick,
                "slip_length": result.measures["contact_length"] - stick,
            },
            fields={
                **result.fields,
                "tangential_line_force": np.append(force, 0.0),
                "slip": np.where(touching, stretch - held, 0.0),
            },
        )


@dataclass(frozen=True)
class Springs:
    """Tangential springs along a profile.

    stiffness : G* [Pa]; pixel [m]
    stretches : with which they begin to slip, at the nodes [m]; below zero where the profile is clear of the
        surface, and linear between the nodes
    load : that friction holds, coefficient * F_N [N]
    """

    stiffness: float
    pixel: float
    stretches: np.ndarray
    load: float

    @classmethod
    def of(cls, result: Result) -> "Springs":
        """Under the contact of a result at rest."""
        solid, fields = result.scene.solid, result.fields
        stiffness = 4 * solid.static_modulus / (2 - solid.poisson_ratio)
        holding = result.scene.interface.coefficient * solid.indentation_modulus / stiffness
        # What touches is known to all digits, also where depth and profile are large and all but equal.
        clear = np.minimum(result.depth - fields["profile"], 0.0)
        overlap = np.where(fields["contact"], fields["displacement"], clear)
        load = result.scene.interface.coefficient * result.normal_force
        return cls(stiffness, result.measures["pixel"], holding * overlap, load)

    def forces(self, stretch: float) -> np.ndarray:
        """Mean force per length [N/m] between neighbouring nodes (N - 1,) of springs drawn so far [m]."""
        low, high = self._ends
        start, end = np.clip(low, 0.0, stretch), np.clip(high, 0.0, stretch)
        level = high == low
        span = np.where(level, 1.0, high - low)
        slipping, sticking = (end - start) / span, (high - np.maximum(low, end)) / span * (high > stretch)
        return self.stiffness * np.where(level, start, slipping * (start + (end - start) / 2) + sticking * stretch)

    def longer_than(self, stretch: float) -> float:
        """Length [m] along which springs slip only when drawn farther: what sticks."""
        low, high = self._ends
        share = (high - np.clip(stretch, low, high)) / np.where(high == low, 1.0, high - low)
        return float(np.where(high == low, high > stretch, share).sum() * self.pixel)

    def stretched(self, motion) -> float:
        """The displacement [m], given or under a force. Raises SolveError for a force that they do not hold."""
        if motion.displacement is not None:
            return motion.displacement
        if motion.force == 0:
            return 0.0
        if motion.force >= self.load:
            raise SolveError(
                f"motion.force = {motion.force:g} slides: all that friction holds is coefficient * load = "
                f"{self.load:g}; use Slide, or less"
            )
        return self._under(motion.force)

    def _under(self, force):
        """Between two nodes that slip one after the other the force is a parabola: exact to rounding."""
        nodes = np.unique(np.append(self.stretches[self.stretches > 0], 0.0))
        first, last = 0, len(nodes) - 1
        while last - first > 1:
            middle = (first + last) // 2
            first, last = (middle, last) if self._total(nodes[middle]) <= force else (first, middle)
        width, start = nodes[last] - nodes[first], self._total(nodes[first])
        rise = self.stiffness * self.longer_than(nodes[first]) * width  # did nothing slip in between
        missing, bend = (force - start) / rise, 1 - (self._total(nodes[last]) - start) / rise
        root = max(1 - 4 * bend * missing, 0.0)
        return float(nodes[first] + min(2 * missing / (1 + np.sqrt(root)), 1.0) * width)

    def _total(self, stretch):
        return float(self.forces(stretch).sum() * self.pixel)

    @property
    def _ends(self):
        """The lesser and the greater stretch of each two neighbours (N - 1,)."""
        pairs = self.stretches[:-1], self.stretches[1:]
        return np.minimum(*pairs), np.maximum(*pairs)
