"""Plan of the 3D solver for a scene: its grids and kernels, and measured applications."""

from dataclasses import replace
from itertools import pairwise
from math import ceil, log10, pi, prod
from pathlib import Path

from scene import Indent, Measured, Plane, Profile, Program, Scene, Slide
from scene.indenter import Axisymmetric
from scene.plan import PIECE, Expected, Kernel, Modes, Plan, at_tolerance, by, expected, left_out
from scene.scales import elastic_contact
from scene.solids.viscoelastic import Linear
from scene.surfaces.isotropic import Isotropic
from scene.terms import terms_of

from . import window
from .costs import typical
from .grid import Grid
from .motion.marching import places
from .motion.steady import Flow
from .motion.timeline import timeline
from .motion.upstream import left_behind, wider_grids
from .problem import COARSEST, row_width
from .response.convolution import free_size
from .response.memory import SMALL

EFFECTS = Path(__file__).with_name("effects.csv")
# What was measured. `effects.csv` has what other parts multiply its applications with: a Program, for a step.
PRICED = (Axisymmetric, Linear, Indent, Slide, Isotropic, Profile)
HOW = "medians of solves to 1e-7"
TIGHT = 1e-7
TOUCHING, ON_A_ROW = 0.4, 0.6  # of the points, in contact
SYMMETRIC, GENERAL = 8, 16  # vectors on the points in contact, of conjugate gradients and of GMRES
MATRICES = 6  # of the points in contact of a sliding row, while it is solved
SAMPLES = 7  # between two columns, in the mean
DRAWN = 13  # arrays in which a surface is drawn, each as large as half of its waves
LEFT_OUT = {
    "roughness": "no spectrum, and nothing is drawn on top of the indenter",
    "layer": "a half-space: no table and no thickness",
    "interface": "no tangential kernels and no tractions: all friction is loss in the elastomer",
    "time": "no steps, and nothing is remembered from one to the next",
    "flow": "real kernels, conjugate gradients instead of GMRES, no kernels of loss",
}


def plan_of(solver, scene: Scene, priced: bool = True) -> Plan:
    """Plan of a scene for a BEM. Nothing is solved: where a window has to be found, its size is an estimate.

    priced : with the expected costs
    """
    terms, shape = terms_of(solver.terms, scene), _shape(solver, scene)
    flow = Flow.of(scene.solid, 0.0 if isinstance(scene.motion, Program) else scene.motion.speed)
    march = _March(solver, scene) if isinstance(scene.motion, Program) else None
    times = scene.solid.retardation()[2]
    moving = march is not None or not flow.at_rest
    found = Plan(
        solver=solver.name,
        settings=f"{solver.points} points a side, tolerance {solver.tolerance:g}, {solver.precision} precision, "
        f"{solver.transforms}",
        terms={term.field: term.says for term in terms},
        method=_method(scene, flow, march),
        shape=shape,
        grids=(*_grids(solver, scene, march),),
        kernels=(*_kernels(scene, flow, shape), *(march.kernels if march else ())),
        modes=Modes.of(times if moving else ()),
        memory=_memory(solver, scene, flow, shape, march),
        steps=march.steps if march else 0,
        operator_applications=_expected(solver, scene, shape, march) if priced else Expected(None, "not asked"),
        left_out=left_out(scene, LEFT_OUT),
    )
    for term in terms:
        found = term.planned(found, scene)
    return found


def _shape(solver, scene):
    return (1 if row_width(scene) else solver.points), solver.points


