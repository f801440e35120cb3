"""The window of surface around a contact: found on coarse grids, then checked for contact outside."""

from math import ceil
from typing import NamedTuple

import numpy as np

from scene import Cylinder, Doubt, EmptyContact, Measured, Plane, Scene, SelfAffine, SolveError
from scene.scales import elastic_contact

from .grid import Box, Grid
from .problem import Problem, Start, Unseen
from .response import layer

PEAKS = 4.0  # rms heights between the mean plane and the highest peaks that the surroundings allow for
MARGIN = 1.15  # window over contact
SETTLED = 0.8  # share of its window that a contact must fill, margin included, for the window to stay
ATTEMPTS = 12  # windows tried, those apart that only close in on a contact
COARSE = 64  # points a side at most, on which a window is sought
COARSE_TOLERANCE = 1e-3  # of the contacts that only place it
RING = 3.0  # outer over inner side of a ring of the surroundings
RING_POINTS = 96  # a side, for the displacement in a ring: 16 pixels from the contact at least
SAMPLES = 2048  # points a side at most, at which a ring is searched for what penetrates
FEWEST = 9  # points in contact below which forces are no more than a guess
SPARE = 1.25  # factor on a window, for other surfaces, whose peaks lie elsewhere
RESOLVED = 8.0  # pixels on the shortest wave
MOST_POINTS = 16384  # a side
FULLER = 1.01  # of a pixel, so that two of them are carried with few digits too
OVERLAP = 1e-2  # of the depth below the lowest point: what may penetrate outside, felt below 1e-3 in the forces


def surroundings(problem: Problem) -> Box:
    """A square that contains any contact of the scene.

    Everything below the undeformed surface at the depth of the smooth contact at rest, which at the same load a
    viscous one does not exceed, with the highest peaks allowed for; of a measured body all of its map.
    """
    scene = problem.scene
    if isinstance(scene.indenter, Measured):
        half = scene.indenter.side / 2
        return Box(-half, half, -half, half)
    at_rest = elastic_contact(scene)
    if isinstance(scene.indenter, Cylinder):  # smooth, and its depth is no measure of its width
        reach = 2 * MARGIN * at_rest.radius
    else:
        peaks = 0.0 if scene.roughness is None else PEAKS * scene.roughness.rms_height
        reach = MARGIN * scene.indenter.radius_at(_risen(scene) * at_rest.depth + 2 * peaks)
    return Box(-reach, reach, -reach, reach)


def _risen(scene):
    """Height of the indenter at the edge of a smooth contact over its depth, at most.

    At a given load a contact on a layer is smaller than on a half-space. At a given depth it is larger: what is
    squeezed out of a thin incompressible layer under a body c r^n rises around it, to d (n + 2)/2.
    """
    if scene.layer is None or scene.motion.depth is None:
        return 1.0
    return (scene.indenter.exponent + 2) / 2


class Placed(NamedTuple):
    """Place of a contact: a box around it, the window over the box, and the coarse contact found in it, if any."""

    box: Box
    margin: float
    start: Start | None

    def grid(self, points: int, width: float | None = None) -> Grid:
        """The window on a grid of `points` a side."""
        return Grid.around(self.box, points, self.margin, width)


def fitted(problem: Problem, points: int) -> Placed:
    """Place of the contact, found on grids of at most COARSE points a side."""
    points = min(points, COARSE)
    placed, widened = Placed(surroundings(problem), 1.0, None), 0
    while widened < ATTEMPTS:
        box, grid = placed.box, placed.grid(points, problem.width)
        try:
            pressure = problem.solve_on(grid, problem.surface(grid), COARSE_TOLERANCE, placed.start).pressure
        except (EmptyContact, Unseen):
            break
        touched, start = pressure > 0, problem.start(grid, pressure)
        found = grid.box(touched).padded(grid.pixel)
        if grid.on_rim(touched):
            if isinstance(problem.scene.indenter, Measured):  # nothing is known of what is beyond the map
                return Placed(surroundings(problem), 1.0, None)
            placed, widened = Placed(box.padded(grid.extent / 4), MARGIN, start), widened + 1
        elif MARGIN * found.side < SETTLED * grid.extent:
            placed = Placed(found, MARGIN, start)
        else:
            return Placed(box, MARGIN, start)
    return placed


def check(scene: Scene, grid: Grid, touched: np.ndarray, repeats: bool = False) -> None:
    """Raise SolveError if a contact reaches the edge of the grid, or if it or its layer is not resolved.

    A surface that repeats has no edge.
    """
    check_on_map(scene, grid, touched)
    if not repeats and grid.on_rim(touched):
        raise SolveError(f"the contact reaches the edge of extent = {grid.extent:g} m; take a larger extent")
    check_resolved(grid, touched)
    check_layer(scene, grid, grid.spot_radius(touched))


