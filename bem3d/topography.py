"""Measured roughness in boundary elements: a map by its waves, a line by a fitted surface."""

from scene import Plane, Scene
from scene.scene import described
from scene.surfaces.topography import MOST_WAVES

from .term import Term

SQUARE = 1e-9  # relative, of sides that are alike


class MeasuredRoughness(Term):
    """The map repeats as it states; on a Plane, what repeats is the cell."""

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons to refuse maps with more waves than fit in memory, and cells that are no squares."""
        reasons, (along_x, along_y) = [], self.part.sides
        if (crowded := self.part.crowded) is not None:
            reasons.append(f"roughness = Topography has {crowded}")
        if isinstance(scene.indenter, Plane) and abs(along_x / along_y - 1) > SQUARE:
            reasons.append(
                f"roughness = Topography repeats after {along_x:g} m along x and {along_y:g} m along y, and the "
                "cell of a Plane is a square: take a part of the map"
            )
        return reasons


class FittedRoughness(Term):
    """A measured line as the isotropic surface that is fitted to it."""

    @property
    def says(self) -> str:
        """The line, and the surface that is solved."""
        return f"{described(self.part)} by {described(self.part.fitted)}"

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons to refuse surfaces with more waves than fit in memory."""
        waves = self.part.longest / self.part.shortest
        if waves < MOST_WAVES + 1:
            return []
        return [
            f"roughness = Profile has {waves:.0f} waves a side, {MOST_WAVES} fit in memory: state shortest_kept = "
            f"{1.01 * self.part.longest / MOST_WAVES:.3g} or more, or take a piece of the line"
        ]
