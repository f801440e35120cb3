"""Rubber at other temperatures than that at which it was measured, and contacts that their own friction heats."""

from collections.abc import Mapping, Sequence

import numpy as np

from compare.solving.outcome import Outcome
from compare.solving.task import SceneTask as Task
from compare.solving.task import Task as AnyTask

from .chapter import Chapter, Rows
from .figures import temperature as drawing
from .warmcontacts import (
    CONDUCTIVITIES,
    CONTACTS,
    FEEDBACKS,
    GLASS,
    HEAVY,
    POWER,
    ROOM,
    RUBBING,
    SEVERAL_AT,
    SOLVERS,
    TEMPERATURES,
    Point,
    every,
    points,
    shift,
)

NAME, TITLE = "temperature", "Temperature and frictional heating"
HEADING = (
    "Estimates, with their own feedback in brackets, and what either feedback makes of the loss in the rubber"
)
TEXT = """A smooth sphere of 50 mm on a rubber with a static modulus of 3 MPa and a loss that is a power of the
frequency, G'' ~ ω^{exponent:g}, in one dimension ({mdr} points) and in three ({bem} points a side). Its times
shift by the universal law of Williams, Landel and Ferry from a glass transition at {glass:g} K: the first kelvin
above {room:g} K makes them {first:.0f} % shorter.

**One curve.** Friction at {coldest:g} to {hottest:g} K, against speed times a_T, is one curve in each
dimensionality (panels a and b): a point is off its partner at {room:g} K by {collapse:.0e} at most. Nothing but
the times depends on the temperature, so that this is exact.

**The experiment of the paper.** A friction of {friction:g} in the interface, and what the rubber loses, on an
indenter of steel. The Methods of the paper give 0.06 K "at 100 N". That is the rise at 1 N, found {light:.3f} K,
and it is negligible: times are {light_shift:.1f} % shorter. At 100 N and the same speed it is {heavy:.2f} K and
{heavy_shift:.0f} %, at 20 mm/s {heaviest:.1f} K and {heaviest_shift:.0f} %, and once temperature and heat agree
the rubber loses {heavy_change:.0f} % and {heaviest_change:.0f} % less. Friction as a whole hardly feels it here,
where most of it is of the interface; were all of it loss, as the paper has it, it would fall by about as much. The
infrared camera of the experiment saw less than 1 K at 100 N and 10 mm/s: the estimate is that of a flat punch, and
3/2 of that of a sphere. With an indenter of a polymer the same formula gives {polymer_light:.0f} K to
{polymer_heavy:.0f} K, far beyond where the law of the shift holds: there it says no more than that the contact
does not stay as it was.

**Several temperatures.** Where friction grows with the temperature it feeds itself. Panel c has the rise of
temperature that friction makes, against by how much the contact is warmer; where they are equal, on the dotted
line, it is steady. On a standard linear solid with a hundredfold glassy modulus, under {load:g} N on the polymer
at {several_at:.2g} m/s, {solutions_1d} temperatures are steady in one dimension and {solutions_3d} in three. The
one given is the lowest, to which a contact warms up from the temperature of the scene; of three the middle one is
unstable, and the hottest is reached from above alone. Over the speed (panel d) the answer jumps: {jumps}. Friction
that differs little between the dimensionalities is there on two sides of an ignition."""


def tasks() -> list[Task]:
    """Every contact in both dimensionalities."""
    return every()


def chapter(outcomes: Mapping[AnyTask, Outcome]) -> Chapter:
    """What temperature and heat do to friction in both dimensionalities."""
    found = points(outcomes)
    rows = [vars(point) | {"reduced_speed": point.reduced_speed} for point in found]
    return Chapter(
        TEXT.format(**_numbers(found)),
        {HEADING: _experiment(found)},
        {drawing.NAME: drawing.figure(rows)},
        {drawing.NAME: rows},
    )


