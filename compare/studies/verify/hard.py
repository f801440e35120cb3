"""Laws taken over from the hard cases, and the order at which a model converges."""

from collections.abc import Iterator

from scene import Scene
from scene.scales import elastic_contact

from ..stability.cases.collection import CASES
from ..stability.cases.laws import Equal
from .forms import BODIES, deep
from .law import BOTH, GRID, LINE, Answers, Law, Missing, apart, stated, worst

HARD, ORDER = "hard cases", "convergence"
# Case: dimensions that must keep it, and what the bound has more than that of the grid.
TAKEN: dict[str, tuple[tuple[str, ...], float, str]] = {
    "speed-zero": (BOTH, 0.0, ""),
    "speed-to-infinity": (BOTH, 1e-6, "what relaxes in passing"),
    "speed-denormal": (BOTH, 0.0, ""),
    "relaxation-time-to-zero": (BOTH, 0.0, ""),
    "relaxation-time-to-infinity": (BOTH, 0.0, ""),
    "kelvin-cone-saturates": (LINE, 0.0, ""),
    "depth-at-once-and-in-an-age": (BOTH, 0.02, "of first order in 200 steps"),
    "equal-times": (BOTH, 0.0, ""),
    "modes-in-any-order": (BOTH, 0.0, ""),
    "all-but-absent-modes": (BOTH, 0.0, ""),
    "chain-without-glass": (BOTH, 0.0, ""),
}
FEWEST = 7.5  # points across the contact, eight with rounding, from which on a grid shows an order
ROUNDED = 1e-12  # of an error: rounding alone
SHARES = 0.25, 0.3, 0.35, 0.7, 0.85, 1.0
"""Sizes of grids: points over those of the model."""


def laws() -> Iterator[Law]:
    """All of them."""
    yield from taken()
    yield from orders()


def taken() -> Iterator[Law]:
    """One law of each hard case, of all its scenes."""
    for name, (kinds, more, why) in TAKEN.items():
        case = CASES[name]
        rows = [(*row, law.of) for law in case.laws if isinstance(law, Equal) for row in law.named.values()]
        rows = list({row[0]: row for row in rows}.values())  # a case asks the same of both solvers
        scenes = tuple(each for scene, other, _ in rows for each in (scene, other) if isinstance(each, Scene))
        bound = GRID.and_(more, why) if more else GRID
        yield Law(f"hard.{name}", HARD, case.about.removesuffix("."), scenes, _misfit(rows), bound, kinds)


def _misfit(rows):
    """Largest misfit of the rows of a case: scene, another scene or known numbers, and what is compared."""

    def misfit(answers: Answers) -> float:
        rest, found = iter(answers), []
        for _, other, of in rows:
            answer = next(rest)
            reference = next(rest) if isinstance(other, Scene) else other
            names = of if isinstance(other, Scene) else other
            found += [apart(answer[each], reference[each]) for each in names]
        return worst(found)

    return misfit


def ladders() -> dict[str, tuple[Scene, float]]:
    """Scenes on which work and precision are measured, with the exact force."""
    scenes = {name: deep(BODIES[name]) for name in ("sphere", "cone", "r^4")}
    return {name: (scene, elastic_contact(scene).load) for name, scene in scenes.items()}


def orders() -> Iterator[Law]:
    """The error of the force falls with the pixel, to first order at least.

    The largest of three grids counts: the rim of a contact moves by whole pixels, so that single errors scatter.
    """
    for name, (scene, load) in ladders().items():

        def misfit(answers: Answers, load=load) -> float:
            if answers[0].across < FEWEST:
                raise Missing(
                    f"a quarter of the points are {answers[0].across:.3g} across the contact: no order yet"
                )
            errors = [apart(answer["normal_force"], load) for answer in answers]
            coarse, fine = worst(errors[:3]), worst(errors[3:])
            return fine / coarse if fine > ROUNDED else 0.0

        bound = stated(0.5, "a half: of first order in the pixel")
        said = f"{name}: error of the force on three grids over that on three with half the points"
        yield Law(f"order.{name}", ORDER, said, (scene,) * len(SHARES), misfit, bound, shares=SHARES)
