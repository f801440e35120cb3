"""What both solvers would do about a scene."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from bem3d import BEM
from mdr1d import MDR
from scene import Refused, Scene, SolveError, markup
from scene.plan import Plan

from .inputs import Asked, case_of


@dataclass(frozen=True)
class Plans(Mapping[str, Plan | str]):
    """By the names of the solvers, the plan, or why there is none. Printed, it is a page.

    title : of what was asked
    """

    found: Mapping[str, Plan | str]
    title: str = ""

    @property
    def feasible(self) -> bool:
        """Whether any solver would solve it."""
        return any(isinstance(each, Plan) for each in self.found.values())

    def __getitem__(self, solver: str) -> Plan | str:
        return self.found[solver]

    def __iter__(self) -> Iterator[str]:
        return iter(self.found)

    def __len__(self) -> int:
        return len(self.found)

    def __str__(self) -> str:
        return "\n\n".join(map(str, self.found.values()))

    def _repr_html_(self) -> str:
        return "".join(
            each._repr_html_() if isinstance(each, Plan) else markup.paragraph(each)
            for each in self.found.values()
        )


def plans(asked: Asked) -> Plans:
    """The plans of a case, of a scene alone, of a file or of a ready scene, whether or not both can solve it.

    Raises InvalidInput.
    """
    case = case_of(asked)
    found = {solver.name: planned(solver, case.scene) for solver in (case.mdr, case.bem)}
    return Plans(found, case.title)


def planned(solver: MDR | BEM, scene: Scene) -> Plan | str:
    """The plan of a solver, or its reasons against the scene."""
    try:
        return solver.plan(scene)
    except Refused as reasons:
        return str(reasons)
    except SolveError as reason:
        return f"{solver.name} would not get through this scene: {reason}"