class _March:
    """Parts that a program adds to a contact: steps, and sheets that follow the material around the window."""

    def __init__(self, solver, scene):
        program, extent = scene.motion, _extent(solver, scene)
        self.grid = Grid(solver.points, extent, width=row_width(scene))
        self.steps = len(timeline(program, self.grid.pixel, solver.steps)) - 1
        self.modes = len(scene.solid.retardation()[2])
        self.places = min(places(program, self.grid, solver.steps), 2 * self.steps)
        self.frames = min(solver.frames, self.steps)
        repeats = isinstance(scene.indenter, Plane)
        self.sheets = [] if repeats or not self.modes else wider_grids(self.grid, program.span)
        # Path on which what is left behind is kept [m].
        self.back = left_behind(program, scene.solid.retardation()[2]) if self.sheets and program.reverses else 0.0
        self.kernels = [
            Kernel(f"response, sheet {k}", "kernel", (sheet.rows, 2 * sheet.points))
            for k, sheet in enumerate(self.sheets, 1)
        ]

    def memory(self, engine, real):
        """Bytes in addition to the contact of a step. real : bytes of a real number of the transforms"""
        # Planes of the window: its modes; what is remembered, and displacements before and after; heights or
        # slopes at places within a pixel; pressure and displacements at instants.
        planes = self.modes + 3 + self.places + 3 * self.frames
        held = 8 * planes * prod(self.grid.shape)
        for finer, sheet in pairwise([self.grid, *self.sheets]):
            columns = ceil(self.back / finer.pixel)  # of all modes, of each sheet but the widest
            held += 8 * (self.modes * prod(sheet.shape) + columns * (self.modes * finer.rows + PIECE))
            held += _product(sheet.shape, free_size(sheet.shape, engine), real)
        return held


def likely_grid(solver, scene: Scene) -> Grid:
    """The grid of a solve; where a window has to be found, as wide as the smooth contact at rest asks for."""
    return Grid(solver.points, _extent(solver, scene), width=row_width(scene))


def _extent(solver, scene):
    """Side of the window [m]: the period, as stated, all of a map, or estimated from the smooth contact."""
    if isinstance(scene.indenter, Plane):
        return scene.roughness.period
    if solver.extent is not None:
        return solver.extent
    if isinstance(scene.indenter, Measured):
        return scene.indenter.side
    held = replace(scene, motion=scene.motion.held) if isinstance(scene.motion, Program) else scene
    return 2 * window.MARGIN * elastic_contact(held).radius


def _method(scene, flow, march):
    if march:
        return "marching: a contact a step, by conjugate gradients on sets of contact"
    if flow.at_rest:
        return "one contact at rest: conjugate gradients on sets of contact"
    inner = "elimination" if row_width(scene) else "GMRES"
    return f"one contact in steady flow: {inner} on sets of contact"


