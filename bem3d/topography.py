"""Roughness that was measured, as boundary elements take it up: the waves of its map, where they fit."""

from scene import Plane, Scene

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
                "cell of a Plane is a square: crop the map"
            )
        return reasons
