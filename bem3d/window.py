"""The window of surface that a contact needs: found on coarse grids, then checked for what it left out."""

import numpy as np

from scene import SolveError
from scene.scales import elastic_contact

from .grid import Box, Grid
from .problem import COARSE_TOLERANCE, COARSEST, EmptyContact, Problem

PEAKS = 4.0  # rms heights between the mean plane and the highest peaks that the surroundings allow for
MARGIN = 1.15  # window over contact
SETTLED = 0.8  # share of its window that a contact must fill, margin included, for the window to stay
ATTEMPTS = 12  # windows tried
SAMPLES = 2048  # points a side at most, at which the surroundings are searched
FEWEST = 9  # points in contact below which forces are no more than a guess
OVERLAP = 1e-2  # of the depth below the lowest point: what may penetrate outside, felt below 1e-3 in the forces


def surroundings(problem: Problem) -> Box:
    """A square that no contact can leave.

    Everything below the undeformed surface at the depth of the smooth contact at rest, which at the same load a
    viscous one does not exceed, with the highest peaks allowed for.
    """
    scene = problem.scene
    peaks = 0.0 if scene.roughness is None else PEAKS * scene.roughness.rms_height
    reach = MARGIN * scene.indenter.radius_at(elastic_contact(scene).depth + 2 * peaks)
    return Box(-reach, reach, -reach, reach)


def fitted(problem: Problem, points: int) -> Grid:
    """A grid of `points` a side that leaves a margin around the contact, found on grids of at most COARSEST."""
    coarse = min(points, COARSEST)
    box, margin = surroundings(problem), 1.0
    for _ in range(ATTEMPTS):
        grid = Grid.around(box, coarse, margin)
        try:
            touched = problem.solve_on(grid, problem.surface(grid), None, COARSE_TOLERANCE).pressure > 0
        except EmptyContact:
            break
        found, margin = grid.box(touched).padded(grid.pixel), MARGIN
        if grid.on_rim(touched):
            box = box.padded(grid.extent / 4)
        elif margin * found.side < SETTLED * grid.extent:
            box = found
        else:
            break
    return Grid.around(box, points, margin)


def check(grid: Grid, answer) -> None:
    """Raise SolveError if the grid holds too little of the contact or too little of it is resolved."""
    touched = answer.pressure > 0
    if grid.on_rim(touched):
        raise SolveError(f"the contact reaches the edge of extent = {grid.extent:g} m; take a larger extent")
    if np.count_nonzero(touched) < FEWEST:
        raise SolveError(
            f"the contact covers {np.count_nonzero(touched)} of points = {grid.points} squared on extent = "
            f"{grid.extent:g} m, {FEWEST} are needed; take more points"
        )


def improved(problem: Problem, grid: Grid, answer) -> Grid | None:
    """The grid on which to solve next: wider for what this one left out, closer where it resolves next to nothing.

    None when this one will do. Raises SolveError when only more points would help.
    """
    touched = answer.pressure > 0
    box = grid.box(touched)
    if (missed := left_out(problem, grid, answer)) is not None:
        return Grid.around(box.union(missed), grid.points, MARGIN)
    if grid.on_rim(touched):
        return Grid.around(box.padded(grid.extent / 8), grid.points, MARGIN)
    closer = Grid.around(box.padded(grid.pixel), grid.points, MARGIN)
    if np.count_nonzero(touched) < FEWEST and closer.extent < SETTLED * grid.extent:
        return closer
    check(grid, answer)
    return None


def left_out(problem: Problem, grid: Grid, answer) -> Box | None:
    """A box around what the indenter penetrates outside the grid, None when there is nothing.

    The displacement out there is that of the pressure found, on a coarse grid: it is smooth away from the contact.
    """
    surface = problem.surface(grid)
    if surface is None:
        return None
    around = surroundings(problem)
    fine = Grid.around(around, int(np.clip(around.side / grid.pixel, COARSEST, SAMPLES)), 1.0)
    coarse = Grid.around(around, COARSEST, 1.0)
    displacement = fine.resample(problem.operator(coarse)(_binned(grid, answer.pressure, coarse)) * coarse.pixel)
    gap = displacement + problem.heights(fine, surface) - answer.depth * grid.pixel
    inside_x = np.abs(fine.x - grid.centre[0]) < grid.extent / 2
    inside_y = np.abs(fine.y - grid.centre[1]) < grid.extent / 2
    allowed = OVERLAP * (answer.depth * grid.pixel - problem.heights(grid, surface).min())
    penetrating = (gap < -allowed) & ~(inside_y[:, None] & inside_x[None, :])
    return fine.box(penetrating) if penetrating.any() else None


def _binned(grid, pressure, coarse):
    """Pressure of one grid averaged over the pixels of another that surrounds it, the force kept."""
    edges_x = coarse.centre[0] + (np.arange(coarse.points + 1) / coarse.points - 0.5) * coarse.extent
    edges_y = coarse.centre[1] + (np.arange(coarse.points + 1) / coarse.points - 0.5) * coarse.extent
    y, x = np.meshgrid(grid.y, grid.x, indexing="ij")
    force, _, _ = np.histogram2d(y.ravel(), x.ravel(), bins=(edges_y, edges_x), weights=pressure.ravel())
    return force * (grid.pixel / coarse.pixel) ** 2
