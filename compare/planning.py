"""What both solvers would do about the scene of a file."""

from collections.abc import Mapping
from pathlib import Path

from bem3d import BEM
from mdr1d import MDR
from scene import Refused, Scene, SolveError
from scene.plan import Plan
from scene.reading import read

from .cases import Case


def plans(path: Path) -> dict[str, Plan | str]:
    """By the names of the solvers, the plan or why there is none, of a case or of a scene alone.

    Raises InvalidInput.
    """
    case = read(path, Case)
    return {solver.name: planned(solver, case.scene) for solver in (case.mdr, case.bem)}


def planned(solver: MDR | BEM, scene: Scene) -> Plan | str:
    """The plan of a solver, or its reasons against the scene."""
    try:
        return solver.plan(scene)
    except Refused as reasons:
        return str(reasons)
    except SolveError as reason:
        return f"{solver.name} would not get through this scene: {reason}"


def feasible(found: Mapping[str, Plan | str]) -> bool:
    """Whether any solver would solve it."""
    return any(isinstance(each, Plan) for each in found.values())
