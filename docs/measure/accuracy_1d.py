"""The one-dimensional sections of the page of accuracy."""

from math import radians

from tables import order, table

from compare.models.exact.foundation import sliding_forces
from compare.models.exact.indentation import force_of_depth
from mdr1d import MDR
from scene import Cone, Kelvin, PowerLaw, Program, Scene, Slide, Sphere, Stage, StandardLinearSolid

HALF, MODULUS, TIME = 1e-3, 1e6, 1e-3
SHAPES = {"sphere": Sphere(10e-3), "cone": Cone(radians(10))}
SOLIDS = {
    "Kelvin": Kelvin(MODULUS, TIME),
    "standard linear, E_g/E_r = 10": StandardLinearSolid(MODULUS, 10 * MODULUS, TIME),
}
POINTS = (101, 201, 401, 801, 1601, 3201)
MEMORIES = (0.01, 0.1, 1.0, 10.0)


def sliding() -> str:
    """Steady sliding against the closed forms of the foundation."""

    def rows():
        for kind, shape in SHAPES.items():
            depth = shape.mdr_coefficient * HALF**shape.exponent
            for name, solid in SOLIDS.items():
                for ratio in MEMORIES:
                    speed = ratio * HALF / TIME
                    force, friction = sliding_forces(shape, solid, speed, depth)
                    scene = Scene(shape, solid, Slide(speed=speed, depth=depth))
                    found = [MDR(points=n, extent=2.2 * HALF).solve(scene) for n in POINTS]
                    of_force = [abs(each.normal_force / force - 1) for each in found]
                    of_friction = [abs(each.friction_force / friction - 1) for each in found]
                    yield (kind, name, f"{ratio:g}", *_errors(of_force), *_errors(of_friction))

    header = "shape|solid|v τ/a|F_N, 100 points|800|order|F_x, 100 points|800|order"
    return table(header, rows())


def _errors(errors):
    fitted = "exact" if max(errors) < 1e-11 else f"{order(POINTS, errors):.1f}"
    return f"{errors[0]:.1e}", f"{errors[3]:.1e}", fitted


def ting() -> str:
    """Pressing in and withdrawing, with the printed numbers of the references."""
    solid = StandardLinearSolid(rubbery_modulus=0.25, glassy_modulus=1.25, relaxation_time=1.0)
    bodies = {"sphere, R = 1": Sphere(1.0), "cone, slope 1": PowerLaw(coefficient=1.0, exponent=1.0)}

    def rows():
        for name, shape in bodies.items():
            for end in (2.0, 2.2, 2.5):
                stages = [Stage(duration=2.0, depth=0.2)]
                if end > 2:
                    stages.append(Stage(duration=end - 2, depth=0.2 - 0.1 * (end - 2)))
                scene = Scene(shape, solid, Program(stages=tuple(stages)))
                (exact,), _ = force_of_depth(shape, solid, (0.0, 2.0, 4.0), (0.0, 0.2, 0.0), end)
                found = [MDR(points=n).solve(scene).normal_force for n in POINTS]
                errors = [abs(force / exact - 1) for force in found]
                yield (name, f"{end:g}", f"{exact:.7f}", f"{found[-1]:.7f}", *_errors(errors))

    return table("shape|t|Ting|MDR, 3200 points|error at 100 points|800|order", rows())


SECTIONS = {
    "One dimension: sliding against closed forms": (
        "The foundation itself has closed forms in steady sliding (`compare.models.exact.foundation`): Kelvin and "
        "standard linear, at the depth whose static contact has the half-width a. Relative errors, the grid over "
        "2.2 a. A cone is linear between nodes, so that nothing is left of its error.",
        sliding,
    ),
    "One dimension: pressing in and withdrawing": (
        "E_r = 1, E_g = 5, relaxation time 1; the depth rises at 0.1 to t = 2 and falls as fast: force against "
        "Lee and Radok while loading, Ting while withdrawing (`compare.models.exact.indentation`).",
        ting,
    ),
}
