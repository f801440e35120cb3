"""`Persson`: his theory of contact and friction of a rough plane, carried over to bodies of revolution."""

from dataclasses import replace
from math import nan, sqrt
from time import process_time
from typing import Annotated, ClassVar, cast

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass
from scipy.special import erf

from scene import Cylinder, Indent, Plane, Profile, Program, Result, Scene, Shear, Slide, Topography, Wave
from scene import Measured as MeasuredBody
from scene.effects.temperature import TemperatureLaw
from scene.indenter import Axisymmetric
from scene.protocol import numeric_guard, refuse
from scene.quantities import CLOSED, Finite
from scene.signatures import readable
from scene.solids.viscoelastic import Linear
from scene.surfaces.isotropic import Isotropic
from scene.terms import Term, refused_parts, unsupported

from . import bands
from .bands import Bands, FullContact, cell_area
from .smooth import SPACE, SmoothContact

# Rms slope of a map in one direction over that across, up to which it counts as isotropic: scenes with such maps
# were solved, and the law missed them no more than others.
MOST_DIRECTED = 1.35


class Spectrum(Term):
    """Roughness with a spectrum."""

    def refusals(self, scene: Scene) -> list[str]:
        if self.part.shortest is None and not self.part.flat:
            return ["roughness.shortest is absent: the theory counts waves down to the shortest; state shortest"]
        return []


class Measured(Term):
    """Map or line that was measured: the spectrum of its waves, or of the surface that is fitted to it."""

    def refusals(self, scene: Scene) -> list[str]:
        rough = self.part
        if isinstance(rough, Topography) and rough.crowded is not None:
            return [f"roughness = Topography has {rough.crowded}"]
        if (directed := 1.0 if rough.flat else bands.directed(rough)) > MOST_DIRECTED:
            return [
                f"roughness = {type(rough).__name__} has {directed:.3g} times the rms slope along one direction "
                f"that it has across: the theory is of isotropic surfaces, up to {MOST_DIRECTED:g} is allowed"
            ]
        return []


class Pressed(Term):
    """Motion under a load or a mean pressure, and of a smooth body also to a depth."""

    def refusals(self, scene: Scene) -> list[str]:
        by, instead = self.part.pressed_by, "pressure" if isinstance(scene.indenter, Plane) else "load"
        rough = scene.roughness is not None and not scene.roughness.flat
        if rough and by in ("depth", "gap"):
            return [
                f"motion.{by} = {self.part.greatest:g}: the theory makes no claim on the {by} of a rough body; "
                f"{instead} is allowed"
            ]
        return []


BODY = unsupported("a body of revolution (Sphere, Cone, PowerLaw) or a Plane is allowed")
ROUGHNESS = unsupported(
    "the theory is of a spectrum; SelfAffine with a shortest wave, Spectrum, Topography or Profile is allowed"
)
MOTION = unsupported("the theory is of steady sliding; Slide or Indent is allowed")
TERMS = {
    **dict.fromkeys((Axisymmetric, Plane, Linear, TemperatureLaw), Term),
    **dict.fromkeys((Cylinder, MeasuredBody), BODY),
    **dict.fromkeys((Indent, Slide), Pressed),
    **dict.fromkeys((Shear, Program), MOTION),
    Wave: ROUGHNESS,
    Isotropic: Spectrum,
    **dict.fromkeys((Topography, Profile), Measured),
}


class WithoutGap(Term):
    """Motion to a gap, which no law of friction knows."""

    def refusals(self, scene: Scene) -> list[str]:
        if self.part.pressed_by == "gap":
            return [f"motion.gap = {self.part.greatest:g}: the law makes no claim on the gap; pressure is allowed"]
        return []


# Terms of the friction law, which takes bodies at a depth too.
OF_LAW = {**TERMS, Indent: WithoutGap, Slide: WithoutGap}


