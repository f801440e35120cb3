"""Friction in the interface: what it adds to sliding, and contacts drawn along the surface, which slip in part.

The pressure comes first and stays. That is exact at nu = 1/2, where tangential tractions leave the surface flat,
and Goodman's approximation elsewhere. Tractions then follow from `stickslip`.
"""

import time
from dataclasses import replace
from itertools import pairwise

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from scene import Plane, Result, Scene, SolveError
from scene.effects.terms import Rubbed
from scene.plan import Kernel, Plan

from ..grid import Grid
from ..response import cerruti
from ..response.engine import Engine
from ..spots import Spots
from ..term import Term
from . import stickslip
from .activeset import NotConverged

COARSEST = 32  # points a side of the grid where a solve starts, as for the pressure
COARSE_TOLERANCE = 1e-3  # on all grids but the finest
SINGLE, PAIRED, VECTORS = 22, 32, 10  # held with one component and with two: planes, and vectors of each component
SLIPS = 0.5  # share of the neighbours on a coarse grid that slip, from which on a point is expected to
NEAR, FAR = 1e-30, 1e20  # displacements below and above which tractions are, to rounding, those at the bound
LARGE = 1e100  # limit over the tractions that are needed, which is none any more; its square is a number
LEAST = 5e-324  # above zero
MOST = 8192  # points in contact between which there are matrices: four of them take 2 GiB


class Interface(Rubbed, Term):
    """Coulomb's friction: all of the contact slips in steady sliding, none at rest; `Drawn` is between the two."""

    def completed(self, result: Result, problem, grid: Grid) -> Result:
        return self.rubbed(result)


class Drawn(Term):
    """A contact at rest that is drawn along the surface: it sticks in part and slips in part."""

    def planned(self, plan: Plan, scene: Scene) -> Plan:
        if not (self.part.displacement or self.part.force) or not scene.interface.coefficient:
            return plan
        (rows, points), components = plan.shape, _components(scene, plan.shape[0])
        form = "symbol" if isinstance(scene.indenter, Plane) else "kernel"
        if components == 1:
            width = points if form == "symbol" else 2 * points
            name = "tractions: the kernel of the pressure, built again"
            kernels, products = (Kernel(name, form, (rows, width)),), SINGLE
        else:
            kernels, products = (Kernel("tractions: xx, xy, yy", form, (3, *plan.shape)),), PAIRED
        # Of each point tractions, slip and products of both; of half of them, in contact, vectors of tractions.
        values = products * rows * points + VECTORS * components * round(rows * points / 2)
        return replace(
            plan,
            method=f"{plan.method}; then Newton's steps on sets of slip",
            kernels=(*plan.kernels, *kernels, Kernel("tractions, approximate inverse", "symbol", plan.shape)),
            memory=max(plan.memory, 8 * values),
        )

    def refusals(self, scene: Scene) -> list[str]:
        if scene.layer is not None:
            return ["motion = Shear: tangential kernels are those of a half-space; leave layer out, or use Slide"]
        return []

    def completed(self, result: Result, problem, grid: Grid) -> Result:
        started = time.process_time()
        tangential = (
            Between(problem, grid, result) if isinstance(grid, Spots) else Tangential(problem, grid, result)
        )
        found = tangential.solved(self.part)
        return replace(
            result,
            friction_force=result.friction_force + tangential.friction(found),
            operator_applications=result.operator_applications + tangential.work,
            seconds=result.seconds + time.process_time() - started,
            measures={
                **result.measures,
                **tangential.measures(found),
                "transform_pairs": result.measures["transform_pairs"] + tangential.transforms,
            },
            fields={**result.fields, **tangential.fields(found)},
        )


