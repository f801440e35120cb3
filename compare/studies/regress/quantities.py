"""The accuracy of the one-dimensional answer in numbers: ratios to three dimensions and to closed forms."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

from bem3d import BEM
from mdr1d import MDR, draw, equations
from scene import Indent, Kelvin, PowerLaw, Program, Scene, SelfAffine, Slide, Stage, StandardLinearSolid
from scene.scales import elastic_contact

from ...models.exact import foundation, indentation
from ...solving.task import SceneTask, draws_of
from ..paper import parameters
from ..paper.parameters import variable
from .profiles import Profiles
from .quantity import Quantity

# Three dimensions are solved closer than by default, so that what is seen is their discretisation.
SPACE, LINE = BEM(points=128, tolerance=1e-7), MDR(points=2000)
RADIUS, TIME = 1e-3, 1e-3
SHAPES = parameters.SHAPES
QUARTIC = PowerLaw(coefficient=5e7, exponent=4.0)
SOLIDS: dict[str, Kelvin | StandardLinearSolid] = {
    "Kelvin": parameters.SOLID,
    "standard linear": StandardLinearSolid(1e6, 1e7, TIME),
}
PROFILES, SURFACES, PAPER_PROFILES = 20, 8, 50
DECADES = {"1e-2": 0.01, "1": 1.0, "1e2": 100.0}
GRID = "1 in theory; the rest is the grid of 400 points"
# Tolerances, each with its reason; measured by solving everything again in those ways.
ROUNDING = 1e-8, "rounding alone: 1D is exact on its grid, loads are met to 1e-10"
AT_REST = 1e-6, "solving 3D to 1e-9 for 1e-7 moves it by 2e-8 at most, 120 points for 128 by 2e-6 to 4e-5"
SLIDING = 1e-5, "solving 3D to 1e-9 for 1e-7 moves it by 6e-7 at most, 120 points for 128 by up to 2e-3"


def shipped() -> list[Quantity]:
    """The collection whose baseline comes with the package."""
    return [*_at_rest(), *_smooth(), *_rough(), *_law(), *_withdrawal(), *_foundation()]


def _at_rest() -> Iterator[Quantity]:
    for name, shape in (SHAPES | {"quartic": QUARTIC}).items():
        scene = Scene(shape, parameters.SOLID, Indent(depth=_depth(shape)))
        sentence = f"at rest, {name}: force 1D/3D"
        meaning = "1 in theory; the rest is the discretisation of 3D"
        yield _ratio(f"rest.{name}.force", sentence, "normal_force", scene, AT_REST, meaning)


def _smooth() -> Iterator[Quantity]:
    """Ratios in smooth sliding, at the load whose static contact has the radius a."""
    means = {"friction": "2 in the limit of low speed, unknown else", "depth": "1 at rest, unknown else"}
    for (solid_name, solid), (name, shape) in product(SOLIDS.items(), SHAPES.items()):
        load = elastic_contact(Scene(shape, solid, Indent(depth=_depth(shape)))).load
        for label, flow in DECADES.items():
            scene = Scene(shape, solid, Slide(speed=flow * RADIUS / TIME, load=load))
            place = f"slide.{name}.{_short(solid_name)}.{label}"
            where = f"sliding, smooth {name}, {solid_name}, v tau/a = {flow:g}"
            for what, of in (("friction", "friction_force"), ("depth", "depth"))[: 1 if flow < 1 else 2]:
                yield _ratio(f"{place}.{what}", f"{where}: {what} 1D/3D", of, scene, SLIDING, means[what])


def _rough() -> Iterator[Quantity]:
    """Ratios of the paper's contacts with a shortest wave that both resolve."""
    meaning = f"mean over {PROFILES} profiles and {SURFACES} surfaces: holds their scatter beside the difference"
    for name, shape in SHAPES.items():
        hurst = parameters.CONTACT_HURST[name]
        rough = SelfAffine(hurst=hurst, rms_height=5e-5, longest=1e-2, shortest=5e-4, seed=1)
        scene = Scene(shape, parameters.SOLID, Slide(speed=0.1, load=1.0), rough)
        pressed = replace(scene, motion=Indent(depth=elastic_contact(scene).depth))
        sentence = f"at rest, rough {name}: force 1D/3D"
        yield _ratio(f"rest.rough-{name}.force", sentence, "normal_force", pressed, AT_REST, meaning)
        for label, speed in {"1e-2": 0.01, "1e-1": 0.1, "1e1": 10.0}.items():
            moved = replace(scene, motion=Slide(speed=speed, load=1.0))
            sentence = f"sliding, rough {name}, {speed:g} m/s: friction 1D/3D"
            id = f"slide.rough-{name}.{label}.friction"
            yield _ratio(id, sentence, "friction_force", moved, SLIDING, meaning)


