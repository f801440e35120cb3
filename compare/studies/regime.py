"""Where each point of a study lies: the ratios of a rough contact that decide which laws can hold of it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from scene import Indent, Regime, Scene, Slide
from scene.indenter import Axisymmetric
from scene.scales import elastic_contact

from ..exact import mean_lag


@dataclass(frozen=True)
class PointRegime:
    """Ratios of rough contacts, numbers or arrays of one shape; NaN what was not measured.

    Radius a, depth d and load F_N are those of the smooth relaxed contact at the same load or depth; q_s is the
    highest wave number of the roughness, h' its rms slope as the solver measures it. The time tau is the mean lag
    of the elastomer, for a Kelvin body its relaxation time: v tau q_s is then the loss tangent of the shortest
    wave at low speed, whereas the longest retardation time may be that of a mode with next to no compliance.

    regime : ratios of lengths and slopes, and their flags, scene.Regime
    shortest_in_contact : a q_s
    pressure_over_slope : mean pressure over E* h', F_N / (pi a^2 E* h')
    memory_over_contact : v tau / a, zero at rest
    memory_over_shortest : v tau q_s, zero at rest
    contact_fraction : real over nominal contact, of area pi a^2 in three dimensions, of length 2a in one
    """

    regime: Regime
    shortest_in_contact: float
    pressure_over_slope: float
    memory_over_contact: float
    memory_over_shortest: float
    contact_fraction: float

    @classmethod
    def of(cls, scene: Scene, measures: Mapping[str, float]) -> "PointRegime":
        """Regime of a rough body of revolution that is pressed in or slides steadily.

        measures : of its answer, or their means over surfaces: rms_slope, pixel [m], and contact_area [m^2] in
            three dimensions or contact_length [m] in one

        Raises ValueError where the scene is another, KeyError where a measure is missing.
        """
        body, rough, motion = scene.indenter, scene.roughness, scene.motion
        if not (
            isinstance(body, Axisymmetric) and rough and not rough.flat and isinstance(motion, Indent | Slide)
        ):
            raise ValueError(
                f"scene = {scene!r}: these ratios are of a rough body of revolution, in Indent or Slide"
            )
        smooth, slope = elastic_contact(scene), measures["rms_slope"]
        a, q_s, memory = smooth.radius, rough.q_max(measures["pixel"]), motion.speed * mean_lag(scene.solid)
        profile = body.mdr_coefficient, body.exponent
        return cls(
            regime=Regime.of(profile, (a, smooth.depth), rough.rms_height, rough.period, slope),
            shortest_in_contact=a * q_s,
            pressure_over_slope=smooth.load / (pi * a**2 * scene.solid.indentation_modulus * slope),
            memory_over_contact=memory / a,
            memory_over_shortest=memory * q_s,
            contact_fraction=_contact_fraction(measures, a),
        )

    @property
    def depth_over_height(self):
        """d / h_0."""
        return 1 / self.regime.height_over_depth

    @property
    def words(self) -> str:
        """The ranges of all ratios, for a table; those that are zero or unknown everywhere are left out."""
        ratios = (
            ("d/h0", self.depth_over_height),
            ("a q_s", self.shortest_in_contact),
            ("2a/L", self.regime.contact_over_period),
            ("macro/rough slope", self.regime.macro_over_rough),
            ("rms slope", self.regime.rms_slope),
            ("p/(E* h')", self.pressure_over_slope),
            ("v tau/a", self.memory_over_contact),
            ("v tau q_s", self.memory_over_shortest),
        )
        said = [(name, _range(values), "") for name, values in ratios]
        said.append(("contact", _range(100 * np.asarray(self.contact_fraction)), " %"))
        return ", ".join(f"{name} {values}{unit}" for name, values, unit in said if values)


def gathered(points: Sequence[PointRegime]) -> PointRegime:
    """Points, one at least, as one with arrays (points,)."""

    def column(owners, name):
        return np.array([getattr(owner, name) for owner in owners])

    regimes = [point.regime for point in points]
    together = {name: column(points, name) for name in vars(points[0]) if name != "regime"}
    return PointRegime(Regime(*(column(regimes, name) for name in vars(regimes[0]))), **together)


def _contact_fraction(measures, radius):
    if "contact_area" in measures:
        return measures["contact_area"] / (pi * radius**2)
    return measures["contact_length"] / (2 * radius)


def _range(values):
    """Least and greatest of what is known, to two digits; empty where nothing is, or all is zero."""
    known = np.asarray(values)[np.isfinite(values)]
    if not known.any():
        return ""
    low, high = (f"{float(f'{end:.2g}'):g}" for end in (known.min(), known.max()))
    return low if low == high else f"{low} to {high}"
