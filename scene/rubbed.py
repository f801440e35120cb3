"""Friction in the interface of a contact that slides, as every solver has it."""

from dataclasses import replace

from .motion import Program, Slide
from .result import Result
from .scene import Scene
from .terms import Term


class Rubbed(Term):
    """Coulomb's friction where no point of contact is left to stick; see `Coulomb`."""

    def refusals(self, scene: Scene) -> list[str]:
        if isinstance(scene.motion, Program):
            return [
                "interface = Coulomb: a history of partial slip is not simulated, and motion = Program takes no "
                "friction in the interface; use Slide or Shear, or leave interface out"
            ]
        return []

    def rubbed(self, result: Result) -> Result:
        """The answer, of sliding, with what the interface adds; any other as it is."""
        if not isinstance(result.scene.motion, Slide):
            return result
        friction = self.part.coefficient * result.normal_force
        total = result.friction_force + friction
        parts = {"friction_in_elastomer": result.friction_force, "friction_in_interface": friction}
        if "friction_error" in result.measures:  # that of the interface has none
            parts["friction_error"] = result.measures["friction_error"] * result.friction_force / total
        return replace(result, friction_force=total, measures={**result.measures, **parts})
