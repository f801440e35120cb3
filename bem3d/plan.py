"""Plan of this solver for a scene: grids and kernels as `Problem` builds them, costs as measured."""

from dataclasses import replace
from math import ceil, log10
from pathlib import Path

from scene import Indent, Measured, Plane, Profile, Program, Scene, SelfAffine, Slide
from scene.costs import at_tolerance, expected, not_known
from scene.indenter import Axisymmetric
from scene.plan import PIECE, Array, Kernel, Modes, Plan, by, left_out
from scene.scales import elastic_contact
from scene.terms import terms_of
from scene.viscoelastic import Linear

from . import window
from .arrays import as_drawn, engine_of, in_contact, laying_out, of_roughness, padded, product
from .costs import typical
from .grid import Grid
from .marching import places
from .problem import COARSEST, row_width
from .sliding import Flow
from .timeline import timeline
from .upstream import left_behind, wider_grids

EFFECTS = Path(__file__).with_name("effects.csv")
# What was measured. `effects.csv` has what other parts multiply its costs with: a Program, for a step.
PRICED = (Axisymmetric, Linear, Indent, Slide, SelfAffine, Profile)
HOW = "medians of solves to 1e-7 on the machine where they were measured"
TIGHT = 1e-7
LEFT_OUT = {
    "roughness": "no spectrum, and nothing is drawn on top of the indenter",
    "layer": "the kernel is that of a half-space: no table and no thickness",
    "interface": "no tangential kernels and no tractions: all friction is loss in the elastomer",
    "time": "no steps, and nothing is remembered from one to the next",
    "flow": "real kernels, conjugate gradients instead of GMRES, no kernels of loss",
}


def plan_of(solver, scene: Scene) -> Plan:
    """Plan of a scene for a BEM. Nothing is solved: where a window has to be found, its size is an estimate."""
    return _plan(solver, scene, _expected)


def memory_of(solver, scene: Scene) -> int:
    """Most that a solve holds at once [bytes], as planned."""
    return _plan(solver, scene, lambda *_: not_known("not asked")).memory


def _plan(solver, scene, costs):
    """The plan, with costs by a function of solver, scene, shape and march."""
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
        arrays=_held(solver, scene, flow, shape, march),
        steps=march.steps if march else 0,
        **costs(solver, scene, shape, march),
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

    def arrays(self, engine):
        """Arrays of a program beside the contact of a step."""
        yield Array("modes in the window", (self.modes, *self.grid.shape))
        yield Array("what is remembered, and displacements before and after", (3, *self.grid.shape))
        yield Array("heights and slopes at places within a pixel", (self.places, *self.grid.shape))
        if self.frames:
            yield Array("pressure and displacement at instants", (3, self.frames, *self.grid.shape))
        for k, sheet in enumerate(self.sheets, 1):
            yield Array(f"modes on sheet {k}", (self.modes, *sheet.shape))
            yield from product(engine, f"response, sheet {k}", sheet.shape, padded(engine, sheet.shape), real=True)
        if self.back:
            # Columns of all modes, of each sheet but the widest.
            for finer in [self.grid, *self.sheets][: len(self.sheets)]:
                columns = ceil(self.back / finer.pixel)
                yield Array(f"left behind {by(finer.shape)} points", (columns, self.modes * finer.rows + PIECE))


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


def _held(solver, scene, flow, shape, march):
    """The arrays of the stage that holds most."""
    engine = engine_of(solver.engine, scene)
    waves = list(of_roughness(scene, _extent(solver, scene) / solver.points, solver.points))
    steps = march.arrays(engine) if march else ()
    stages = (
        (*waves, *in_contact(engine, scene, flow, shape), *steps),
        (*waves, *laying_out(engine, scene, flow, shape)),
        tuple(as_drawn(waves)),
    )
    return max(stages, key=lambda stage: sum(array.bytes for array in stage))


def _expected(solver, scene, shape, march):
    """Costs of a steady contact as measured, times the measured factors of parts that were not in it."""
    if shape[0] == 1:
        return not_known("squares were measured, no rows")
    if isinstance(scene.indenter, Plane):
        return not_known("few planes were measured among spheres, which take several times as long")
    rough = scene.roughness
    if rough is not None and not rough.flat and getattr(rough, "shortest", None) is None:
        return not_known("no roughness without a shortest wave was measured")
    others = [part for part in scene.parts.values() if not isinstance(part, PRICED)]
    steady, times = (replace(scene, motion=scene.motion.held), march.steps) if march else (scene, 1)

    def as_measured():
        counted = at_tolerance(typical(steady, shape[1]), log10(solver.tolerance / TIGHT))
        return {name: times * value for name, value in counted.items()}

    why = HOW if solver.tolerance == TIGHT else f"{HOW}, brought to {solver.tolerance:g} by what a few took"
    return expected(as_measured, why, others, EFFECTS)