def _numbers(found: Sequence[Point]) -> dict[str, object]:
    steel, polymer = (_heated(found, "1D", conductivity) for conductivity in CONDUCTIVITIES.values())
    cold, warm = (_several(found, feedback) for feedback in ("", "average"))
    light, heavy, heaviest = (steel[contact] for contact in (CONTACTS[0], CONTACTS[3], CONTACTS[4]))
    return {
        "mdr": SOLVERS["1D"].points,
        "bem": SOLVERS["3D"].points,
        "exponent": POWER.exponent,
        "glass": GLASS,
        "room": ROOM,
        "first": 100 * (1 - shift(ROOM + 1)),
        "coldest": min(TEMPERATURES),
        "hottest": max(TEMPERATURES),
        "collapse": collapse(found),
        "friction": RUBBING.coefficient,
        "light": light[""].average_heating,
        "light_shift": _shorter(light),
        "heavy": heavy[""].average_heating,
        "heavy_shift": _shorter(heavy),
        "heavy_change": -_change(heavy, "average"),
        "heaviest": heaviest[""].average_heating,
        "heaviest_shift": _shorter(heaviest),
        "heaviest_change": -_change(heaviest, "average"),
        "polymer_light": min(each["average"].average_heating for each in polymer.values()),
        "polymer_heavy": max(each["average"].average_heating for each in polymer.values()),
        "load": HEAVY,
        "several_at": SEVERAL_AT,
        "solutions_1d": len(steady(found, "1D")),
        "solutions_3d": len(steady(found, "3D")),
        "jumps": "; ".join(_jump(dimension, cold[dimension], warm[dimension]) for dimension in SOLVERS),
    }


def collapse(found: Sequence[Point]) -> float:
    """Largest relative difference of friction between a temperature and its partner at the reference."""
    shifted, partners = ([p.friction for p in found if p.panel == panel] for panel in ("temperature", "partner"))
    return float(np.abs(np.divide(shifted, partners) - 1).max())


def steady(found: Sequence[Point], dimension: str) -> list[float]:
    """Rises of temperature [K] that friction itself makes, by straight lines between those that were solved."""
    part = [point for point in found if (point.panel, point.dimension) == ("warmer", dimension)]
    x = np.array([point.temperature - ROOM for point in part])
    excess = np.array([point.average_heating for point in part]) - x
    (crossed,) = np.nonzero(np.sign(excess[1:]) != np.sign(excess[:-1]))
    share = excess[crossed] / (excess[crossed] - excess[crossed + 1])
    return [float(rise) for rise in x[crossed] + share * (x[crossed + 1] - x[crossed])]


def _heated(found, dimension, conductivity):
    """Contact -> feedback -> point of the experiment."""
    part = [p for p in found if (p.panel, p.dimension, p.conductivity) == ("experiment", dimension, conductivity)]
    return {
        contact: {point.feedback: point for point in part if (point.load, point.speed) == contact}
        for contact in CONTACTS
    }


def _several(found, feedback):
    """Dimension -> points over the speed."""
    part = [point for point in found if (point.panel, point.feedback) == ("speed", feedback)]
    return {name: [point for point in part if point.dimension == name] for name in SOLVERS}


def _shorter(contact):
    """By how many percent times are shorter at the estimated temperature."""
    return 100 * (1 - shift(ROOM + contact[""].average_heating))


def _change(contact, feedback):
    """Of the loss inside the rubber with feedback [%]."""
    rubbed = RUBBING.coefficient
    return 100 * ((contact[feedback].friction - rubbed) / (contact[""].friction - rubbed) - 1)


def _jump(dimension, cold, warm):
    """Between which speeds the temperature falls most from one to the next, and friction with it."""
    rises = np.array([point.average_heating for point in warm])
    last = int(np.argmin(np.diff(np.log(rises))))
    before, after = warm[last], warm[last + 1]
    return (
        f"in {dimension} between {before.speed:.2g} and {after.speed:.2g} m/s from {before.average_heating:.0f} K "
        f"to {after.average_heating:.1f} K, and friction from {before.friction:.3f} to {after.friction:.3f} "
        f"(without heat {cold[last].friction:.3f} and {cold[last + 1].friction:.3f})"
    )


def _experiment(found: Sequence[Point]) -> Rows:
    """A row a contact, both dimensionalities."""
    rows = []
    for name, conductivity in CONDUCTIVITIES.items():
        both = {dimension: _heated(found, dimension, conductivity) for dimension in SOLVERS}
        for contact in CONTACTS:
            load, speed = contact
            row = {
                "indenter": f"{name}, {conductivity:g} W/(m K)",
                "F_N, N": f"{load:g}",
                "v, mm/s": f"{speed * 1e3:g}",
            }
            for dimension, heated in both.items():
                cold, average, flash = (heated[contact][feedback or ""] for feedback in FEEDBACKS)
                changes = (float(f"{_change(heated[contact], each):.2g}") for each in FEEDBACKS[1:])
                row |= {
                    f"average, K, {dimension}": f"{cold.average_heating:.3g} ({average.average_heating:.3g})",
                    f"flash, K, {dimension}": f"{cold.flash_heating:.3g} ({flash.flash_heating:.3g})",
                    f"loss inside, %, {dimension}": ", ".join(f"{change:+g}" for change in changes),
                }
            rows.append(row)
    return rows
