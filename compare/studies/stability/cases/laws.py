"""Laws that many hard cases share: of scenes by name, a function of a size that yields the checks.

Solvers are functions of a size, see `solvers`; each of them is asked each scene.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from scene import Result, Scene, SolveError

from ....models.exact import foundation
from .conditions import conditions
from .hardcase import Check, Size, deviation, refusal
from .ordinary import CONE, SPHERE, to_radius
from .solvers import TOLERANCE, dense, line, space

BOTH = (line, space)
FORCES = ("normal_force", "friction_force")
Law = Callable[[Size], Iterable[Check]]
Bound = float | Callable[[Size], float]


def asked(size: Size, rows, solvers: Iterable[Callable]) -> Iterator[tuple]:
    """Words on a check, solver and value, for each solver and each row, or for a single value."""
    named = rows if isinstance(rows, Mapping) else {"": rows}
    for (name, value), build in product(named.items(), solvers):
        solver = build(size)
        yield f"{solver.name}, {solver.points} points{name and ', '}{name}", solver, value


@dataclass(frozen=True)
class Equal:
    """Answers of scenes are those of other scenes on the same grid, or stated numbers by their names.

    rows : scene, and the other scene or the numbers; by name where there are several
    allowed : relative deviation, or a function of a size that gives it
    of : numbers that are compared with those of another scene
    """

    rows: tuple | Mapping[str, tuple]
    allowed: Bound
    solvers: tuple[Callable, ...]
    of: tuple[str, ...]

    @property
    def named(self) -> Mapping[str, tuple]:
        """Rows by name, an empty one where there is but one row."""
        return self.rows if isinstance(self.rows, Mapping) else {"": self.rows}

    def __call__(self, size: Size) -> Iterator[Check]:
        """Checks at a size."""
        bound = self.allowed(size) if callable(self.allowed) else self.allowed
        for what, solver, (scene, known) in asked(size, self.rows, self.solvers):
            found = solver.solve(scene)
            if isinstance(known, Scene):
                other = solver.solve(known)
                known = {name: getattr(other, name) for name in self.of}
            for name, value in known.items():
                yield deviation(f"{what}: {name}", getattr(found, name), value, bound)


def equal(
    rows: tuple | Mapping[str, tuple], allowed: Bound, *solvers: Callable, of: tuple[str, ...] = ("normal_force",)
) -> Equal:
    """Law that answers of scenes are known, see `Equal`; of both solvers where none is named."""
    return Equal(rows, allowed, solvers or BOTH, of)


def in_contact(scenes: Scene | Mapping[str, Scene], *solvers: Callable) -> Law:
    """Conditions of contact, computed anew, hold within twice the tolerance."""

    def examine(size):
        for what, solver, scene in asked(size, scenes, solvers or (dense,)):
            yield from conditions(solver.solve(scene), 2 * TOLERANCE, what)

    return examine


def refused(words: str, scenes: Scene | Mapping[str, Scene], *solvers: Callable, error=SolveError) -> Law:
    """Scenes are refused by an error that has some words, see `refusal`."""

    def examine(size):
        for what, solver, scene in asked(size, scenes, solvers or BOTH):
            yield refusal(what, error, words, solver.solve, scene)

    return examine


def on_a_foundation(elastomers: Mapping, paces: Iterable[float]) -> Law:
    """Sphere and cone keep the closed forms of the foundation, within 20/N of the grid."""
    rows = {}
    for (name, elastomer), shape, pace in product(elastomers.items(), (SPHERE, CONE), paces):
        scene = to_radius(shape, elastomer, pace)
        forces = foundation.sliding_forces(shape, elastomer, scene.motion.speed, scene.motion.depth)
        rows[f"{name}, {type(shape).__name__}, v tau/a = {pace:g}"] = scene, dict(zip(FORCES, forces, strict=True))
    return equal(rows, lambda size: 20 / size.line, line)


def energy_is_lost(what: str, answer: Result, allowed: float) -> Check:
    """Friction by the traction on the slopes is friction by the energy that is lost."""
    found = answer.measures["friction_by_traction"]
    return deviation(f"{what}friction by traction", found, answer.friction_force, allowed)
