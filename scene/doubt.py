"""Doubts about a scene: numbers beyond what the models allow or materials have, each with its limit and why.

One list of limits for every command and both solvers; nothing is solved for it.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import isfinite, isnan, nan
from operator import attrgetter
from typing import Any

import numpy as np

from .effects.temperature import COLDEST
from .magnitudes import WITHIN, Magnitudes
from .motion import Slide
from .scales import SMALL_SLOPE
from .scene import Scene
from .solids.fit import REACH

LINEAR_SLOPE = 1.0  # beyond which nothing of it is left
LEFT_OUT = 0.1  # share of a mean square beyond an end of a measured spectrum
ANISOTROPIC = 1.2  # ratio of the rms slopes along x and y above which a map is no isotropic one


class Doubtful(UserWarning):
    """Something about a scene or its answer that has to be looked at before its numbers are used."""


@dataclass(frozen=True)
class Doubt:
    """Doubt about one number of a scene; as a string, a sentence.

    name : of the number, in words
    number, limit : in SI
    unit : of both; empty of a pure number
    why : what is wrong beyond the limit
    remark : explains the number; meant : the quantity that was probably meant. Either may be empty
    """

    name: str
    number: float
    limit: float
    unit: str
    why: str
    remark: str = ""
    meant: str = ""

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        side = "above" if self.number > self.limit else "below"
        remark = f" ({self.remark})" if self.remark else ""
        text = f"{self.name} = {self.number:.3g}{unit}{remark}, {side} {self.limit:g}{unit}: {self.why}"
        return f"{text}; {self.meant}" if self.meant else text


@dataclass(frozen=True)
class Limit:
    """One end of what a number of `Magnitudes` may be.

    number : its name there, with dots; name : in words; limit, unit, why : of the `Doubt` beyond it
    most : whether it is the upper end
    meant : units that people forget to state, with what makes SI of them
    remark : function of the magnitudes that gives further numbers in words
    """

    number: str
    name: str
    limit: float
    unit: str
    why: str
    most: bool = True
    meant: tuple[tuple[str, Callable[[float], float]], ...] = ()
    remark: Callable[[Magnitudes], str] | None = None

    def doubt(self, found: Magnitudes) -> Doubt | None:
        """Doubt about a scene; None within the limit, and where the scene has no such number."""
        number = _known(lambda: float(attrgetter(self.number)(found)), nan)
        if not self.broken(number):
            return None
        guesses = (f"is {number:g} {unit} meant?" for unit, si in self.meant if not self.broken(si(number)))
        remark = "" if self.remark is None else _known(lambda: self.remark(found), "")
        return Doubt(self.name, number, self.limit, self.unit, self.why, remark, next(guesses, ""))

    def broken(self, number: float) -> bool:
        """Whether a number is beyond the limit; one that is not known is not."""
        return number > self.limit if self.most else number < self.limit


def doubts(scene: Scene, pixel: float | None = None) -> tuple[Doubt, ...]:
    """Doubts about a scene; empty where all its numbers are within their limits. Nothing is solved.

    pixel : of a grid [m], which cuts off roughness that states no shortest wave; without one such roughness has no
        slope that could be doubted
    """
    found = Magnitudes(scene, pixel)
    with np.errstate(all="ignore"):
        return tuple(doubt for limit in LIMITS if (doubt := limit.doubt(found)) is not None)


def beyond_linear(scene: Scene) -> Doubt | None:
    """Doubt about a slope, of body or roughness, that is beyond every linear theory of contact; else None."""
    slopes = (each for each in doubts(scene) if each.limit == SMALL_SLOPE and each.number > LINEAR_SLOPE)
    return max(slopes, key=lambda each: each.number, default=None)


def unseen(scene: Scene) -> tuple[Doubt, ...]:
    """Doubts about what a table of moduli does not show and the contact asks for: frequencies, modulus at rest."""
    found = Magnitudes(scene)
    limits = (each for each in LIMITS if each.name in (BELOW, ABOVE, OPEN))
    return tuple(doubt for limit in limits if (doubt := limit.doubt(found)) is not None)


def beyond_table(scene: Scene) -> Doubt | None:
    """Doubt about a modulus at rest that is open, or frequencies over a decade beyond a table; else None.

    Where the table is continued, frequencies beyond its continuation.
    """
    found = unseen(scene)
    return next((each for each in found if each.name == OPEN or each.number > Magnitudes(scene).reach), None)


def least_friction(scene: Scene) -> bool:
    """Whether friction is at least what is found, as a table of moduli ends before the frequencies of the contact.

    Within 1 % in 129 cases of the law in 3D, with tables that end 0.5 to 2 decades below the shortest wave.
    """
    ends, found = {BELOW: 0, ABOVE: 1}, Magnitudes(scene)
    return any(_bounded(found, ends[each.name]) for each in unseen(scene) if each.name in ends)


def notes(scene: Scene) -> tuple[str, ...]:
    """Notes on what was read for the parts of a scene: what was not used, and what was made of it."""

    def within(part: Any) -> Iterator[str]:
        for each in (part, *getattr(part, "__dict__", {}).values()):
            yield from getattr(each, "notes", ())

    return tuple(dict.fromkeys(note for part in scene.parts.values() for note in within(part)))


def _known(asked, otherwise):
    """A number of a scene; `otherwise` where the scene has no such number, or it leaves its range."""
    try:
        return asked()
    except (AttributeError, TypeError, ValueError, ArithmeticError, RuntimeError, MemoryError):
        return otherwise


def _times(factor):
    return lambda number: number * factor


MM, UM = ("mm", _times(1e-3)), ("um", _times(1e-6))
MPA, KJ, DEGC = ("MPa", _times(1e6)), ("kJ/mol", _times(1e3)), ("degC", lambda number: number + 273.15)
BELOW = "frequencies of the contact below those of the table"
ABOVE = "frequencies of the contact above those of the table"
OPEN = "width of the interval of the modulus at rest over that modulus"
EXTRAPOLATED = "the answer rests on an extrapolation of the table"
LINEAR = "both models are linear and hold for slopes that are small against 1"
STRAINS = "both models are linear and hold for strains that are small against 1"
ATOM, ATOMS = "less than an atom is wide", "a few atoms, where no solid is continuous"
SOFT, HARD = "softer than a gel", "stiffer than steel"
COLD, HOT = "every elastomer is a glass there", "no elastomer stands that"
POLYMERS = "polymers have some 5 to 30, and 20 to 200 K"
SPIKE = "a spike of the instrument? take it out before"
LARGE = "larger than tyres and wheels"


def _size(found):
    return f"radius of the contact {found.contact.radius:.3g} m, depth {found.contact.depth:.3g} m"


def _waves(found):
    return "" if isnan(found.shortest) else f"waves down to {found.shortest:.3g} m"


def _slopes(found):
    waves = found.scene.roughness.waves
    return f"{waves.rms_slope_x:.3g} along x, {waves.rms_slope_y:.3g} along y"


def _ends(name):
    """Both shares of a property of a measured spectrum, in words."""
    return lambda found: "longer waves {:.3g}, shorter waves {:.3g}".format(*getattr(found.scene.roughness, name))


def _seen(found):
    return f"{found.frequencies[0]:.2g} to {found.frequencies[-1]:.2g} rad/s, {found.state} throughout"


def _bounded(found, end):
    """Whether friction is at least what is found where nothing relaxes beyond an end of a table."""
    solid = found.measured
    within = isfinite(solid.glassy_modulus) if end else solid.equilibrium_modulus is None
    return within and not solid.extrapolate and isinstance(found.scene.motion, Slide)


def _beyond(end):
    """Sentence on frequencies beyond an end of a table: 0 is the lower end, 1 the upper."""

    def sentence(found):
        low, high = found.shown
        text = f"{found.asked[end]:.3g} rad/s, the table has {low:.3g} to {high:.3g} rad/s"
        solid = found.measured
        if solid.extrapolate:
            law = solid.continued.upper if end else solid.continued.lower
            return f"{text}; assumed that G'' goes on as frequency^{law.exponent:.2g} for {REACH:g} decades"
        least = ", so that friction is at least what is found" if _bounded(found, end) else ""
        return f"{text}; assumed that nothing relaxes there{least}, unless extrapolate = true"

    return sentence


def _readings(found):
    low, high = found.measured.equilibrium_interval
    return f"{low:.3g} Pa if the law goes on that the table ends with, to {high:.3g} Pa"


# In the order of the doubts: limits of single fields, then of numbers that follow from several.
LIMITS = (
    Limit("decades_below", BELOW, WITHIN, "decades", EXTRAPOLATED, remark=_beyond(0)),
    Limit("decades_above", ABOVE, WITHIN, "decades", EXTRAPOLATED, remark=_beyond(1)),
    Limit(
        "rest_width",
        OPEN,
        0.1,
        "",
        "the table ends before the plateau: measure at lower frequencies, or state equilibrium_modulus",
        remark=_readings,
    ),
    Limit("scene.temperature.temperature", "temperature", COLDEST, "K", COLD, False, (DEGC,)),
    Limit("scene.temperature.temperature", "temperature", 1000.0, "K", HOT),
    Limit("scene.temperature.reference", "reference temperature", COLDEST, "K", COLD, False, (DEGC,)),
    Limit("scene.temperature.reference", "reference temperature", 1000.0, "K", HOT),
    Limit(
        "scene.temperature.activation_energy",
        "activation energy",
        1e3,
        "J/mol",
        "less than heat itself gives",
        False,
        (KJ,),
    ),
    Limit(
        "scene.temperature.activation_energy", "activation energy", 1e6, "J/mol", "more than a chemical bond takes"
    ),
    Limit("scene.temperature.c1", "c1", 1.0, "", POLYMERS, False),
    Limit("scene.temperature.c1", "c1", 100.0, "", POLYMERS),
    Limit("scene.temperature.c2", "c2", 5.0, "K", POLYMERS, False),
    Limit("scene.temperature.c2", "c2", 1000.0, "K", POLYMERS),
    Limit("scene.solid.static_modulus", "shear modulus at rest", 1e3, "Pa", SOFT, False, (MPA,)),
    Limit("scene.solid.static_modulus", "shear modulus at rest", 1e11, "Pa", HARD),
    Limit("modulus_at_the_instant", "shear modulus at the instant", 1e11, "Pa", HARD),
    Limit("scene.indenter.radius", "radius of the body", 1.0, "m", LARGE, meant=(MM, UM)),
    Limit("scene.indenter.radius", "radius of the body", 1e-9, "m", ATOMS, False),
    Limit(
        "scene.layer.thickness",
        "thickness of the layer",
        1.0,
        "m",
        "thicker than any layer of rubber",
        meant=(MM, UM),
    ),
    Limit("scene.layer.thickness", "thickness of the layer", 1e-9, "m", ATOMS, False),
    Limit(
        "scene.roughness.period",
        "longest wave of the roughness",
        1.0,
        "m",
        "no roughness of a contact",
        meant=(MM, UM),
    ),
    Limit("shortest", "shortest wave of the roughness", 1e-9, "m", ATOMS, False),
    Limit("rms_height", "rms height of the roughness", 1e-10, "m", ATOM, False),
    Limit("scene.interface.coefficient", "coefficient of friction", 10.0, "", "no dry pair of bodies has it"),
    Limit("scene.heating.conductivity", "conductivity", 1e-2, "W/(m K)", "lower than in still air", False),
    Limit("scene.heating.conductivity", "conductivity", 3e3, "W/(m K)", "higher than in diamond"),
    Limit(
        "mach",
        "speed over the speed of shear waves",
        1.0,
        "",
        "neither model has inertia",
        remark=lambda found: f"speed {found.speed:g} m/s",
    ),
    Limit("contact.radius", "radius of the contact", 1.0, "m", LARGE),
    Limit("contact.radius", "radius of the contact", 1e-9, "m", ATOMS, False),
    Limit("contact.depth", "depth of the contact", 1e-10, "m", ATOM, False),
    Limit("edge_slope", "slope of the body at the edge of the contact", SMALL_SLOPE, "", LINEAR, remark=_size),
    Limit(
        "edge_slope",
        "slope of the body at the edge of the contact",
        1e-5,
        "",
        "flatter than any body",
        False,
        (),
        _size,
    ),
    Limit("rms_slope", "rms slope of the roughness", SMALL_SLOPE, "", LINEAR, remark=_waves),
    Limit("rms_slope", "rms slope of the roughness", 1e-4, "", "smoother than polished glass: check units", False),
    Limit(
        "height_left_out",
        "share of the mean square height beyond an end of the spectrum",
        LEFT_OUT,
        "",
        "if it goes on as it ends: measure a larger field, unless no waves longer than the contact matter",
        remark=_ends("height_left_out"),
    ),
    Limit(
        "slope_left_out",
        "share of the mean square slope beyond an end of the spectrum",
        LEFT_OUT,
        "",
        "if it goes on as it ends: slope and friction are those of the waves in the table alone",
        remark=_ends("slope_left_out"),
    ),
    Limit(
        "height_over_depth",
        "rms height of the roughness over the depth",
        1.0,
        "",
        "the contact rests on few peaks, and differs much from surface to surface",
    ),
    Limit(
        "anisotropy",
        "greater over lesser rms slope along x and y",
        ANISOTROPIC,
        "",
        "1D takes the map as isotropic: it cannot tell along from across",
        remark=_slopes,
    ),
    Limit("spike", "farthest height of the map over its rms height", 10.0, "", SPIKE),
    Limit("depth_over_thickness", "depth over the thickness of the layer", SMALL_SLOPE, "", STRAINS),
    Limit("pressure_over_modulus", "mean pressure over the modulus E* at rest", 1.0, "", STRAINS),
    Limit(
        "stiffening",
        "shear modulus at the speed over that at rest",
        1e4,
        "",
        "no elastomer stiffens so much before it is a glass: check times and speed",
    ),
    Limit(
        "loss",
        "greatest loss tangent that the contact sees",
        1e-2,
        "",
        "the elastomer loses next to nothing: check times, speed and temperature",
        False,
        remark=_seen,
    ),
)