def _grids(solver, scene, march):
    """Grids in words: to find the window, from coarse to fine, and for the sheets around the window."""
    fixed = isinstance(scene.indenter, Plane) or solver.extent is not None
    if not fixed:
        coarse = min(solver.points, window.COARSE)
        as_of = ", as on a half-space" if scene.layer else ""
        yield f"{coarse} points a side, to find a window, of about {_extent(solver, scene):.2g} m{as_of}"
    if march is None:
        coarser = [solver.points]
        while coarser[-1] >= 2 * COARSEST:
            coarser.append((coarser[-1] + 1) // 2)
        if coarser[1:]:
            yield f"{', '.join(map(str, coarser[:0:-1]))} points a side, each the start of the next"
    yield by(_shape(solver, scene)) + (f" of {_extent(solver, scene):.3g} m" if fixed else " in the window")
    if march is None and not fixed and (scene.roughness is not None or isinstance(scene.indenter, Measured)):
        yield f"{window.RING_POINTS} points a side in rings around the window, for peaks outside it"
    if march:
        yield from (f"{by(sheet.shape)} of {sheet.extent:.2g} m around it" for sheet in march.sheets)


def _kernels(scene, flow, shape):
    """Kernels of the elastomer on the finest grid; changes by terms are left out."""
    rows, points = shape
    repeats = isinstance(scene.indenter, Plane)
    form, values = ("symbol", shape) if repeats else ("kernel", (rows, 2 * points))
    yield Kernel("response", form, values)
    yield Kernel("approximate inverse", "symbol", shape)
    if not (flow.at_rest or repeats):
        yield Kernel("loss, by the slope", form, (rows, 2 * points + 2))
        yield Kernel("loss, from pixel to pixel", form, (rows, 2 * points + 2))


def _memory(solver, scene, flow, shape, march):
    """Most that is held at once [bytes]: while the contact is found, a kernel laid out, or a surface drawn."""
    rows, area, repeats = shape[0], prod(shape), isinstance(scene.indenter, Plane)
    real = 4 if solver.precision == "single" and rows > 1 else 8  # single rows are solved in double precision
    sizes = shape if repeats else free_size(shape, solver.engine)
    touching = ceil((ON_A_ROW if rows == 1 else TOUCHING) * area)
    # Planes of heights, pressure, gap and the like, and what the solver of a set of contact keeps.
    if flow.at_rest:
        values = 9 * area + SYMMETRIC * touching
    else:
        values = 11 * area + (MATRICES * touching**2 if rows == 1 else GENERAL * touching)
    # The kernel between the columns of a small grid, kept for the next solve.
    sampled = 0 if flow.at_rest or repeats or not 1 < rows <= SMALL else SAMPLES * 2 * area
    finding = (
        8 * (values + sampled)
        + 3 * area  # sets of contact, a byte a point
        + _product(shape, sizes, real, flow.at_rest)
        + _product(shape, shape, real)  # the approximate inverse
        + (march.memory(solver.engine, real) if march else 0)
    )
    # Four planes; the kernel as it is and as it is laid out; the symbol and its copies; the waves of a plane.
    width = sizes[1] // 2 + 1
    symbols = 3 * (sizes[0] // 2 + 1) * width * (1 if flow.at_rest or repeats else 2)
    kernel = 0 if repeats else 4 * rows * sizes[1]
    laying_out = 8 * (4 * area + kernel + sampled + symbols) + 2 * real * rows * width
    along_x, waves = _waves(scene, _extent(solver, scene) / solver.points)
    surface = 16 * (waves + 3 * solver.points * along_x)  # amplitudes, and waves along the sides of the grid
    return max(surface + finding, surface + laying_out, 8 * DRAWN * waves)


def _product(shape, sizes, real, even=True):
    """Bytes of a product by transforms of these sizes: of a symbol, real where it is even, and of waves."""
    symbol = (sizes[0] // 2 + 1) * (1 if even else 2)
    return real * (symbol + 2 * shape[0]) * (sizes[1] // 2 + 1)


def _waves(scene, pixel):
    """Waves of a rough surface along x, and all of them; of a smooth one, none. pixel [m]"""
    rough = scene.roughness
    if rough is None or rough.flat:
        return 0, 0
    top = ceil(rough.period * rough.q_max(pixel) / (2 * pi))
    return top + 1, (2 * top + 1) * (top + 1)


def _expected(solver, scene, shape, march):
    """Applications of a steady contact as measured, times the measured factors of parts that were not in it."""
    if shape[0] == 1:
        return Expected(None, "squares were measured, no rows")
    if isinstance(scene.indenter, Plane):
        return Expected(None, "few planes were measured among spheres, which take several times as long")
    rough = scene.roughness
    if rough is not None and not rough.flat and getattr(rough, "shortest", None) is None:
        return Expected(None, "no roughness without a shortest wave was measured")
    others = [part for part in scene.parts.values() if not isinstance(part, PRICED)]
    steady, times = (replace(scene, motion=scene.motion.held), march.steps) if march else (scene, 1)

    def as_measured():
        return times * at_tolerance(typical(steady, shape[1]), log10(solver.tolerance / TIGHT))

    why = HOW if solver.tolerance == TIGHT else f"{HOW}, brought to {solver.tolerance:g} by what a few took"
    return expected(as_measured, why, others, EFFECTS)
