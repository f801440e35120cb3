"""Numbers of a scene by which its size, slopes, stiffness and times are judged, without a solve."""

from dataclasses import replace
from functools import cached_property
from math import inf, isfinite, log10, nan, pi, sqrt

import numpy as np

from .indenter import Cylinder, Plane
from .motion import Program, Slide
from .scales import ElasticContact, elastic_contact
from .scene import Scene
from .solids.fit import REACH
from .solids.tabulated import Tabulated
from .surfaces.isotropic import Isotropic
from .surfaces.measured import Measured
from .surfaces.profile import Profile
from .surfaces.roughness import CrossedWaves
from .surfaces.topography import Topography

DENSITY = 1000.0  # [kg/m^3] of an elastomer, for the speed of its waves
DECADES = 1.0  # of frequency to either side of what a contact sees
SAMPLED = 25  # frequencies at which the loss is looked at
AGREED = 20  # steps until length and modulus agree: each leaves at most half of the difference
WITHIN = 0.1  # decades outside a table that are none: the frequencies of a contact are no better known


class Magnitudes:
    """Numbers of a scene in SI, each found once. What a scene lacks is NaN or raises AttributeError.

    pixel : of a grid [m], which cuts off roughness that states no shortest wave; None, such roughness has no slope

    Sizes of the contact are those of the smooth relaxed one on a half-space, at the greatest load or depth.
    """

    def __init__(self, scene: Scene, pixel: float | None = None):
        self.scene, self.pixel = scene, pixel

    @cached_property
    def contact(self) -> ElasticContact:
        """Smooth relaxed contact."""
        motion = self.scene.motion
        return elastic_contact(
            replace(self.scene, motion=motion.held) if isinstance(motion, Program) else self.scene
        )

    @property
    def edge_slope(self) -> float:
        """Slope of the body at the edge of the contact."""
        body, solid = self.scene.indenter, self.scene.elastomer
        # A table that is continued may come to rest decades below all that the contact asks for.
        continued = isinstance(solid, Tabulated) and solid.extrapolate
        radius = self.moving_length if continued else self.contact.radius
        if isinstance(body, Cylinder):
            return radius / body.radius
        return body.coefficient * body.exponent * radius ** (body.exponent - 1)

    @property
    def rms_height(self) -> float:
        """Rms height of the roughness [m]."""
        return nan if self.scene.roughness.flat else self.scene.roughness.rms_height

    @property
    def rms_slope(self) -> float:
        """Rms slope of the full gradient of the roughness."""
        rough = self.scene.roughness
        if rough.flat or (rough.shortest is None and self.pixel is None):
            return nan
        if isinstance(rough, Topography):
            return rough.waves.rms_slope
        q_max = rough.q_max(self.pixel or 1.0)
        if isinstance(rough, Isotropic | Profile):
            return rough.rms_slope(q_max)
        return rough.rms_height * q_max * (sqrt(2) if isinstance(rough, CrossedWaves) else 1.0)

    @property
    def height_left_out(self) -> float:
        """Share of the mean square height in waves beyond one end of a measured spectrum, the larger of both."""
        return max(self.scene.roughness.height_left_out)

    @property
    def slope_left_out(self) -> float:
        """Share of the mean square slope in waves beyond one end of a measured spectrum, the larger of both."""
        return max(self.scene.roughness.slope_left_out)

    @property
    def height_over_depth(self) -> float:
        """Rms height of the roughness over the depth."""
        return self.rms_height / self.contact.depth

    @property
    def anisotropy(self) -> float:
        """Greater over lesser rms slope of a measured map along x and y."""
        least, most = sorted((self.scene.roughness.waves.rms_slope_x, self.scene.roughness.waves.rms_slope_y))
        return most / least if least else (inf if most else nan)

    @property
    def spike(self) -> float:
        """Greatest distance of a height of a measured map from their mean, over their rms height."""
        if not isinstance(self.scene.roughness, Topography):
            return nan
        relief = self.scene.roughness.relief
        deviation = relief.std()
        return np.abs(relief - relief.mean()).max() / deviation if deviation else nan

    @property
    def shortest(self) -> float:
        """Shortest wave of the roughness [m]."""
        return nan if self.scene.roughness.shortest is None else self.scene.roughness.shortest

    @property
    def depth_over_thickness(self) -> float:
        """Prescribed depth over the thickness of the layer."""
        return (
            nan
            if self.scene.motion.pressed_by != "depth"
            else self.scene.motion.greatest / self.scene.layer.thickness
        )

    @property
    def pressure_over_modulus(self) -> float:
        """Mean pressure on a plane over the modulus E* at rest."""
        motion = self.scene.motion
        return motion.greatest / self.scene.solid.indentation_modulus if motion.pressed_by == "pressure" else nan

    @property
    def modulus_at_the_instant(self) -> float:
        """Glassy modulus in shear [Pa] of a solid that has one."""
        glassy = self.scene.solid.glassy_modulus
        return glassy if isfinite(glassy) else nan

    @cached_property
    def speed(self) -> float:
        """Greatest speed of sliding [m/s]."""
        motion = self.scene.motion
        return max(abs(each.speed) for each in motion.stages) if isinstance(motion, Program) else motion.speed

    @property
    def length(self) -> float:
        """Length that is slid over: the radius of the contact, of a plane the period [m]."""
        return self.scene.roughness.period if isinstance(self.scene.indenter, Plane) else self.contact.radius

    @cached_property
    def modulus_at_speed(self) -> float:
        """Modulus in shear [Pa] at the frequency with which the contact is slid over."""
        return abs(complex(self.scene.solid.complex_modulus(self.speed / self.length)))

    @property
    def stiffening(self) -> float:
        """Modulus in the contact over the modulus at rest."""
        return self.modulus_at_speed / self.scene.solid.static_modulus

    @property
    def mach(self) -> float:
        """Speed over the speed of shear waves in an elastomer with the modulus at this speed."""
        return self.speed / sqrt(self.modulus_at_speed / DENSITY)

    @cached_property
    def moving_length(self) -> float:
        """Length that is slid over [m], of a contact under a load as stiff as it is while it slides."""
        body, stiffer = self.scene.indenter, 1.0
        if self.scene.motion.pressed_by in ("load", "line_load"):
            power = 1 / 2 if isinstance(body, Cylinder) else 1 / (body.exponent + 1)
            for _ in range(AGREED):
                omega = self.speed / self.length * stiffer**power
                stiffer = abs(complex(self.scene.solid.complex_modulus(omega))) / self.scene.solid.static_modulus
            return self.length / stiffer**power
        return self.length

    @cached_property
    def asked(self) -> tuple[float, float]:
        """Lowest and highest angular frequency of the contact [rad/s], both zero at rest.

        Of its length and its shortest wave, and of the stages and oscillations of a program.
        """
        motion, rough, indenter = self.scene.motion, self.scene.roughness, self.scene.indenter
        found = []
        if self.speed > 0:
            found.append(
                self.speed / (indenter.side / 2 if isinstance(indenter, Measured) else self.moving_length)
            )
            if isinstance(indenter, Measured):
                found.append(self.speed * 2 * pi / indenter.shortest)
            elif rough is not None and not rough.flat and (rough.shortest is not None or self.pixel is not None):
                found.append(self.speed * rough.q_max(self.pixel or 1.0))
        if isinstance(motion, Program):
            found += [1 / motion.duration, *(1 / stage.duration for stage in motion.stages)]
            found += [
                2 * pi * swing.frequency for stage in motion.stages if (swing := stage.oscillation) is not None
            ]
        return min(found, default=0.0), max(found, default=0.0)

    @cached_property
    def measured(self) -> Tabulated:
        """Elastomer of a table, at the reference of its temperature."""
        solid = self.scene.elastomer.at_reference(self.scene.temperature)
        if not isinstance(solid, Tabulated):
            raise AttributeError("no table")
        return solid

    @property
    def shown(self) -> tuple[float, float]:
        """Lowest and highest angular frequency of the table at the temperature of the scene [rad/s]."""
        law = self.scene.temperature
        low, high = self.measured.frequencies
        return (low, high) if law is None else (low / law.shift, high / law.shift)

    @property
    def decades_below(self) -> float:
        """Decades by which the lowest frequency of a moving contact is below the table."""
        return log10(self.shown[0] / self.asked[0]) if self.asked[0] > 0 else nan

    @property
    def decades_above(self) -> float:
        """Decades by which the highest frequency of the contact is above the table."""
        return log10(self.asked[1] / self.shown[1]) if self.asked[1] > 0 else nan

    @property
    def reach(self) -> float:
        """Decades beyond the table up to which there is advice: one, or those of its continuation."""
        return REACH if self.measured.extrapolate else 1.0

    @property
    def rest_width(self) -> float:
        """Width of the interval of the modulus at rest over that modulus, where the contact asks for it."""
        low, high = self.measured.equilibrium_interval
        known = REACH if self.measured.extrapolate else WITHIN
        if self.asked[0] > 0 and not self.decades_below > known:
            raise AttributeError("the contact does not come to rest")
        return (high - low) / self.measured.static_modulus

    @cached_property
    def frequencies(self) -> np.ndarray:
        """Frequencies that a sliding contact sees [rad/s]: of its length, its shortest wave, and around."""
        if not (
            isinstance(self.scene.motion, Slide) and self.speed > 0 and len(self.scene.solid.retardation()[2])
        ):
            raise AttributeError("nothing that relaxes slides steadily")
        lowest = highest = self.speed / self.length
        if (rough := self.scene.roughness) is not None and not rough.flat and rough.shortest is not None:
            highest = max(highest, self.speed * rough.q_max(1.0))
        return np.geomspace(lowest * 10**-DECADES, highest * 10**DECADES, SAMPLED)

    @property
    def loss(self) -> float:
        """Greatest loss tangent at these frequencies."""
        modulus = self.scene.solid.complex_modulus(self.frequencies)
        return float((modulus.imag / modulus.real).max())

    @property
    def state(self) -> str:
        """Glassy or relaxed, whichever the elastomer is at these frequencies."""
        solid, middle = self.scene.solid, sqrt(self.frequencies[0] * self.frequencies[-1])
        geometric_mean = sqrt(solid.static_modulus) * sqrt(solid.glassy_modulus)
        return "glassy" if abs(complex(solid.complex_modulus(middle))) > geometric_mean else "relaxed"
