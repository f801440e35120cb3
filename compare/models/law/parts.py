"""Friction of a rough body of revolution in three dimensions from its spectrum: its parts, and S(x) of planes."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from math import inf, log, nan, pi, prod, sqrt
from pathlib import Path
from typing import Any, NamedTuple, cast

import numpy as np

from scene import Plane, Scene
from scene.scales import elastic_contact

from .bands import Bands, FullContact, cell_area
from .nominal import NominalContact
from .smooth import SmoothContact

FITTED = Path(__file__).with_name("share.csv")
# Between which pressures, over the rms pressure of full contact, it bends; below it is in proportion to them.
LEAST, MOST = 5e-3, 2.0


@dataclass(frozen=True)
class Share:
    """S(x) = 1 - exp{-x e^A (1 + B x) (x + 0.01)^C}, x the pressure over the rms pressure of full contact.

    Within the powers x is at least LEAST and at most MOST, so that S is in proportion to light pressures, and 1 in
    full contact.

    level, bend, power : A, B, C [1]
    """

    level: float
    bend: float
    power: float

    @classmethod
    def of(cls, full: FullContact) -> "Share":
        """Share of these waves, by the coefficients of `share.csv`."""
        return cls.summed(coefficients(), waves(full))

    @classmethod
    def summed(cls, values: Mapping[tuple[str, str], float], known: Mapping[str, Any]) -> "Share":
        """Share with A, B, C the sums of coefficients times numbers of waves, or products of these, as "a*b"."""
        sums: dict[str, Any] = {name: 0.0 for name in ("level", "bend", "power")}
        for (name, times), value in values.items():
            sums[name] = sums[name] + value * prod(known[each] for each in times.split("*"))
        return cls(**sums)

    def __call__(self, x: Any) -> Any:
        """Share at pressures x >= 0, of any shape."""
        inside = np.clip(x, LEAST, MOST)
        return -np.expm1(
            -x * np.exp(self.level) * np.maximum(1 + self.bend * inside, 0.05) * (inside + 0.01) ** self.power
        )


def waves(full: FullContact) -> dict[str, float]:
    """Numbers of waves in full contact that coefficients are multiplied by, by name."""
    names = "lossy", "along", "across", "shorter", "harder", "rising", "faster"
    return {"one": 1.0, **{name: getattr(full, name) for name in names}}


@cache
def rows_of(path: Path) -> list[dict[str, Any]]:
    """Rows of a table that comes with the package, texts by column."""
    with path.open(encoding="utf-8", newline="") as file:
        return [*csv.DictReader(file)]


def coefficients() -> Mapping[tuple[str, str], float]:
    """Coefficients by what they add to, and what they are multiplied by."""
    return {(row["to"], row["times"]): float(row["value"]) for row in rows_of(FITTED)}


PASSES = 2  # of the window, which is as wide as the contact, which depends on what the window leaves


@dataclass(frozen=True)
class LawParts:
    """Law of friction in three dimensions: friction of the smooth body plus a share of the friction of all waves.

    mu = mu_smooth + (1/F_N) int F_full S(p / p_rms) dA: F_full is the friction an area of all waves in full
    contact, p_rms the rms of their pressure, both from the spectrum; S the share that partial contact leaves, as
    measured on rough planes; p the pressure of the body on its roughness as a soft layer. Waves on which the
    contact rides as a whole, by their height and tilt under it, are taken out.

    contact : of the smooth body
    smooth, rough : parts of the friction coefficient
    radius : radius [m] of a disc with the spread of the nominal pressure; for the pressure of the smooth contact
        it is the radius of this contact
    waves : in full contact
    height, ridden : rms heights over the depth at rest: of all waves; of those that carry the contact as a whole
    """

    contact: SmoothContact
    smooth: float
    rough: float
    radius: float
    waves: FullContact
    height: float
    ridden: float

    @property
    def friction_coefficient(self) -> float:
        """Friction coefficient [1]."""
        return self.smooth + self.rough

    @property
    def share(self) -> Share:
        """S(x) of the waves."""
        return Share.of(self.waves)

    @property
    def x(self) -> float:
        """Mean nominal pressure over the rms pressure of full contact."""
        pressure = float(self.waves.pressure[-1])
        return self.contact.load / (pi * self.radius**2 * pressure) if pressure else inf

    @classmethod
    def of(cls, scene: Scene, smooth: SmoothContact | None = None) -> "LawParts":
        """Parts of a rough scene. Raises SolveError where the smooth or the nominal contact has no answer.

        All friction of a plane is that of its roughness, and it rides on none of its waves.

        smooth : its smooth contact, solved here if absent
        """
        if isinstance(scene.indenter, Plane):
            return cls.of_plane(scene)
        smooth = SmoothContact.of(scene) if smooth is None else smooth
        n, speed, solid = scene.indenter.exponent, scene.motion.speed, scene.solid
        rest, rough = elastic_contact(scene).depth, cast(Any, scene.roughness)
        # A fast contact is small, and deeper than one of its size at rest.
        depth = max(smooth.depth, scene.indenter.mdr_coefficient * smooth.radius**n)
        bare = NominalContact.smooth(n, smooth.radius, smooth.load)
        waves, found, radius = Bands.of(rough), bare, smooth.radius
        for _ in range(PASSES):
            bands = waves.beneath(radius)
            full = FullContact.of(bands, solid, speed)
            pressure = float(full.pressure[-1])
            found = bare.on_layer(n, depth, bands.rms_height, pressure)
            radius = smooth.radius * found.spread / bare.spread
        share = Share.of(full)
        friction = float(full.friction.sum())
        bare_lost = bare.lost(solid, speed)
        return cls(
            contact=smooth,
            smooth=smooth.friction_coefficient * (found.lost(solid, speed) / bare_lost if bare_lost else 1.0),
            rough=friction * float(np.sum(share(found.pressure / pressure) * found.area)) / smooth.load,
            radius=radius,
            waves=full,
            height=waves.rms_height / rest,
            ridden=sqrt(max(waves.rms_height**2 - bands.rms_height**2, 0.0)) / rest,
        )

    @classmethod
    def of_plane(cls, scene: Scene) -> "LawParts":
        """Parts of a rough plane under a pressure, of which `height` is NaN."""
        rough, pressed = cast(Any, scene.roughness), cast(float, scene.motion.pressure)
        full = FullContact.of(Bands.of(rough), scene.solid, scene.motion.speed)
        contact, share = SmoothContact.of_plane(pressed, cell_area(rough)), Share.of(full)
        rubbed = float(full.friction.sum() * share(pressed / full.pressure[-1])) / pressed
        return cls(contact, 0.0, rubbed, contact.radius, full, nan, 0.0)


TESTED = Path(__file__).with_name("outside.csv")
DEPTH = "depth"
UNTESTED = {"friction": log(3.0), DEPTH: 3.0}  # half an interval where no contact was tested: a guess


class Tested(NamedTuple):
    """Errors of one surface by the bare law, on contacts whose waves are too many for the trust map.

    least, most : p/p_rms of the contacts; contacts : their number, 0 where none was tested
    half : half an interval of 95 %: of the logarithm of friction, or of the depth over the rms height
    """

    least: float
    most: float
    contacts: float
    half: float

    @property
    def words(self) -> str:
        """What the interval rests on."""
        if not self.contacts:
            return "no contact like it was tested, and its interval is a guess"
        return f"{self.contacts:g} contacts with p/p_rms of {self.least:g} to {self.most:g} were that far off"


def known_errors(scene: Scene, x: float, quantity: str = "friction") -> Tested:
    """Errors of tested contacts of this kind of body; x : p/p_rms, above MOST of which all waves touch."""
    kind, x = (quantity, "plane" if isinstance(scene.indenter, Plane) else "body"), min(x, MOST)
    for row in rows_of(TESTED):
        found = Tested(*(float(row[name]) for name in Tested._fields))
        if (row["quantity"], row["body"]) == kind and found.least <= x < found.most:
            return found
    return Tested(x, x, 0, UNTESTED[quantity])
