"""Ratio of 1D over 3D of one quantity, as it was measured on many draws of both."""

from dataclasses import dataclass

from scene import Scene

# Ratios that are learned: friction, depth and force of 1D over those of 3D, and friction by the law over 3D.
QUANTITIES = "friction", "depth", "force"
LAW = "law"
RATIOS = (*QUANTITIES, LAW)


@dataclass(frozen=True)
class Ratio:
    """Ratio of the mean over profiles in 1D and the mean over surfaces in 3D.

    logarithm : of the ratio; nan where one of the means is not above zero
    line_error : relative standard error of the mean in 1D
    scatter : relative standard deviation of one surface in 3D; nan of fewer than two
    surfaces : in 3D that would know their mean as well, if all of them were on all points
    grid : relative change of the mean in 3D from half the points to all
    """

    logarithm: float
    line_error: float
    scatter: float
    surfaces: float
    grid: float


def asked_of(scene: Scene) -> tuple[str, ...]:
    """Ratios that a scene has: of friction if it slides, of depth under a load, of force at a depth."""
    free = "depth" if scene.motion.pressed_by == "load" else "force"
    return ("friction", LAW, free) if scene.motion.speed else (free,)