class Tangential:
    """Tractions under the pressure of a result. `work`, `transforms`: in equivalents of the finest grid.

    Tractions are in units of the relaxed E* times `_unit`, displacements in pixels times it, so that they are of
    order one, or of the order of the displacement. The coefficient is in `_unit` alone: multiplied by a number,
    together with displacement or force, it multiplies the answer.
    """

    def __init__(self, problem, grid: Grid, result: Result):
        scene = problem.scene
        self._problem, self._grid, self._modulus = problem, grid, problem.flow.modulus
        self._engine = problem.engine
        self._tolerance, self._touched = result.settings["tolerance"], result.fields["pressure"] > 0
        self._greatest = result.fields["pressure"].max()
        self._shares = result.fields["pressure"] / self._greatest
        self._load, self._coefficient = result.normal_force, scene.interface.coefficient
        self._components = _components(scene, grid.rows)
        self._unit, self._beyond = 1.0, 0.0
        self.work = self.transforms = 0.0

    def solved(self, motion) -> stickslip.Traction:
        """Tractions by a displacement or a force. Raises SolveError."""
        if not (motion.displacement or motion.force):
            return self._uniform(0.0)
        most = self._coefficient * self._load
        if motion.force is not None and motion.force >= most * (1 - stickslip.ROUNDING):
            raise SolveError(
                f"motion.force = {motion.force:g} slides: all that friction holds is coefficient * load = "
                f"{most:g}; use Slide, or less"
            )
        held = float(self._coefficient * (self._greatest / self._modulus))
        if held == 0:
            return self._uniform(motion.displacement / self._grid.pixel)
        try:
            return self._pulled(motion.force, held) if motion.force else self._drawn(motion.displacement, held)
        except NotConverged as error:
            raise SolveError(
                f"no converged tractions on {self._grid.points} x {self._grid.rows} points: {error}; take a "
                'larger tolerance, more points, or precision = "double"'
            ) from error

    def _drawn(self, displacement, held):
        """Tractions by a displacement [m]; held : greatest limit over E*."""
        wanted = max(displacement / float(self._grid.pixel), LEAST)
        # A cell that touches everywhere moves freely with its mean, up to limits, be it drawn ever so little.
        limits = self._limits(held, held if self._shares.all() else wanted)
        drawn = min(max(wanted / self._unit, NEAR), FAR)
        self._beyond = displacement - drawn * self._length if drawn == FAR else 0.0
        return self._descended(limits, drawn, None)

    def _pulled(self, force, held):
        """Tractions by a force [N]."""
        wanted = max(force / float(self._modulus * self._grid.patch), LEAST)
        limits = self._limits(held, wanted)
        return self._descended(limits, None, wanted / self._unit)

    def _limits(self, held, wanted):
        """Limits of the traction, in a unit chosen from the greatest limit and the wanted number, both over E*."""
        self._unit = min(held, wanted)
        return self._shares * min(held / self._unit, LARGE)

    def friction(self, found: stickslip.Traction) -> float:
        """Tangential force [N]."""
        return float(found.traction[0].sum() * self._pressure * self._grid.patch)

    def measures(self, found: stickslip.Traction) -> dict[str, float]:
        """Measures of a result by name."""
        slipping = int(np.count_nonzero(found.slipping))
        return {
            "friction_in_interface": self.friction(found),
            "tangential_displacement": self._displacement(found),
            "stick_area": float((np.count_nonzero(self._touched) - slipping) * self._grid.patch),
            "slip_area": float(slipping * self._grid.patch),
            "tangential_residual": found.violation,
            "tangential_applications": self.work,
            "tangential_rounds": float(found.rounds),
        }

    def fields(self, found: stickslip.Traction) -> dict[str, np.ndarray]:
        """Fields of a result by name: traction [Pa] and slip [m], where it touches."""
        traction, slip = self._pressure * found.traction, self._length * found.slip
        slip[0] += self._beyond * found.slipping
        return {f"traction_{axis}": plane for axis, plane in zip("xy", traction, strict=False)} | {
            f"slip_{axis}": plane for axis, plane in zip("xy", slip, strict=False)
        }

    def _displacement(self, found):
        """Displacement [m]: as prescribed, or as caused by the prescribed force."""
        given = self._problem.scene.motion.displacement
        return found.displacement * self._length if given is None else given

    @property
    def _pressure(self):
        """Pressure of a unit traction [Pa]."""
        return self._unit * self._modulus

    @property
    def _length(self):
        """Length of a unit displacement [m]."""
        return self._unit * self._grid.pixel

    def _uniform(self, displacement):
        """No traction: all of the contact goes with the indenter, or slips if there is nothing to hold it."""
        slip = displacement * self._touched
        return stickslip.Traction(np.zeros_like(slip)[None], slip[None], slip > 0, displacement, 0.0, 0)

    def _descended(self, limit, displacement, force):
        """Tractions on the finest grid, solved from the coarsest on, each grid started from the one before.

        displacement : in pixels of the finest
        """
        grids, limits = self._grid.ladder(COARSEST), [limit]
        for finer, coarser in pairwise(grids):
            limits.append(coarser.resampled_contact(limits[-1], finer))
        coarse, drawn = None, displacement
        for grid, limit in zip(reversed(grids), reversed(limits), strict=True):
            finest, pixel = grid is self._grid, grid.pixel / self._grid.pixel
            share = None if force is None else force * limit.sum() / limits[0].sum()
            tolerance = self._tolerance if finest else max(self._tolerance, COARSE_TOLERANCE)
            try:
                found = self._on(grid, limit, coarse, tolerance, None if drawn is None else drawn / pixel, share)
                coarse, drawn = (grid, found), displacement or found.displacement * pixel
            except NotConverged:
                if finest:
                    raise
                coarse, drawn = None, displacement  # what sticks may be less than a pixel of the coarse grid
        return found

    def _on(self, grid, limits, coarse, tolerance, displacement, force):
        operator, inverse = self._operators(grid)
        if coarse is None:
            start = np.zeros((self._components, *grid.shape))
            start[0] = 0.0 if force is None else limits * (force / limits.sum())
        else:
            start = _carried_over(*coarse, grid, limits)
        try:
            return stickslip.solve(operator, inverse, limits, start, tolerance, displacement, force)
        finally:
            share = grid.points * grid.rows / (self._grid.points * self._grid.rows)
            self.work += share * operator.operator_applications
            self.transforms += share * (operator.operator_applications + inverse.operator_applications)

    def _operators(self, grid):
        """Tractions -> displacements, and an approximate inverse."""
        scene, engine = self._problem.scene, self._engine
        if self._components == 1:
            medium = self._problem.bare
            inverse = medium.preconditioner(grid)
            return Alone(medium.operator(grid)), Alone(inverse)
        kernel = cerruti.periodic if isinstance(scene.indenter, Plane) else cerruti.free
        nu = scene.solid.poisson_ratio
        return kernel(grid, nu, engine), cerruti.preconditioner(grid, nu, engine)


