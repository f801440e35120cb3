"""The accuracy of the one-dimensional answer in numbers: ratios to three dimensions and to closed forms."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import isnan

from bem3d import BEM
from mdr1d import MDR, draw, equations
from mdr1d.ensemble import solve_profiles
from scene import (
    Indent,
    Kelvin,
    PowerLaw,
    Program,
    Scene,
    SelfAffine,
    Slide,
    Stage,
    StandardLinearSolid,
)
from scene.scales import elastic_contact

from .outcome import Outcome, Row
from .paper import parameters
from .paper.campaign import variable
from .quantity import Quantity
from .references import foundation, indentation
from .study import SCENES, Task

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
# Tolerances, each with its reason; measured by solving everything again in those ways.
ROUNDING = 1e-8, "rounding alone: 1D is exact on its grid, loads are met to 1e-10"
AT_REST = 1e-6, "solving 3D to 1e-9 for 1e-7 moves it by 2e-8 at most, 120 points for 128 by 2e-6 to 4e-5"
SLIDING = 1e-5, "solving 3D to 1e-9 for 1e-7 moves it by 6e-7 at most, 120 points for 128 by up to 2e-3"


@dataclass(frozen=True)
class Profiles:
    """A task, as of store: one scene on the profiles of the seeds 0, 1, ..., by mdr1d.ensemble.

    points : on the longest wavelength; profiles : how many
    """

    scene: Scene
    points: int
    profiles: int
    keeps_fields = False
    packages = ("scene", "mdr1d", "compare.accuracy")

    @property
    def label(self) -> str:
        """Short description for people."""
        shape, motion = type(self.scene.indenter).__name__.lower(), self.scene.motion
        return f"{shape} {motion.load:.3g} N, {motion.speed:.3g} m/s, {self.profiles} profiles at once"

    @property
    def work(self) -> float:
        """As of store, in passes over a node."""
        return 4.0 * self.profiles * self.points

    @property
    def question(self) -> Mapping:
        """The scene, its points, the number of profiles."""
        (scene,) = SCENES.dump_python((self.scene,), mode="json")
        return {"ensemble": scene, "points": self.points, "profiles": self.profiles}

    def solve(self) -> Outcome:
        """A row a profile."""
        found = solve_profiles([self.scene], [self.points], range(self.profiles))
        columns = found.friction[0].tolist(), found.depth[0].tolist(), found.sweeps[0].tolist()
        return Outcome(tuple(self._row(*numbers) for numbers in zip(*columns, strict=True)))

    def _row(self, friction, depth, sweeps):
        if isnan(friction):
            return Row(reason="no depth carries the load")
        load = self.scene.motion.load
        return Row(load, depth, load * friction, applications=sweeps)

    def failed(self, reason: str) -> Outcome:
        """A row a profile, each with the reason."""
        return Outcome((Row(reason=reason),) * self.profiles)

    def fits(self, outcome: Outcome) -> bool:
        """A row a profile."""
        return len(outcome.rows) == self.profiles


def shipped() -> list[Quantity]:
    """The collection whose baseline comes with the package."""
    return [*_at_rest(), *_smooth(), *_rough(), *_law(), *_withdrawal(), *_foundation()]


def _at_rest() -> Iterator[Quantity]:
    for name, shape in (SHAPES | {"quartic": QUARTIC}).items():
        scene = Scene(shape, parameters.SOLID, Indent(depth=_depth(shape)))
        yield _ratio(
            f"at rest, {name}: force 1D/3D",
            "normal_force",
            scene,
            AT_REST,
            "1 in theory; the rest is the discretisation of 3D",
        )


def _smooth() -> Iterator[Quantity]:
    """At the load whose static contact has the radius a."""
    for solid_name, solid in SOLIDS.items():
        for name, shape in SHAPES.items():
            load = elastic_contact(Scene(shape, solid, Indent(depth=_depth(shape)))).load
            for flow in (0.01, 1.0, 100.0):
                scene = Scene(shape, solid, Slide(speed=flow * RADIUS / TIME, load=load))
                where = f"sliding, smooth {name}, {solid_name}, v tau/a = {flow:g}"
                friction = "2 in the limit of low speed, unknown else"
                yield _ratio(f"{where}: friction 1D/3D", "friction_force", scene, SLIDING, friction)
                if flow >= 1:
                    yield _ratio(f"{where}: depth 1D/3D", "depth", scene, SLIDING, "1 at rest, unknown else")


def _rough() -> Iterator[Quantity]:
    """The paper's contacts with a shortest wave that both resolve."""
    for name, shape in SHAPES.items():
        rough = SelfAffine(hurst=parameters.CONTACT_HURST[name], rms_height=5e-5, longest=1e-2, shortest=5e-4)
        scene = Scene(shape, parameters.SOLID, Slide(speed=0.1, load=1.0), rough)
        pressed = replace(scene, motion=Indent(depth=elastic_contact(scene).depth))
        meaning = (
            f"mean over {PROFILES} profiles and {SURFACES} surfaces: holds their scatter beside the difference"
        )
        yield _ratio(f"at rest, rough {name}: force 1D/3D", "normal_force", pressed, AT_REST, meaning)
        for speed in (0.01, 0.1, 10.0):
            moved = replace(scene, motion=Slide(speed=speed, load=1.0))
            yield _ratio(
                f"sliding, rough {name}, {speed:g} m/s: friction 1D/3D", "friction_force", moved, SLIDING, meaning
            )


