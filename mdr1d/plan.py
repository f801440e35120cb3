"""Plan of the 1D solver for a scene: no kernels, and the sweeps that it takes."""

from math import ceil
from pathlib import Path

from scene import Indent, Profile, Program, Scene, Slide
from scene.indenter import Axisymmetric
from scene.plan import PIECE, Modes, Plan, expected, left_out
from scene.solids.viscoelastic import Linear
from scene.surfaces.isotropic import Isotropic
from scene.terms import terms_of

from .modes import modes_of
from .surface import nodes_needed
from .timeline import timeline

EFFECTS = Path(__file__).with_name("effects.csv")
# Parts whose sweeps are counted below; of all others `effects.csv` has what they multiply them with.
COUNTED = (Axisymmetric, Linear, Indent, Slide, Program, Isotropic, Profile)
SWEEPS = 5  # under a load; 2 to 7 are usual
MEASURED = "sweeps, as counted on spheres"
LEFT_OUT = {
    "roughness": "the profile is smooth: no line is drawn",
    "layer": "a half-space: the foundation has no thickness",
    "interface": "no tangential springs: all friction is loss in the elastomer",
    "time": "no steps: elements have no state, one sweep along the profile finds them all",
    "flow": "springs alone: no memory from node to node",
}


def plan_of(solver, scene: Scene, layout) -> Plan:
    """Plan of a scene for an MDR. Nothing is solved; a smooth grid may be drawn closer around the contact.

    layout : the `Grid` to begin with
    """
    terms, elastomer, motion = terms_of(solver.terms, scene), scene.solid, scene.motion
    if isinstance(motion, Program):
        steps, moves = len(timeline(motion, layout.pixel, solver.steps).times) - 1, True
    else:
        steps, moves = 0, motion.speed > 0
    nodes, modes = 2 * layout.half + 1, len(elastomer.retardation()[2]) if moves else 0
    found = Plan(
        solver=solver.name,
        settings=f'{solver.points} points, shape "{solver.shape}", spectrum "{solver.spectrum}"',
        terms={term.field: term.says for term in terms},
        method=_method(scene, modes, steps),
        shape=(nodes,),
        grids=(f"{nodes} nodes on {layout.extent:.3g} m, drawn closer where a smooth contact is small",)
        if scene.roughness is None and solver.extent is None
        else (f"{nodes} nodes on {layout.extent:.3g} m",),
        kernels=(),
        modes=Modes.of(elastomer.retardation()[2] if moves else ()),
        memory=_memory(solver, scene, layout, steps),
        steps=steps,
        operator_applications=_expected(scene, steps),
        left_out=left_out(scene, LEFT_OUT),
    )
    for term in terms:
        found = term.planned(found, scene)
    return found


def _method(scene, modes, steps):
    if steps:
        met = "" if scene.motion.pressed_by == "depth" else ", the load met once in each"
        return f"marching: every element followed exactly from step to step{met}"
    flow = "in steady flow" if modes else "on springs alone"
    if scene.motion.load is None:
        return f"one sweep along the profile {flow}, exact between nodes"
    return f"sweeps along the profile {flow}, exact between nodes, and Newton's steps to the load"


def _memory(solver, scene, layout, steps):
    """Most that is held at once [bytes]: by node, by step, and of a rough line while it is drawn."""
    nodes = 2 * layout.half + 1
    values = 9 * nodes  # profile, displacement, forces, and their copies
    if steps:
        modes = modes_of(scene.solid)
        states = len(modes.moduli) + len(modes.compliances) + 4 * min(solver.frames, steps)
        # Elements now and at instants; the profile, its slopes, and rates; the history.
        values = states * (nodes - 1) + 12 * nodes + 3 * 14 * steps
        if scene.motion.reverses:
            passed = ceil(scene.motion.span / layout.pixel)
            values += passed * (len(modes.compliances) + PIECE)
    if layout.period is not None:
        least = 0 if scene.roughness.shortest is None or solver.extent else 8 * nodes_needed(scene.roughness)
        values += 7 * max(layout.period, least)
    return 8 * values


def _expected(scene, steps):
    """Sweeps along the profile, times measured factors of the other parts of the scene."""
    sweeps = steps or (1 if scene.motion.load is None else SWEEPS)
    others = [part for part in scene.parts.values() if not isinstance(part, COUNTED)]
    return expected(lambda: float(sweeps), MEASURED, others, EFFECTS)
