"""`FrictionLaw`: friction of a rough body in three dimensions, from its spectrum and the trust map."""

from dataclasses import replace
from math import exp, nan, pi
from time import process_time
from typing import ClassVar

from pydantic.dataclasses import dataclass

from scene import Plane, Result, Scene
from scene.protocol import numeric_guard, refuse
from scene.quantities import CLOSED
from scene.signatures import readable
from scene.terms import refused_parts

from ..models.law.parts import LawParts, known_errors
from ..models.law.persson import OF_LAW
from ..models.law.smooth import SPACE, SmoothContact
from .measured import OffTheMap, Place, as_judged
from .model import LAW, NORMAL


@readable
@dataclass(frozen=True, config=CLOSED)
class FrictionLaw:
    """Friction in three dimensions: the law, divided by the ratio of law and 3D that the trust map predicts.

    The law stands in `LawParts`: friction of the smooth body, and a share of the friction of all waves in full
    contact. The smooth sliding contact is solved in three dimensions on 64 points; all else follows in closed
    form. The map has learned how far the law is off from scenes that were solved in three dimensions. Where it
    does not know the ratio, the answer is the bare law and has no interval.

    There is no claim on depth or force of a rough body: `depth` is NaN, and at a prescribed depth friction is
    computed under the load of the smooth body. A smooth body has the answer of its solve.

    Result.measures: bare_friction, the coefficient of the law alone; law_ratio, law over 3D; friction_low and
    friction_high, interval of 95 % of the mean over surfaces; outside, 1 where the map does not know the ratio,
    which is NaN, so that the interval is that of one surface. friction_of_shape, friction_of_roughness [N], parts
    of the bare law; nominal_radius [m]; pressure_ratio x, nominal pressure over p_rms; share_of_full_contact S(x);
    full_contact_friction [N], F_full times the nominal area. There are no fields.
    """

    label: ClassVar[str] = "3D law"
    draws: ClassVar[str] = "none"  # it answers with the mean
    answers: ClassVar[tuple[str, ...]] = ("friction",)
    # Whose code and data the answer depends on.
    packages: ClassVar[tuple[str, ...]] = ("mdr1d", "bem3d", "compare.models", "compare.trustmap")

    @property
    def name(self) -> str:
        return "FrictionLaw"

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why the law does not answer the scene, one sentence each."""
        reasons = refused_parts(OF_LAW, scene)
        return reasons or _smooth(scene, SPACE.refusals)

    def foreseen(self, scene: Scene) -> list[str]:
        """Reasons why the smooth contact would have no answer, as far as a coarse one shows."""
        return _smooth(scene, SPACE.foreseen)

    def solve(self, scene: Scene) -> Result:
        """Friction and its parts. Raises Refused, and SolveError where the smooth contact has no answer."""
        start = process_time()
        refuse(self, scene)
        with numeric_guard():
            if scene.roughness is None or scene.roughness.flat:
                smooth = SmoothContact.of(scene)
                friction, depth, own = smooth.friction_coefficient, smooth.depth, smooth.friction_coefficient
                measures = {"friction_of_roughness": 0.0, "nominal_radius": smooth.radius}
            else:
                parts, ratio, error = _law_over_3d(scene)
                smooth, depth, own, bare = parts.contact, nan, parts.smooth, parts.friction_coefficient
                known = ratio == ratio
                friction, factor = bare / ratio if known else bare, exp(NORMAL * error)
                measures = {
                    "friction_of_roughness": parts.rough * smooth.load,
                    "bare_friction": bare,
                    "law_ratio": ratio,
                    "friction_low": friction / factor,
                    "friction_high": friction * factor,
                    "outside": float(not known),
                    "nominal_radius": parts.radius,
                    "pressure_ratio": parts.x,
                    "share_of_full_contact": float(parts.share(parts.x)),
                    "full_contact_friction": float(parts.waves.friction.sum()) * pi * parts.radius**2,
                }
        return Result(
            scene=scene,
            solver=self.name,
            settings={"points": SPACE.points},
            normal_force=smooth.load,
            depth=depth,
            friction_force=friction * smooth.load,
            residual=smooth.residual,
            operator_applications=smooth.operator_applications,
            seconds=process_time() - start,
            measures={"friction_of_shape": own * smooth.load} | measures,
        )


def _smooth(scene, asked):
    """What a solver says of the smooth body in place of the rough one; nothing of a rough plane."""
    rough = scene.roughness is not None and not scene.roughness.flat
    return [] if isinstance(scene.indenter, Plane) and rough else asked(replace(scene, roughness=None))


def _law_over_3d(scene: Scene) -> tuple[LawParts, float, float]:
    """Parts of the law, its ratio to three dimensions, and the standard error of the logarithm of the ratio.

    The ratio is NaN where the map does not know it, and the error that of tested contacts; 1 and 0 where nothing
    rubs.
    """
    try:
        place = Place.of(as_judged(scene))
        parts, known = place.law, not place.beyond
    except OffTheMap:
        parts, known = LawParts.of(scene), False
    if not parts.friction_coefficient:
        return parts, 1.0, 0.0
    if not known:
        return parts, nan, known_errors(scene, parts.x).half / NORMAL
    logarithm, error, _ = place.predicted(LAW)
    return parts, exp(logarithm), error