class Between(Tangential):
    """Tractions between pixels in contact alone, by matrices of the kernels."""

    def __init__(self, problem, grid: Spots, result: Result):
        super().__init__(problem, grid, result)
        self._engine = Engine()
        if len(grid.row) > MOST:
            raise SolveError(
                f"motion = Shear: the contact covers {len(grid.row)} pixels, {MOST} fit in the matrices of "
                "tractions: refine less, or take more points"
            )

    def _operators(self, grid):
        """Tractions -> displacements, and an approximate inverse, built from the mean of both components."""
        xx, xy, yy = cerruti.paired(grid.reach, self._problem.scene.solid.poisson_ratio)
        mean = cho_factor(grid.matrix((xx + yy) / 2), overwrite_a=True)
        along, inverse = grid.matrix(xx), Counted(lambda planes: cho_solve(mean, planes.T).T)
        if self._components == 1:
            return Counted(lambda planes: planes @ along), inverse
        across, aside = grid.matrix(xy, odd=True), grid.matrix(yy)
        return Counted(lambda q: np.stack([along @ q[0] + across @ q[1], across @ q[0] + aside @ q[1]])), inverse


def _components(scene, rows):
    """Number of components of the tractions: only the one along the pull where nothing couples both axes."""
    return 1 if rows == 1 or scene.solid.poisson_ratio == 0 else 2


def _carried_over(other, coarse, grid, limits):
    """Tractions of a coarser grid on this one; where points slipped they are put at their limit."""
    start = np.stack([grid.resample(plane, other) for plane in coarse.traction])
    length = np.sqrt((start * start).sum(axis=0))
    slipping = (grid.resample(coarse.slipping.astype(float), other) > SLIPS) & (length > 0)
    return start * np.divide(limits, length, out=np.ones(grid.shape), where=slipping)


class Counted:
    """A product of vectors (components, m); `operator_applications` counts one for each component."""

    def __init__(self, product):
        self._product, self.operator_applications = product, 0

    def __call__(self, planes):
        self.operator_applications += len(planes)
        return self._product(planes)


class Alone:
    """The product of a plane as a product of planes with a single component."""

    def __init__(self, product):
        self._product = product

    @property
    def operator_applications(self) -> int:
        return self._product.operator_applications

    def __call__(self, planes):
        return self._product(planes[0])[None]
