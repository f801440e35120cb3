"""A march through a program as it is seen instant by instant: made of the fields that both answers have kept."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from bem3d import BEM
from bem3d.sliding import Flow
from bem3d.wake import heights
from scene import Indent, Measured, Plane, Program, Refused, Scene, Slide, Stage

from ...report.views import BEFORE, BEHIND, Fields, Section, smooth_radius

LENGTHS = 4.0  # radii of the smooth relaxed contact that a start slides
LOADING, HELD = 0.2, 4.0  # of the time that it slides, or else of that over which it is pressed in
SLIGHTEST = 1e-3  # of the greatest normal force: of less friction, an axis does not show the noise
NOTICED = 99.5  # percentile of a history at which its axis ends: a touch may begin with a jump


@dataclass(frozen=True)
class Seen:
    """The contact in three dimensions at an instant: pressure [Pa] (M, N) at x (N,), y (M,) [m]; its section."""

    x: np.ndarray
    y: np.ndarray
    pressure: np.ndarray
    section: Section


@dataclass(frozen=True)
class Film:
    """A program as either solver or both have marched through it.

    scene : what was asked
    bem : the settings that the three-dimensional answer was solved with
    fields : by the name of the solver, with those at instants
    """

    scene: Scene
    bem: BEM
    fields: Mapping[str, Fields]

    @cached_property
    def times(self) -> np.ndarray:
        """Times of the instants [s] (F,)."""
        return self.fields["BEM" if "BEM" in self.fields else "MDR"]["frame_time"]

    @cached_property
    def radius(self) -> float | None:
        """Radius of the smooth relaxed contact under the greatest load or depth [m]; None where there is none."""
        return smooth_radius(self.scene)

    @cached_property
    def span(self) -> tuple[float, float]:
        """First and last x [m] that are seen: the grid in three dimensions, else a little around the contact."""
        if "BEM" in self.fields:
            x = self.fields["BEM"]["x"]
            half = (x[1] - x[0]) / 2
            return float(x[0] - half), float(x[-1] + half)
        touched = self.fields["MDR"]["frame_x"][self.fields["MDR"]["frame_contact"]]
        radius = self.radius or 0.0
        first, last = min(touched.min(initial=0.0), -radius), max(touched.max(initial=0.0), radius)
        return float(first - BEFORE * (last - first)), float(last + BEHIND * (last - first))

    def line(self, k: int) -> Section | None:
        """One dimension at the instant nearest to the k-th; None without it."""
        if "MDR" not in self.fields:
            return None
        fields = self.fields["MDR"]
        at = int(np.argmin(np.abs(fields["frame_time"] - self.times[k])))
        profile, depth = fields["frame_profile"][at], fields["frame_depth"][at]
        return Section(
            fields["frame_x"][at], profile - depth, -fields["frame_displacement"][at], fields["frame_contact"][at]
        )

    def space(self, k: int) -> Seen | None:
        """Three dimensions at the k-th instant; None without them."""
        if "BEM" not in self.fields:
            return None
        fields = self.fields["BEM"]
        x, y = fields["x"] + fields["frame_shift"][k], fields["y"]
        row, pressure = int(np.argmin(np.abs(y))), fields["frame_pressure"][k]
        indenter = heights(self.bem, self.scene, x, y[row : row + 1])[0] - fields["frame_depth"][k]
        section = Section(x, indenter, -fields["frame_displacement"][k, row], pressure[row] > 0)
        return Seen(x, y, pressure, section)

    def limits(self, name: str) -> tuple[float, float]:
        """Least and greatest of a force [N] in both, with zero, except the most extreme of some hundreds."""
        values = np.concatenate([fields[name] for fields in self.fields.values()])
        low, high = np.nanpercentile(values, [100 - NOTICED, NOTICED])
        noise = SLIGHTEST * max(fields["normal_force"].max() for fields in self.fields.values())
        return min(float(low), 0.0), max(float(high), 0.0, noise)


def started(scene: Scene) -> Scene:
    """The scene with the program that begins it: pressed in, then held, or set in motion for some lengths.

    A scene with a program is its own. Raises Refused for what no program holds.
    """
    motion = scene.motion
    if isinstance(motion, Program):
        return scene
    if not isinstance(motion, Slide | Indent) or motion.pressed_by == "gap":
        named = "gap" if motion.pressed_by == "gap" else type(motion).__name__
        raise Refused(f"motion: a {named} has no beginning that is told in time; state a program")
    pressed = {motion.pressed_by: motion.greatest}
    if motion.speed:
        duration = _length(scene) / motion.speed
        stages = Stage(duration=LOADING * duration, **pressed), Stage(duration=duration, speed=motion.speed)
    else:
        relaxing = Flow.of(scene.solid, 1.0).memory or 1.0  # an elastic contact takes no time
        stages = Stage(duration=relaxing, **pressed), Stage(duration=HELD * relaxing)
    return replace(scene, motion=Program(stages=stages))


def _length(scene):
    """Length that a start slides [m]: a period of a plane, a side of the map of a measured body."""
    if isinstance(scene.indenter, Plane):
        return scene.roughness.period
    if isinstance(scene.indenter, Measured):
        return scene.indenter.side
    return LENGTHS * (smooth_radius(replace(scene, layer=None)) or 0.0)
