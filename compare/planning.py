"""Plans of both solvers for a scene, and the worth of the 1D answer by the trust map."""

from bem3d import BEM
from mdr1d import MDR
from scene import Refused, Scene, SolveError, markup
from scene.plan import Plan

from .inputs import Asked, case_of
from .studies.trust.verdict import Trust, trust


class Plans(dict[str, Plan | str | Trust]):
    """Plans by the names of the solvers, or why there is none; by "trust", what 1D is worth. Printed, a page."""

    @property
    def feasible(self) -> bool:
        """Whether any solver would solve the scene."""
        return any(isinstance(each, Plan) for each in self.values())

    def __str__(self) -> str:
        return "\n\n".join(map(str, self.values()))

    def _repr_html_(self) -> str:
        parts = (markup.paragraph(each) if isinstance(each, str) else each._repr_html_() for each in self.values())
        return "".join(parts)


def plans(asked: Asked) -> Plans:
    """The plans of a case, of a scene alone, of a file or of a ready scene, whether or not both can solve it.

    Raises InvalidInput.
    """
    case = case_of(asked)
    made: dict[str, Plan | str | Trust] = {
        solver.name: planned(solver, case.scene) for solver in (case.mdr, case.bem)
    }
    return Plans(made | {"trust": trust(case.scene)})


def planned(solver: MDR | BEM, scene: Scene) -> Plan | str:
    """The plan of a solver, or its reasons against the scene."""
    try:
        return solver.plan(scene)
    except Refused as reasons:
        return str(reasons)
    except SolveError as reason:
        return f"{solver.name} would not get through this scene: {reason}"
