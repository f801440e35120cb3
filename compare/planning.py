"""Plan of a scene: what both solvers would simulate, what that costs, and what the 1D answer would be worth."""

from collections.abc import Callable, Iterator, Mapping
from math import isinf
from pathlib import Path
from textwrap import fill

from pydantic import ValidationError

from bem3d import BEM
from mdr1d import MDR
from scene import Refused, Scene, SolveError, markup
from scene.costs import two_digits
from scene.plan import Plan, size
from scene.printable import brief
from scene.reading import InvalidInput

from .amounts import duration, pascals, seconds
from .cases import Case
from .cost import Cost
from .inputs import Asked, case_of
from .studies.casecurves import DIMENSIONS, curves
from .studies.trust.verdict import Trust, trust

WIDTH = 100
WHOLE = {"break_long_words": False, "break_on_hyphens": False}
INDENT = 11  # of the lines, after their names


class Plans(dict[str, Plan | str | Trust]):
    """Plans by the names of the solvers, or why there is none; by "trust", what 1D is worth. Printed, six lines.

    scene : the scene that is planned
    cost : what all contacts of `crosscheck run` take; the reason where it cannot compare this scene
    """

    def __init__(self, plans: Mapping[str, Plan | str | Trust], scene: Scene, cost: Cost | str) -> None:
        super().__init__(plans)
        self.scene, self.cost = scene, cost

    def draw(self, file: str | Path) -> Path:
        """Draw G', G'' of the solid into a .png, .pdf or .svg file; returns its path.

        Raises InvalidInput for other files, and OSError.
        """
        # Only figures need what draws them.
        from .plots import solid
        from .plots.rendering import FORMS, picture
        from .store import write

        path = Path(file)
        form = path.suffix.lower().lstrip(".")
        if form not in FORMS:
            raise InvalidInput(f"figure = {brief(str(file))}: a file that ends in .{', .'.join(FORMS)}")
        content = picture(solid.plot(self.scene), (form,)).files[form]
        write(path, lambda held: held.write(content))
        return path

    @property
    def feasible(self) -> bool:
        """Whether any solver would solve it."""
        return bool(self._plans)

    @property
    def details(self) -> str:
        """Every kernel, array and grid, and what 1D is worth: what `crosscheck plan -v` prints."""
        return "\n\n".join([_lines(self._summary()), *map(str, self.values())])

    def __str__(self) -> str:
        return _lines(self._summary())

    __repr__ = __str__

    def _repr_html_(self) -> str:
        parts = (markup.paragraph(each) if isinstance(each, str) else each._repr_html_() for each in self.values())
        return "".join([markup.table(list(self._summary())), *parts])

    @property
    def _plans(self) -> dict[str, Plan]:
        return {name: each for name, each in self.items() if isinstance(each, Plan)}

    def _summary(self) -> Iterator[tuple[str, str]]:
        """Names and texts of the lines; then the reasons of a solver that refuses, and doubts."""
        if plans := self._plans:
            contacts, time = "1, from Python: crosscheck run does not compare this scene", ""
            if isinstance(self.cost, Cost):
                contacts = f"at most {self.cost.contacts:,}, solved by crosscheck run"
                time = f"about {duration(self.cost.seconds)} on one processor; "
            yield "contacts", contacts
            yield "time", f"{time}this contact {self._by_dimension(_seconds)}"
            yield "memory", f"{self._by_dimension(lambda plan: size(plan.memory))}, at most, in each process"
            yield "simulated", ", ".join(type(part).__name__ for part in self.scene.parts.values())
            left = dict.fromkeys(name for plan in plans.values() for name in plan.left_out)
            yield "left out", ", ".join(left) or "nothing"
        yield "modulus", _stiffness(self.scene)
        for name, each in self.items():
            if isinstance(each, str):
                yield "refused", each
            elif isinstance(each, Plan):
                yield from (("doubtful", f"{name}: {doubt}") for doubt in each.doubts)

    def _by_dimension(self, told: Callable[[Plan], str]) -> str:
        return ", ".join(f"{told(plan)} in {DIMENSIONS[name]}" for name, plan in self._plans.items())


def _stiffness(scene):
    """Shear and Young's modulus of the solid at rest and at the instant, in words."""
    rest, instant = scene.solid.static_modulus, scene.solid.glassy_modulus
    stiffer = 2 * (1 + scene.solid.poisson_ratio)
    at_rest = f"shear G = {pascals(rest)}, Young's E = {pascals(stiffer * rest)} at rest"
    if isinf(instant):
        return f"{at_rest}; infinite at the instant, by a dashpot"
    if instant == rest:
        return f"{at_rest} and at the instant"
    return f"{at_rest}; {pascals(instant)}, {pascals(stiffer * instant)} at the instant"


def plans(asked: Asked) -> Plans:
    """The plans of a case, of a scene alone, of a file or of a ready scene, whether or not both can solve it.

    Raises InvalidInput.
    """
    case = case_of(asked)
    made: dict[str, Plan | str | Trust] = {
        solver.name: planned(solver, case.scene) for solver in (case.mdr, case.bem)
    }
    return Plans(made | {"trust": trust(case.scene)}, case.scene, _cost(case))


def planned(solver: MDR | BEM, scene: Scene) -> Plan | str:
    """The plan of a solver, or its reasons against the scene."""
    try:
        return solver.plan(scene)
    except Refused as reasons:
        return str(reasons)
    except SolveError as reason:
        return f"{solver.name} would not get through this scene: {reason}"


def _cost(case: Case) -> Cost | str:
    """Cost of all contacts that `crosscheck run` solves, or why it solves none."""
    try:
        return sum((each.cost for each in curves(case).values()), Cost())
    except (Refused, SolveError, ArithmeticError, ValidationError) as reason:
        return str(reason)


def _seconds(plan: Plan) -> str:
    expected = plan.seconds.value
    return "an unknown time" if expected is None else seconds(float(two_digits(expected)))


def _lines(summary):
    return "\n".join(
        fill(f"{name:<{INDENT}s}{text}", WIDTH, subsequent_indent=INDENT * " ", **WHOLE) for name, text in summary
    )
