"""The three-dimensional solver: its settings and its result."""

import logging
import time
from dataclasses import replace
from functools import partial
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field, model_validator
from pydantic.dataclasses import dataclass

from scene import Cylinder, Doubt, Plane, Program, Result, Scene, SolveError, doubts
from scene.plan import Plan
from scene.protocol import numeric_guard, refuse, shortage
from scene.quantities import CLOSED, Length, Positive, Whole
from scene.terms import Table, refused_parts, terms_of, wrap_solve

from . import window
from .friction import bound
from .grid import Grid
from .measures import measured
from .motion.history import marched
from .plan import likely_grid, plan_of
from .problem import Problem
from .response.engine import Engine
from .response.transforms import Library
from .terms import TERMS
from .warmstart import WarmStart

_LOG = logging.getLogger(__name__)
LOOSEST = 1e-2  # tolerance
LEAST_SINGLE = 1e-5  # tolerance that transforms in single precision still reach
LEAST_GAP = 1e-2  # of a prescribed mean gap: what may be left uncertain of it


@dataclass(frozen=True, config=CLOSED)
class BEM:
    """Boundary elements on a viscoelastic half-space or layer under a rigid indenter: at rest, sliding, in time.

    A body of revolution presses on a free surface, a Cylinder on a free line, a Plane on a cell that repeats.

    points : along each side of a square grid, or along a line, 16 to 16384
    extent : side of the square [m], around the indenter's axis; without it, the square is fitted to the contact.
        The cell of a Plane is the period of its roughness
    tolerance : largest |gap| in contact and penetration outside it, over the depth of the indenter's lowest point
        below the undeformed surface, or what its heights span in contact where that is more; what is left is the
        `residual` of a result. Sliding on a single row is solved to 1e-7 at least
    threads : that share the products in Fourier space; an answer keeps its digits whatever their number
    precision : of the transforms; in single they are up to 1.5 times faster, need half the memory, and leave 1e-6
        of the largest displacement as noise in the gap; single rows are always solved in double
    transforms : library of the transforms: ducc0 or fftw
    steps : in time, of the whole of a Program; while it slides, a step is a pixel of path at most
    frames : instants of a Program, alike apart, at which the contact is kept in the fields

    Result.friction_force combines three estimates from the pressure: by traction, the pressure times the
    indenter's slope; by loss, the energy lost per length slid; and by curvature, the first order in the speed.
    Traction counts in proportion to the lag of the grid's shortest wave, 0 to 1: an elastic contact has some
    friction by traction on a coarse grid and none by loss; a fast Kelvin contact, singular at its edge, loses
    digits by loss alone. Curvature counts where the contact lags by less than a quarter of a pixel: there loss
    comes from short waves, which a grid hardly shows near edges.

    >>> from bem3d import BEM
    >>> from scene import Kelvin, Scene, Slide, Sphere
    >>> solid = Kelvin(modulus=1e6, relaxation_time=1e-3)
    >>> answer = BEM(points=64).solve(Scene(Sphere(radius=10e-3), solid, Slide(speed=0.1, load=1.0)))
    >>> print(f"{1e3 * answer.depth:.3f} mm, {answer.friction_coefficient:.4f}")
    0.152 mm, 0.0095

    Result.operator_applications counts operator applications, Result.measures["transform_pairs"] those of the
    preconditioner too, both in equivalents of the finest grid.
    Result.measures: pixel [m], contact_area [m^2], contact_points, points_across_contact, spot_radius [m] (of a
    disc with the area over rim of the contact), rounds, transform_pairs;
    friction_error, a bound of 95 % on the relative error of friction by the grid, against the same surface on ever
    finer grids, absent without friction; curvature_by_pressure [1/m], the mean of d2z/dx2 of indenter and
    roughness weighted with the pressure: at rest it is mu at low speed over that speed and the mean lag of the
    elastomer; friction_by_traction, friction_by_loss, friction_by_work, friction_by_curvature [N]: by the
    indenter's slope, by the slope of the displacement, by the work done on the surface from pixel to pixel, to
    first order in the speed;
    friction_disagreement, what the second differs from the third, or from the first and the last as far as
    these count, over the normal force: an indicator of the error of mu. Of a rough indenter also rms_height
    [m], rms_slope (spectral, of the full gradient), each over a period, rms_slope_contact (along x, of indenter
    and roughness over the real contact), and points_per_shortest_wave; of a
    Plane mean_pressure [Pa], mean_gap [m], contact_fraction.
    Result.fields: x (N,), y (M,) [m]; height [m] of indenter and roughness at the pixels' centres, see
    `bem3d.heights`; pressure [Pa], gap [m] (M, N), rows along y; M is N, or 1 where nothing varies along y.
    Of a Program also time [s], path [m], speed [m/s], depth [m], normal_force, friction_force,
    friction_by_work [N] and contact_area [m^2] in the middle of each step (steps,); the result's own forces and
    depth are those of the last, by traction. x moves with the material, and is where the gap is measured at the
    end, as is surface_displacement [m], into the elastomer (M, N). Depth and gap are NaN where a load of zero
    leaves nothing in contact. Path, speed and the friction that opposes them are below zero backwards. Its
    measures are of the last step; of friction by_traction and by_work alone, the second NaN at rest; rounds of all
    steps; and time_steps; no curvature_by_pressure. With `frames` also, at the steps nearest to these instants,
    the last of them at the end: frame_time [s], frame_depth [m], NaN where nothing presses, frame_shift [m], by
    which the points are then downstream of x, (F,); frame_pressure [Pa] and frame_displacement [m] of the surface
    into the elastomer (F, M, N). Time, depth and shift are those at which the gap is measured.

    With Coulomb friction in the interface, in sliding: measures friction_in_elastomer, friction_in_interface [N],
    which together are the friction. Under a Shear: friction_force is the tangential force; measures
    friction_in_interface, tangential_displacement [m], stick_area, slip_area [m^2], tangential_residual (slip
    where it sticks and slip across the traction where it slips, over the displacement; or the misfit of the force
    if that is more), tangential_applications, also part of Result.operator_applications, tangential_rounds; fields
    traction_x, traction_y [Pa], on the indenter, and slip_x, slip_y [m], of the elastomer past it, zero outside
    the contact; those along y only where a traction along x also displaces along y.
    """

    terms: ClassVar[Table] = TERMS

    points: Annotated[Whole, Field(ge=16, le=16384)] = 256
    extent: Length | None = None
    tolerance: Annotated[Positive, Field(ge=1e-12, le=LOOSEST)] = 1e-5
    threads: Annotated[Whole, Field(ge=1, le=1024)] = 1
    precision: Literal["double", "single"] = "double"
    transforms: Library = "ducc0"
    steps: Annotated[Whole, Field(ge=1, le=10**6)] = 200
    frames: Annotated[Whole, Field(ge=0, le=10**4)] = 0

    @model_validator(mode="after")
    def _within_precision(self):
        if self.precision == "single" and self.tolerance < LEAST_SINGLE:
            raise ValueError(
                f"tolerance = {self.tolerance:g} cannot be reached in single precision: at least {LEAST_SINGLE:g}"
            )
        return self

    @property
    def name(self) -> str:
        return "BEM"

    @property
    def engine(self) -> Engine:
        """Engine of the products in Fourier space."""
        return Engine(self.transforms, self.threads, self.precision)

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why the scene cannot be solved."""
        reasons = refused_parts(self.terms, scene)
        if isinstance(scene.indenter, Cylinder) and scene.roughness is not None:
            reasons.append("a rough Cylinder is no line contact: leave roughness out, or take a Sphere or a Plane")
        if isinstance(scene.indenter, Plane):
            if self.extent is not None:
                reasons.append(f"extent = {self.extent:g} m: the cell of a Plane is the period of its roughness")
            reasons += window.unresolved(scene, Grid(self.points, scene.roughness.period))
        elif self.extent is not None:
            reasons += window.unresolved(scene, Grid(self.points, self.extent))
        return reasons or shortage(plan_of(self, scene, priced=False).memory)

    def foreseen(self, scene: Scene) -> list[str]:
        """Reasons why a solve would fail although the scene is not refused, as far as a coarse contact shows.

        One is solved only where the widest window there can be leaves a doubt, and not for a Program.
        """
        if isinstance(scene.indenter, Plane) or isinstance(scene.motion, Program):
            return []
        return window.foreseen(Problem(scene, self.engine, self.terms), self.points, self.extent)

    def doubts(self, scene: Scene) -> tuple[Doubt, ...]:
        """Doubts about a scene, and how well a grid of the likely window shows it; nothing is solved."""
        try:
            grid = likely_grid(self, scene)
            return *doubts(scene, grid.pixel), *window.doubts(scene, grid)
        except ArithmeticError:
            return doubts(scene)

    def plan(self, scene: Scene) -> Plan:
        """Plan of a scene: the parts that would be simulated, and their costs; nothing is solved.

        Raises Refused as `solve` does, and SolveError for a program of too many steps or lengths beyond the range
        of numbers. For which other reasons a solve would fail, as far as that shows beforehand, `foreseen` says.
        """
        refuse(self, scene)
        with numeric_guard():
            return replace(plan_of(self, scene), doubts=self.doubts(scene))

    def solve(self, scene: Scene, warm_start: WarmStart | None = None) -> Result:
        """Solve the scene for pressure, gap and forces.

        Raises Refused, SolveError where the result could not be trusted, OutOfMemory where memory ran out.

        warm_start : contacts of the same body and surface, at other speeds and loads or on other grids. The solve
            begins where they were and adds its own contact; the answer is the same to the tolerance. A Program
            ignores it
        """
        refuse(self, scene)
        solve = partial(self._solved, warm_start=warm_start)
        with numeric_guard():
            result = wrap_solve(solve, terms_of(self.terms, scene))(scene)
        if not np.isfinite([result.normal_force, result.friction_force]).all():
            raise SolveError("forces beyond the range of numbers; check the units of the scene")
        _LOG.info("answered with %s", result.settings)
        return result

    def _solved(self, scene, warm_start):
        started = time.process_time()
        return (
            marched(self, scene, started)
            if isinstance(scene.motion, Program)
            else self._steady(scene, warm_start, started)
        )

    def _steady(self, scene, warm_start, started):
        problem, warm_start = Problem(scene, self.engine, self.terms), warm_start or WarmStart()
        warm_start.set_scene(scene)
        grid, answer = self._answer(problem, warm_start)
        warm_start.leave(problem.start(grid, answer.pressure))
        return problem.completed(self._result(problem, grid, answer, started), grid)

    def _answer(self, problem, warm_start):
        start, neighbour = warm_start.coarser(self.points), warm_start.neighbour(self.points)
        repeats = isinstance(problem.scene.indenter, Plane)
        if not repeats and self.extent is None:
            return self._windowed(problem, warm_start.placed(problem, self.points), start, neighbour)
        extent = problem.scene.roughness.period if repeats else self.extent
        grid = Grid(self.points, extent, width=problem.width)
        answer = self._on(problem, grid, start, neighbour)
        window.check(problem.scene, grid, answer.pressure > 0, repeats)
        if repeats:
            _check_gap(problem.scene.motion.gap, grid, answer)
        return grid, answer

    def _windowed(self, problem, placed, start, neighbour):
        grid = placed.grid(self.points, problem.width)
        if start is None or (placed.start is not None and placed.start.grid.points > start.grid.points):
            start = placed.start
        for _ in range(window.ATTEMPTS):
            answer = self._on(problem, grid, start, neighbour)
            better = window.improved(problem, grid, answer)
            if better is None:
                return grid, answer
            _LOG.debug("the contact does not fit a window %.3g m wide: %.3g m next", grid.extent, better.extent)
            grid, start, neighbour = better, None, None
        raise SolveError(f"no window holds the contact, the last was {grid.extent:g} m wide; state an extent")

    def _on(self, problem, grid, start, neighbour):
        window.check_waves(problem.scene, grid, self.extent)
        return problem.solve(grid, self.tolerance, start, neighbour)

    def _result(self, problem, grid, answer, started):
        pressure = answer.pressure * problem.flow.modulus
        friction, estimates = bound.on_grid(problem, grid, pressure, answer.violation, problem.lost)
        return Result(
            scene=problem.scene,
            solver=self.name,
            settings=self.settings(problem, grid),
            normal_force=float(pressure.sum() * grid.patch),
            depth=answer.depth * grid.pixel,
            friction_force=friction.force,
            residual=answer.violation,
            operator_applications=problem.work / (grid.points * grid.rows),
            seconds=time.process_time() - started,
            measures={
                **measured(problem, grid, pressure, answer.gap * grid.pixel),
                **estimates,
                "rounds": float(answer.rounds),
                "transform_pairs": problem.transforms / (grid.points * grid.rows),
            },
            fields={
                "x": grid.x,
                "y": grid.y,
                "height": problem.heights(grid, problem.surface(grid)),
                "pressure": pressure,
                "gap": answer.gap * grid.pixel,
            },
        )

    def settings(self, problem: Problem, grid: Grid) -> dict:
        """Settings of the solve, derived ones included."""
        rough = problem.scene.roughness
        return {
            "points": self.points,
            "extent": grid.extent,
            "centre": grid.centre,
            "tolerance": self.tolerance,
            "threads": self.threads,
            "precision": problem.engine.precision,
            "transforms": self.transforms,
            "cutoff": None if problem.surface(grid) is None else "resolved" if rough.shortest else "nyquist",
        }


def _check_gap(gap, grid, answer):
    """Raise SolveError where the residual is not small against a prescribed mean gap [m]."""
    left = answer.violation * (answer.depth - answer.lowest) * grid.pixel
    if gap is not None and left > LEAST_GAP * gap:
        raise SolveError(
            f"motion.gap = {gap:g} m is so close to full contact that the residual of {left:.1e} m decides the "
            f"pressure; prescribe the pressure, or take a tolerance {left / gap / LEAST_GAP:.0f} times smaller"
        )
