"""The three-dimensional solver: its settings, and what it answers."""

import time
from typing import Annotated

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from scene import Cylinder, Result, Scene, SolveError
from scene.protocol import refuse
from scene.quantities import CLOSED, Positive, Whole

from . import window
from .grid import Grid
from .problem import Problem


@dataclass(frozen=True, config=CLOSED)
class BEM:
    """Boundary elements on a free viscoelastic half-space under a rigid indenter, at rest or in steady sliding.

    points : along each side of a square grid, 16 or more
    extent : side of the square [m], around the indenter's axis; without it, the square is fitted to the contact
    tolerance : largest |gap| in contact and penetration outside it, over the depth of the indenter's lowest point
        below the undeformed surface; what is left is the `residual` of a result
    threads : of the Fourier transforms
    """

    points: Annotated[Whole, Field(ge=16)] = 256
    extent: Positive | None = None
    tolerance: Annotated[Positive, Field(ge=1e-12, le=1e-2)] = 1e-5
    threads: Annotated[Whole, Field(ge=1)] = 1

    @property
    def name(self) -> str:
        return "BEM"

    def refusals(self, scene: Scene) -> list[str]:
        """Why the scene cannot be solved."""
        reasons = []
        if isinstance(scene.indenter, Cylinder):
            reasons.append("indenter = Cylinder makes a line contact of infinite load; take a body of revolution")
        if self.extent is not None:
            reasons += _unresolved(scene, Grid(self.points, self.extent))
        return reasons

    def solve(self, scene: Scene) -> Result:
        """Pressure, gap and forces. Raises Refused, or SolveError where the result could not be trusted."""
        refuse(self, scene)
        started = time.process_time()
        problem = Problem(scene, self.threads)
        if self.extent is not None:
            grid = Grid(self.points, self.extent)
            answer = self._on(problem, grid)
            window.check(grid, answer)
            return self._result(problem, grid, answer, started)
        grid = window.fitted(problem, self.points)
        for _ in range(window.ATTEMPTS):
            answer = self._on(problem, grid)
            better = window.improved(problem, grid, answer)
            if better is None:
                return self._result(problem, grid, answer, started)
            grid = better
        raise SolveError(f"no window holds the contact, the last was {grid.extent:g} m wide; state an extent")

    def _on(self, problem, grid):
        if reasons := _unresolved(problem.scene, grid):
            raise SolveError("; ".join(reasons))
        return problem.solve(grid, self.tolerance)

    def _result(self, problem, grid, answer, started):
        scene, surface, pixel = problem.scene, problem.surface(grid), grid.pixel
        pressure = answer.pressure * problem.flow.modulus
        contact_points = np.count_nonzero(pressure)
        measures = {
            "pixel": pixel,
            "contact_area": float(contact_points * pixel**2),
            "contact_points": float(contact_points),
            "points_across_contact": float(grid.box(pressure > 0).side / pixel),
            "friction_by_loss": problem.lost(grid, pressure),
            "rounds": float(answer.rounds),
        }
        if surface is not None:
            measures |= {
                "rms_height": surface.rms_height,
                "rms_slope": surface.rms_slope,
                "points_per_shortest_wave": float(2 * np.pi / scene.roughness.q_max(pixel) / pixel),
            }
        cutoff = None if surface is None else "resolved" if scene.roughness.shortest else "nyquist"
        return Result(
            scene=scene,
            solver=self.name,
            settings={
                "points": self.points,
                "extent": grid.extent,
                "centre": grid.centre,
                "tolerance": self.tolerance,
                "threads": self.threads,
                "cutoff": cutoff,
            },
            normal_force=float(pressure.sum() * pixel**2),
            depth=answer.depth * pixel,
            friction_force=float(-np.sum(pressure * problem.slopes(grid, surface)) * pixel**2),
            residual=answer.violation,
            applications=problem.work / grid.points**2,
            seconds=time.process_time() - started,
            measures=measures,
            fields={"x": grid.x, "y": grid.y, "pressure": pressure, "gap": answer.gap * pixel},
        )


def _unresolved(scene, grid):
    """Why the grid cannot carry the roughness, if it cannot."""
    rough = scene.roughness
    if rough is None or rough.shortest is None or 2 * grid.pixel <= rough.shortest:
        return []
    least = int(np.ceil(2 * grid.extent / rough.shortest))
    return [
        f"roughness.shortest = {rough.shortest:g} m is less than two pixels of {grid.pixel:g} m; "
        f"points = {least} would carry it, {4 * least} resolve it"
    ]
