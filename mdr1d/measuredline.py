"""Rough lines by a measured one: drawn from the surface that is fitted to it, or the line itself."""

from scene import Profile
from scene.files.parts import said

from .surface import Surface, band_of, through
from .term import Term


class FittedRoughness(Term):
    """A measured line as the surface that is fitted to it; as a line scan, it is itself the rough line."""

    @property
    def says(self) -> str:
        """The line, and the surface from which lines are drawn."""
        return f'{said(self.part)} by {said(self.part.fitted)}; with spectrum = "line-scan" the line itself'


def draw(profile: Profile, nodes: int) -> Surface:
    """One period of the measured line on so many nodes, the point of its seed at the tip."""
    return through(profile.waves, nodes, band_of(profile, "line-scan"))
