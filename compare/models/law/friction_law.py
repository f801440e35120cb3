"""`FrictionLaw`: friction of a rough body of revolution from its spectrum, in three dimensions."""

from dataclasses import dataclass as frozen_parts
from dataclasses import replace
from math import exp, hypot, inf, nan, pi, sqrt
from time import process_time
from typing import Any, ClassVar, cast

import numpy as np
from pydantic.dataclasses import dataclass

from scene import Indent, Plane, Result, Scene, Slide
from scene.protocol import refuse, trusted
from scene.quantities import CLOSED
from scene.scales import elastic_contact
from scene.signatures import readable
from scene.terms import Term, terms_of

from .bands import Bands, FullContact
from .nominal import NominalContact
from .persson import BODY, SPACE, TERMS
from .share import Share
from .smooth import SmoothContact

# At a depth it answers for the load of the smooth body.
TERMS = {**TERMS, Plane: BODY, Indent: Term, Slide: Term}
PASSES = 2  # of the window, which is as wide as the contact, which depends on what the window leaves
# Outside the law: waves that carry the contact as a whole with an rms height over the depth of so much, which are
# bodies of their own; and less contact than of so many of the shortest waves.
RIDDEN, SPOTS = 0.15, 0.3
# Half of an interval of 95 % in ln mu: the root of the squares of what each of these numbers adds, as fitted to
# scenes that were solved for it.
AT_LEAST, BY_ROUGHNESS, BY_LIGHTNESS, BY_HEIGHT, BY_RIDDEN = 0.0088, 0.104, 0.154, 1.06, 2.0
NOTHING_KNOWN = 7.0  # a factor of a thousand: wider intervals say no more


@frozen_parts(frozen=True)
class LawParts:
    """What the law makes friction of.

    contact : of the smooth body
    smooth, rough : parts of the friction coefficient
    radius : of a disc with the spread of the nominal pressure, of which the smooth contact's is the radius [m]
    full : friction of all waves in full contact, an area [Pa]
    pressure : rms of theirs in full contact [Pa]
    share : S(x) of these waves
    height, ridden : rms heights over the depth at rest: of all waves; of those that carry the contact as a whole
    wave : the shortest [m]
    """

    contact: SmoothContact
    smooth: float
    rough: float
    radius: float
    full: float
    pressure: float
    share: Share
    height: float
    ridden: float
    wave: float

    @property
    def friction_coefficient(self) -> float:
        """Friction coefficient [1]."""
        return self.smooth + self.rough

    @property
    def x(self) -> float:
        """Mean nominal pressure over the rms pressure of full contact."""
        return self.contact.load / (pi * self.radius**2 * self.pressure) if self.pressure else inf

    @property
    def outside(self) -> bool:
        """Whether the roughness is none to the contact: a body of its own, or too few spots."""
        return self.ridden > RIDDEN or self.x * (self.radius / self.wave) ** 2 < SPOTS

    @property
    def doubt(self) -> float:
        """Half of the interval of 95 % of ln mu, as the law was off where it was tried."""
        of_it = self.rough / self.friction_coefficient if self.rough else 0.0
        light = BY_LIGHTNESS * min(self.x, 1.0) ** -0.25
        parts = AT_LEAST, of_it * BY_ROUGHNESS, of_it * light, BY_HEIGHT * self.height, BY_RIDDEN * self.ridden
        return min(hypot(*parts), NOTHING_KNOWN)

    @classmethod
    def of(cls, scene: Scene, smooth: SmoothContact | None = None) -> "LawParts":
        """Parts of a rough scene. Raises SolveError where the smooth or the nominal contact has no answer.

        smooth : its smooth contact, solved here if absent
        """
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
            full=friction,
            pressure=pressure,
            share=share,
            height=waves.rms_height / rest,
            ridden=sqrt(max(waves.rms_height**2 - bands.rms_height**2, 0.0)) / rest,
            wave=2 * pi / waves.q[-1],
        )


@readable
@dataclass(frozen=True, config=CLOSED)
class FrictionLaw:
    """Friction in three dimensions: that of the smooth body, and a share of that of all waves in full contact.

    mu = mu_smooth + (1/F_N) int F_full S(p / p_rms) dA: F_full is the friction an area of all waves in full
    contact, p_rms the rms of their pressure, both from the spectrum; S the share that partial contact leaves, as
    measured on rough planes; p the pressure of the body on its roughness as a soft layer. Waves on which the
    contact rides as a whole, by their height and tilt under it, are taken out.

    The smooth sliding contact is solved in three dimensions on 64 points; all else follows in closed form. There
    is no claim on depth or force of a rough body: `depth` is NaN, and at a prescribed depth friction is that under
    the load of the smooth body. Of a smooth body the answer is that of its solve.

    Result.measures: friction_low, friction_high, the interval of 95 % of the mean over surfaces; outside, 1 where
    the roughness is none to the contact: waves longer than it and higher than 0.15 of its depth, or less contact
    than a third of a square of the shortest wave; the interval is wide there. friction_of_shape,
    friction_of_roughness [N]; nominal_radius [m]; pressure_ratio x, nominal pressure over p_rms;
    share_of_full_contact S(x); full_contact_friction [N], F_full times the nominal area. There are no fields.
    """

    label: ClassVar[str] = "3D law"
    draws: ClassVar[str] = "none"  # it answers with the mean
    answers: ClassVar[tuple[str, ...]] = ("friction",)
    # Whose code and data the answer depends on.
    packages: ClassVar[tuple[str, ...]] = ("bem3d", "compare.models.exact", "compare.models.law")

    @property
    def name(self) -> str:
        return "FrictionLaw"

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why the law does not answer the scene, one sentence each."""
        reasons = [reason for term in terms_of(TERMS, scene) for reason in term.refusals(scene)]
        return reasons or SPACE.refusals(replace(scene, roughness=None))

    def foreseen(self, scene: Scene) -> list[str]:
        """Reasons why the smooth contact would have no answer, as far as a coarse one shows."""
        return SPACE.foreseen(replace(scene, roughness=None))

    def solve(self, scene: Scene) -> Result:
        """Friction and its parts. Raises Refused, and SolveError where the smooth contact has no answer."""
        start = process_time()
        refuse(self, scene)
        with trusted():
            if scene.roughness is None or scene.roughness.flat:
                smooth = SmoothContact.of(scene)
                own, rough, depth = smooth.friction_coefficient, 0.0, smooth.depth
                told = {"nominal_radius": smooth.radius}
            else:
                parts = LawParts.of(scene)
                smooth, own, rough, depth = parts.contact, parts.smooth, parts.rough, nan
                factor = exp(parts.doubt)
                told = {
                    "friction_low": (own + rough) / factor,
                    "friction_high": (own + rough) * factor,
                    "outside": float(parts.outside),
                    "nominal_radius": parts.radius,
                    "pressure_ratio": parts.x,
                    "share_of_full_contact": float(parts.share(np.array(parts.x))),
                    "full_contact_friction": parts.full * pi * parts.radius**2,
                }
        return Result(
            scene=scene,
            solver=self.name,
            settings={"points": SPACE.points},
            normal_force=smooth.load,
            depth=depth,
            friction_force=(own + rough) * smooth.load,
            residual=smooth.residual,
            operator_applications=smooth.operator_applications,
            seconds=process_time() - start,
            measures={"friction_of_shape": own * smooth.load, "friction_of_roughness": rough * smooth.load} | told,
        )