def check_resolved(grid: Grid, touched: np.ndarray) -> None:
    """Raise SolveError if a contact covers too few pixels for its forces to be more than a guess."""
    if np.count_nonzero(touched) < FEWEST:
        raise SolveError(
            f"the contact covers {np.count_nonzero(touched)} of {grid.points} x {grid.rows} points on extent = "
            f"{grid.extent:g} m, {FEWEST} are needed; take more points"
        )


def improved(problem: Problem, grid: Grid, answer) -> Grid | None:
    """The next grid to solve on: wider where this one left out contact, closer where too few pixels touch.

    None when this one will do. Raises SolveError when only more points would help.
    """
    touched = answer.pressure > 0
    check_on_map(problem.scene, grid, touched)
    box = grid.box(touched)
    if (missed := left_out(problem, grid, answer)) is not None:
        return Grid.around(box.union(missed), grid.points, MARGIN)
    if grid.on_rim(touched):
        return Grid.around(box.padded(grid.extent / 8), grid.points, MARGIN, grid.width)
    closer = Grid.around(box.padded(grid.pixel), grid.points, MARGIN, grid.width)
    if np.count_nonzero(touched) < FEWEST and closer.extent < SETTLED * grid.extent:
        return closer
    check(problem.scene, grid, touched)
    return None


def left_out(problem: Problem, grid: Grid, answer) -> Box | None:
    """A box around penetration by the indenter outside the grid; None where there is none.

    The displacement outside is caused by the pressure found. It is smooth away from the contact, so rings of
    growing width around the window are searched, each on a grid as coarse as its distance allows.
    """
    surface, shortest = problem.surface(grid), problem.shortest(grid)
    if shortest is None:
        return None
    around, missed = surroundings(problem), None
    farthest = 2 * (around.right + max(map(abs, grid.centre)))
    inner = grid.extent
    while inner < farthest:
        outer = min(RING * inner, farthest)
        found = _penetrating(problem, grid, answer, surface, shortest, inner, outer)
        missed = found if missed is None else missed if found is None else missed.union(found)
        inner = outer
    return missed


def _penetrating(problem, grid, answer, surface, shortest, inner, outer):
    """A box around penetration between two squares of these sides [m] around the centre of the window."""
    coarse = Grid(RING_POINTS, outer, grid.centre)
    # No finer than the roughness asks for, nor than the solution itself was.
    step = max(grid.pixel, shortest / 8)
    fine = Grid(int(np.clip(outer / step, RING_POINTS, SAMPLES)), outer, grid.centre)
    inside_x = np.abs(fine.x - grid.centre[0]) < inner / 2
    inside_y = np.abs(fine.y - grid.centre[1]) < inner / 2
    outside = ~(inside_y[:, None] & inside_x[None, :])
    depth = answer.depth * grid.pixel
    gap = problem.heights(fine, surface) - depth
    if problem.scene.layer is None and (gap[outside] >= 0).all():  # a half-space does not rise under a pressure
        return None
    displacement = problem.medium.operator(coarse)(coarse.averaged(answer.pressure, grid))
    gap += fine.resample(displacement, coarse) * coarse.pixel
    penetrating = (gap < -OVERLAP * (depth - answer.lowest * grid.pixel)) & outside
    return fine.box(penetrating) if penetrating.any() else None


def check_on_map(scene: Scene, grid: Grid, touched: np.ndarray) -> None:
    """Raise SolveError where a contact reaches the outermost pixels of a measured body, and so the unknown."""
    body = scene.indenter
    if isinstance(body, Measured) and (touched & body.on_rim(*grid.places)).any():
        size = " x ".join(f"{side:g}" for side in body.size)
        raise SolveError(
            f"the contact reaches the rim of the map, {size} m, beyond which nothing is known of the indenter; "
            "press less, or measure more of it"
        )


def check_waves(scene, grid: Grid, extent: float | None) -> None:
    """Raise SolveError where the grid cannot carry the roughness.

    extent : as stated [m]; None where the window is fitted
    """
    fitted_to_contact = extent is None and not isinstance(scene.indenter, Plane)
    if reasons := _missed(scene, grid, SPARE if fitted_to_contact else 1.0):
        raise SolveError("; ".join(reasons))


def check_layer(scene, grid: Grid, radius: float | None = None) -> None:
    """Raise SolveError where the grid falsifies a contact on the layer; radius [m], None if it fills the grid."""
    if reasons := _falsified(scene, grid, radius):
        raise SolveError("; ".join(reasons))