def _law() -> Iterator[Quantity]:
    """Fig. 4 of the paper at three xi."""
    slope = draw(parameters.ROUGH, parameters.POINTS).rms_slope
    for name in SHAPES:
        unit = variable(parameters.base(name, speed=1.0), slope)
        for label, xi in DECADES.items():
            yield _closed(
                f"law.{name}.{label}.friction",
                f"Fig. 4, {name}, xi = {xi:g}: friction 1D/Eq. 19",
                "friction_coefficient",
                Profiles(parameters.base(name, speed=xi / unit), parameters.POINTS, PAPER_PROFILES),
                equations.plateau(slope) * equations.interpolation(xi),
                f"mean over {PAPER_PROFILES} profiles against the law of the paper with alpha = 1.5",
            )


def _withdrawal() -> Iterator[Quantity]:
    """Pressed in at a constant rate for 2 s and drawn back as fast, on a solid that relaxes in 1 s."""
    solid, rate = StandardLinearSolid(1e6, 5e6, 1.0), RADIUS / 40
    times, depths = (0.0, 2.0, 4.0), (0.0, 2 * rate, 0.0)
    for (name, shape), time in product(SHAPES.items(), (2.2, 2.5)):
        stages = Stage(duration=2.0, depth=2 * rate), Stage(duration=time - 2, depth=(4 - time) * rate)
        (known,), _ = indentation.force_of_depth(shape, solid, times, depths, time)
        yield _closed(
            f"withdrawal.{name}.{1e3 * time:.0f}ms.force",
            f"withdrawal, {name}, {time:g} s: force 1D/Ting",
            "normal_force",
            SceneTask(MDR(points=400, steps=20), (Scene(shape, solid, Program(stages=stages)),)),
            known,
            GRID,
        )


def _foundation() -> Iterator[Quantity]:
    for (solid_name, solid), (name, shape) in product(SOLIDS.items(), SHAPES.items()):
        motion = Slide(speed=RADIUS / TIME, depth=_depth(shape))
        answers = foundation.sliding_forces(shape, solid, motion.speed, motion.depth)
        for of, known in zip(("normal_force", "friction_force"), answers, strict=True):
            what = of.split("_")[0]
            yield _closed(
                f"foundation.{name}.{_short(solid_name)}.{what}",
                f"foundation, {name}, {solid_name}, v tau/a = 1: {what} force 1D/exact",
                of,
                _line((Scene(shape, solid, motion),), MDR(points=400)),
                known,
                GRID,
            )


def _short(solid_name):
    return solid_name.lower().replace(" ", "-")


def _depth(shape):
    """Depth at which the smooth static contact has the radius RADIUS."""
    return shape.mdr_coefficient * RADIUS**shape.exponent


def _ratio(id, sentence, of, scene, bound, meaning):
    """Ratio of 1D over 3D."""
    drawn = draws_of(scene, SURFACES)
    over = SceneTask(SPACE, drawn, work=len(drawn) * SPACE.points**2.5 * 25.0)
    return Quantity(id, sentence, of, _line(draws_of(scene, PROFILES), LINE), over, *bound, meaning)


def _closed(id, sentence, of, task, known, meaning):
    """Ratio of 1D over a closed form."""
    return Quantity(id, sentence, of, task, float(known), *ROUNDING, meaning)


def _line(scenes, solver):
    return SceneTask(solver, scenes, work=len(scenes) * solver.points * 5.0)