@readable
@dataclass(frozen=True, config=CLOSED)
class Persson:
    """Persson's theory: waves touch by the share of the area that is in contact when no shorter ones are seen.

    gamma : None for the theory as published in 2001; 0 to 1 for its later factor; Persson takes 1/2

    Of the waves up to q the share P(q) = erf(p / (sqrt(2) p_rms(q))) touches, p_rms(q) the rms pressure of these
    waves in full contact, and friction an area is the sum over waves of that in full contact times P; Persson,
    J. Chem. Phys. 115, 3840 (2001). With gamma each is also multiplied by gamma + (1 - gamma) P^2; Lorenz, Oh,
    Nam, Jeon and Persson, J. Chem. Phys. 142, 194701 (2015).

    That is the answer for a Plane. On a body of revolution under a load the roughness adds the friction that goes
    with the pressure at each place of the smooth sliding contact, which is solved in three dimensions on 64
    points. A smooth body has the answer of this solve; at rest there is no friction.

    There is no claim on the depth of a rough body, nor on the gap of a plane: `depth` is NaN, and a prescribed
    depth or gap is refused. Where little touches of a plane (pressure_ratio 0.02) the area is 30 % below that in
    three dimensions at low speed and 45 % above it at high speed, friction 43 % below and 62 % above; with
    gamma = 1/2 friction is 71 % and 15 % below. From a ratio of 2 on both are within 3 % (theory, Eq. 11c).

    Result.measures: contact_area [m^2], with all waves down to the shortest; contact_fraction, this area over the
    area of the cell or of the smooth contact; friction_of_shape, friction_of_roughness [N]; pressure_ratio, mean
    pressure over p_rms of all waves. There are no fields.
    """

    draws: ClassVar[str] = "none"  # it answers with the mean
    answers: ClassVar[tuple[str, ...]] = ("friction",)
    # Whose code the answer depends on.
    packages: ClassVar[tuple[str, ...]] = ("bem3d", "compare.models.exact", "compare.models.law")

    gamma: Annotated[Finite, Field(ge=0, le=1)] | None = None

    @property
    def name(self) -> str:
        return "Persson" if self.gamma is None else f"Persson-{self.gamma:g}"

    @property
    def label(self) -> str:
        return "Persson" if self.gamma is None else f"Persson, gamma = {self.gamma:g}"

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why the theory does not answer the scene, one sentence each."""
        reasons = refused_parts(TERMS, scene)
        if reasons or isinstance(scene.indenter, Plane):
            return reasons
        return SPACE.refusals(replace(scene, roughness=None))

    def foreseen(self, scene: Scene) -> list[str]:
        """Reasons why the smooth contact would have no answer, as far as a coarse one shows."""
        return [] if isinstance(scene.indenter, Plane) else SPACE.foreseen(replace(scene, roughness=None))

    def solve(self, scene: Scene) -> Result:
        """Friction and area of contact. Raises Refused, and SolveError where the smooth contact has no answer."""
        start = process_time()
        refuse(self, scene)
        plane, rough = isinstance(scene.indenter, Plane), scene.roughness is not None and not scene.roughness.flat
        with numeric_guard():
            if plane:
                pressure, cell = cast(float, scene.motion.pressure), cell_area(scene.roughness)
                smooth, area, mean = SmoothContact.of_plane(pressure, cell), cell, pressure
            else:
                smooth = SmoothContact.of(scene)
                area, mean = smooth.area, smooth.mean_pressure
            touching, of_roughness, ratio = area, 0.0, {}
            if rough:
                friction, share, x = self._roughness(scene, smooth.pressure, mean)
                touching, of_roughness = (float(each.sum()) * smooth.pixel_area for each in (share, friction))
                ratio = {"pressure_ratio": x}
        of_shape = smooth.friction_coefficient * smooth.load
        return Result(
            scene=scene,
            solver=self.name,
            settings={"gamma": self.gamma} | ({} if plane else {"points": SPACE.points}),
            normal_force=smooth.load,
            depth=nan if rough else smooth.depth,
            friction_force=of_shape + of_roughness,
            residual=smooth.residual,
            operator_applications=smooth.operator_applications,
            seconds=process_time() - start,
            measures={
                "contact_area": touching,
                "contact_fraction": touching / area,
                "friction_of_shape": of_shape,
                "friction_of_roughness": of_roughness,
                **ratio,
                **({"mean_pressure": mean} if plane else {}),
            },
        )

    def _roughness(self, scene, pressure, mean):
        """Friction an area [Pa] and share in contact at pressures [Pa], and mean pressure over the rms of all."""
        full = FullContact.of(Bands.of(scene.roughness), scene.solid, scene.motion.speed)
        # A band touches as its middle does, up to which half of its own pressure counts.
        squares = np.square(full.pressure)
        middle = np.sqrt((squares + np.concatenate([[0.0], squares[:-1]])) / 2)
        touching = touching_share(pressure[:, None] / middle)
        kept = touching if self.gamma is None else touching * (self.gamma + (1 - self.gamma) * touching**2)
        largest = float(full.pressure[-1])
        return kept @ full.friction, touching_share(pressure / largest), mean / largest


def touching_share(ratio: np.ndarray) -> np.ndarray:
    """Share of the area in contact, erf(x / sqrt(2)), x = pressure over the rms of the waves in full contact."""
    return erf(ratio / sqrt(2))