def unresolved(scene, grid: Grid) -> list[str]:
    """Reasons why the grid cannot carry the roughness, the map of a measured body or the layer."""
    return _falsified(scene, grid) + _missed(scene, grid)


def foreseen(problem: Problem, points: int, extent: float | None) -> list[str]:
    """Reasons why no window would hold a steady contact, with values that work.

    A coarse contact is sought, as by `fitted`, where the widest window that there can be does not settle it.
    extent : as stated [m]; None where the window is fitted
    """
    scene, width, most = problem.scene, problem.width, _widest(problem)
    widest = Grid(points, most if extent is None else extent, width=width)
    carries = not _missed(scene, widest)
    if carries and (extent is None or most <= extent):
        return []
    try:
        placed = fitted(problem, points)
    except SolveError as reason:  # that a solve has too
        return ["; ".join([str(reason), *_kept(scene, widest)])]
    if extent is None:
        return _missed(scene, placed.grid(points, width), SPARE)
    reach = _reach(placed.start)
    if reach <= extent / 2:
        return []
    enough = 2 * SPARE * MARGIN * reach
    return [
        f"the contact reaches the edge of extent = {extent:g} m: extent = {enough:.3g} holds it, with points = "
        f"{ceil(points * enough / extent)} on the same pixel; without an extent the window is fitted"
    ]


def _widest(problem):
    """Side of a square around the axis that no contact leaves [m]: of smooth bodies the contact at rest."""
    scene = problem.scene
    if scene.layer is None and scene.roughness is None and not isinstance(scene.indenter, Measured):
        return 2 * elastic_contact(scene).radius
    return 2 * surroundings(problem).right


def _reach(start):
    """Farthest point in contact from the axis along x or y [m], zero where none was found."""
    if start is None or not (touched := start.pressure > 0).any():
        return 0.0
    across = [] if start.grid.width else np.abs(start.grid.y[touched.any(axis=1)])
    return max([*across, *np.abs(start.grid.x[touched.any(axis=0)])])


def doubts(scene: Scene, grid: Grid) -> tuple[Doubt, ...]:
    """Doubts about how well a grid shows the shortest wave, where it holds it, and the layer."""
    found, (_, shortest) = [], _shortest(scene)
    if shortest is not None and 2 <= shortest / grid.pixel < RESOLVED:
        why = "two are the least, about eight resolve the wave: use more points, or longer waves"
        found.append(Doubt("pixels in 3D on the shortest wave", shortest / grid.pixel, RESOLVED, "", why))
    if reasons := _falsified(scene, grid):
        share = layer.falsified(scene, grid)
        found.append(
            Doubt("share of the force that pixels falsify", share, layer.FALSIFIED, "", "; ".join(reasons))
        )
    return tuple(found)


def _falsified(scene, grid, radius=None):
    if scene.layer is None or isinstance(scene.indenter, Plane):
        return []
    return layer.unresolved(scene, grid, radius)


def _shortest(scene):
    """Field of the scene that has waves, and the shortest of them [m]; None without."""
    if scene.roughness is None and isinstance(scene.indenter, Measured):
        return "indenter", scene.indenter.shortest
    return "roughness", None if scene.roughness is None or scene.roughness.flat else scene.roughness.shortest


def _missed(scene, grid, spare=1.0):
    """Reason why the grid cannot carry the shortest wave, with values that work; spare : factor on the window."""
    field, shortest = _shortest(scene)
    if shortest is None or 2 * grid.pixel <= shortest:
        return []
    least = ceil(2 * spare * grid.extent / shortest)
    advice = [f"points = {least} would do"] if least <= MOST_POINTS else []
    if advice and 4 * least <= MOST_POINTS:
        advice = [f"{advice[0]}, points = {4 * least} would resolve it"]
    remedy = (
        "; ".join([*advice, *_kept(scene, grid, spare)])
        or "no allowed number of points would do: press less, or use longer waves"
    )
    return [f"{field}.shortest = {shortest:g} m is less than two pixels of {grid.pixel:g} m; {remedy}"]


def _kept(scene, grid, spare=1.0):
    """Advice on the shortest wave that the grid carries, by its field; empty where it carries all."""
    field, shortest = _shortest(scene)
    if shortest is None or 2 * grid.pixel <= shortest:
        return []
    rough, kept = getattr(scene, field), 2 * FULLER * spare * grid.pixel
    if (keepable := getattr(rough, "keepable", None)) is not None:
        least_kept, most_kept = keepable
        kept = max(kept, FULLER * least_kept)
        if kept <= most_kept:
            return [f"{field}.shortest_kept = {kept:.3g} would leave out waves that they cannot carry"]
    elif isinstance(rough, SelfAffine) and kept <= rough.longest / 2:
        return [f"{field}.shortest = {kept:.3g} would do"]
    return []
