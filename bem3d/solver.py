"""The three-dimensional solver: its settings, and what it answers."""

import time
from typing import Annotated

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from scene import Cylinder, Result, Scene, SolveError
from scene.protocol import refuse, trusted
from scene.quantities import CLOSED, Positive, Whole

from . import window
from .grid import Grid
from .problem import Problem


@dataclass(frozen=True, config=CLOSED)
class BEM:
    """Boundary elements on a free viscoelastic half-space under a rigid indenter, at rest or in steady sliding.

    points : along each side of a square grid, 16 to 8192
    extent : side of the square [m], around the indenter's axis; without it, the square is fitted to the contact
    tolerance : largest |gap| in contact and penetration outside it, over the depth of the indenter's lowest point
        below the undeformed surface; what is left is the `residual` of a result
    threads : of the Fourier transforms

    Result.friction_force joins two estimates from one pressure, of which each has its strength: by traction, the
    pressure times the indenter's slope, and by loss, the energy lost per length slid. Traction counts in
    proportion to the lag of the grid's shortest wave, 0 to 1: an elastic contact has some friction by traction on
    a coarse grid and none by loss; a fast Kelvin contact, singular at its edge, loses digits by loss alone.

    Result.measures: pixel [m], contact_area [m^2], contact_points, points_across_contact, friction_by_traction and
    friction_by_loss [N], whose difference indicates the error, rounds; of a rough indenter also rms_height [m],
    rms_slope (spectral, of the full gradient), each over a period, and points_per_shortest_wave.
    Result.fields: x, y (N,) [m] and pressure [Pa], gap [m] (N, N), rows along y.
    """

    points: Annotated[Whole, Field(ge=16, le=8192)] = 256
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
        with trusted():
            problem = Problem(scene, self.threads)
            grid, answer = self._windowed(problem) if self.extent is None else self._stated(problem)
            result = self._result(problem, grid, answer, started)
        if not np.isfinite([result.normal_force, result.friction_force, result.depth]).all():
            raise SolveError("forces beyond the range of numbers; check the units of the scene")
        return result

    def _stated(self, problem):
        grid = Grid(self.points, self.extent)
        answer = self._on(problem, grid)
        window.check(grid, answer)
        return grid, answer

    def _windowed(self, problem):
        grid = window.fitted(problem, self.points)
        for _ in range(window.ATTEMPTS):
            answer = self._on(problem, grid)
            better = window.improved(problem, grid, answer)
            if better is None:
                return grid, answer
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
        traction = float(-np.sum(pressure * problem.slopes(grid, surface)) * pixel**2)
        loss = problem.lost(grid, pressure)
        lag = problem.flow.lag(grid)
        measures = {
            "pixel": pixel,
            "contact_area": float(contact_points * pixel**2),
            "contact_points": float(contact_points),
            "points_across_contact": float(grid.box(pressure > 0).side / pixel),
            "friction_by_traction": traction,
            "friction_by_loss": loss,
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
            friction_force=lag * traction + (1 - lag) * loss,
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