def _law() -> Iterator[Quantity]:
    """Fig. 4 of the paper at three xi."""
    slope = draw(parameters.ROUGH, parameters.POINTS).rms_slope
    for name in SHAPES:
        unit = variable(parameters.base(name, speed=1.0), slope)
        for xi in (0.01, 1.0, 100.0):
            scene = parameters.base(name, speed=xi / unit)
            yield Quantity(
                name=f"Fig. 4, {name}, xi = {xi:g}: friction 1D/Eq. 19",
                of="friction_coefficient",
                numerator=Profiles(scene, parameters.POINTS, PAPER_PROFILES),
                denominator=float(equations.plateau(slope) * equations.interpolation(xi)),
                tolerance=ROUNDING[0],
                reason=ROUNDING[1],
                meaning=f"mean over {PAPER_PROFILES} profiles against the law of the paper with alpha = 1.5",
            )


def _withdrawal() -> Iterator[Quantity]:
    """Pressed in at a constant rate for 2 s and drawn back as fast, on a solid that relaxes in 1 s."""
    solid, rate = StandardLinearSolid(1e6, 5e6, 1.0), RADIUS / 40
    times, depths = (0.0, 2.0, 4.0), (0.0, 2 * rate, 0.0)
    for name, shape in SHAPES.items():
        for time in (2.2, 2.5):
            stages = Stage(duration=2.0, depth=2 * rate), Stage(duration=time - 2, depth=(4 - time) * rate)
            force, _ = indentation.force_of_depth(shape, solid, times, depths, time)
            yield Quantity(
                name=f"withdrawal, {name}, {time:g} s: force 1D/Ting",
                of="normal_force",
                numerator=Task(MDR(points=400, steps=20), (Scene(shape, solid, Program(stages=stages)),)),
                denominator=float(force[0]),
                tolerance=ROUNDING[0],
                reason=ROUNDING[1],
                meaning="1 in theory; the rest is the grid of 400 points",
            )


def _foundation() -> Iterator[Quantity]:
    for solid_name, solid in SOLIDS.items():
        for name, shape in SHAPES.items():
            motion = Slide(speed=RADIUS / TIME, depth=_depth(shape))
            answers = foundation.sliding_forces(shape, solid, motion.speed, motion.depth)
            for of, known in zip(("normal_force", "friction_force"), answers, strict=True):
                yield Quantity(
                    name=f"foundation, {name}, {solid_name}, v tau/a = 1: {of.split('_')[0]} force 1D/exact",
                    of=of,
                    numerator=_line((Scene(shape, solid, motion),), MDR(points=400)),
                    denominator=float(known),
                    tolerance=ROUNDING[0],
                    reason=ROUNDING[1],
                    meaning="1 in theory; the rest is the grid of 400 points",
                )


def _depth(shape):
    """At which the smooth static contact has the radius RADIUS."""
    return shape.mdr_coefficient * RADIUS**shape.exponent


def _ratio(name, of, scene, bound, meaning):
    """1D over 3D."""
    drawn = _drawn(scene, SURFACES)
    tolerance, reason = bound
    return Quantity(
        name=name,
        of=of,
        numerator=_line(_drawn(scene, PROFILES), LINE),
        denominator=Task(SPACE, drawn, work=len(drawn) * SPACE.points**2.5 * 25.0),
        tolerance=tolerance,
        reason=reason,
        meaning=meaning,
    )


def _drawn(scene, count):
    """The scene with the seeds 1, 2, ...; a smooth body has one surface."""
    rough = scene.roughness
    if rough is None:
        return (scene,)
    return tuple(replace(scene, roughness=replace(rough, seed=1 + k)) for k in range(count))


def _line(scenes, solver):
    return Task(solver, scenes, work=len(scenes) * solver.points * 15.0)
