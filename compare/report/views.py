"""View of one contact: the surfaces of indenter and elastomer in both dimensionalities, the wake included.

Made of the fields that are kept of an answer; nothing is solved.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from bem3d import BEM
from bem3d.sliding import Flow
from bem3d.wake import Surroundings, surroundings
from scene import Measured, Plane, Program, Scene, Slide
from scene.motion import pressed as pressed_in
from scene.scales import elastic_contact

Fields = Mapping[str, np.ndarray]

# Margins of the view, as fractions of the contact length, which is the greater of the contact's and the smooth
# relaxed contact's: before it, beside it, and behind it, there up to the most, so that as many memories fit in.
BEFORE, BESIDE, BEHIND, MOST_BEHIND, MEMORIES = 0.3, 0.15, 0.5, 2.0, 3.0


@dataclass(frozen=True)
class Section:
    """Heights along the flow, above the undeformed surface [m] (N,).

    x : from the axis of the indenter [m], downstream
    indenter, surface : of both bodies; the first NaN where the depth is not known
    touching : where they touch (bool)
    """

    x: np.ndarray
    indenter: np.ndarray
    surface: np.ndarray
    touching: np.ndarray


@dataclass(frozen=True)
class Space:
    """Three dimensions: what is around the contact, and the pressure there [Pa] (M, N)."""

    around: Surroundings
    pressure: np.ndarray

    @property
    def gap(self) -> np.ndarray:
        """Between indenter and elastomer [m] (M, N); 0 where they touch: what is left there is the residual."""
        return np.where(self.touching, 0.0, self.around.gap)

    @property
    def touching(self) -> np.ndarray:
        """Under pressure (M, N)."""
        return self.pressure > 0

    @property
    def section(self) -> Section:
        """Along the row of pixels nearest to the axis of the indenter."""
        around, row = self.around, int(np.argmin(np.abs(self.around.y)))
        return Section(
            around.x + around.lag,
            around.indenter[row] - around.depth,
            -around.displacement[row],
            self.touching[row],
        )


@dataclass(frozen=True)
class View:
    """A contact.

    scene : what was asked
    line : in one dimension; space : in three; None where there is no answer
    radius : of the smooth relaxed contact [m], half the width of a line; None where there is none
    span : (first, last) x [m] of what is worth seeing, aside : the farthest y
    """

    scene: Scene
    line: Section | None
    space: Space | None
    radius: float | None
    span: tuple[float, float]
    aside: float


def view(scene: Scene, bem: BEM, fields: Mapping[str, Fields]) -> View | None:
    """View made of the fields of answers by the name of their solver, of a program at its end; None without any.

    bem : the settings that the three-dimensional answer was solved with
    Also None where friction has heated the contact: the fields do not say how warm it is.
    """
    feeds_back = scene.heating is not None and scene.heating.feedback is not None
    if feeds_back or not {"MDR", "BEM"} & fields.keys():
        return None
    line = _line(fields["MDR"]) if "MDR" in fields else None
    radius, plane = _radius(scene), fields.get("BEM")
    touched = _touched(line, plane)
    if touched is None or isinstance(scene.indenter, Plane):
        span, aside = _whole(line, plane)
    else:
        span, aside = _worth_seeing(scene, touched, radius or 0.0)
    space = None if plane is None else _space(scene, bem, plane, span, aside)
    return View(scene, line and _prolonged(scene, line, span, fields["MDR"]), space, radius, span, aside)


def _radius(scene) -> float | None:
    """Radius of the smooth relaxed contact on a half-space [m], half the width of a line; None without one."""
    motion = scene.motion
    value = float(motion.prescribed(motion.duration)) if isinstance(motion, Program) else motion.greatest
    if isinstance(scene.indenter, Plane | Measured) or scene.layer is not None or not value > 0:
        return None
    held = pressed_in(motion.pressed_by, value)
    return elastic_contact(replace(scene, motion=held, roughness=None, interface=None)).radius


def _line(fields):
    """View of the line in 1D; where it touches, the displacement is the depth less the profile."""
    touching = fields["contact"].astype(bool)
    if "depth" in fields:
        depth = float(fields["depth"][-1])
    else:
        depth = float((fields["displacement"] + fields["profile"])[touching].mean()) if touching.any() else np.nan
    return Section(fields["x"], fields["profile"] - depth, -fields["displacement"], touching)


def _prolonged(scene, line, span, fields):
    """Section beyond its grid, as far as that is known: the surface arrives undisturbed, and behind the contact
    each mode recovers on its own from the forces that it has felt. A smooth body is c |x|^n.
    """
    if isinstance(scene.motion, Program):
        return line
    first, last, pixel = line.x[0], line.x[-1], line.x[1] - line.x[0]
    before = first - pixel * np.arange(int(max(first - span[0], 0.0) / pixel) + 1, 0, -1)
    behind = last + pixel * np.arange(1, int(max(span[1] - last, 0.0) / pixel) + 2)
    flow, ends = Flow.of(scene.solid, scene.motion.speed), (len(before), len(behind))
    felt = fields["line_force"][:-1] @ np.diff(np.exp((line.x - last)[:, None] / flow.lengths), axis=0)
    recovering = np.exp((last - behind)[:, None] / flow.lengths) @ (flow.shares * felt / flow.modulus)
    x = np.concatenate([before, line.x, behind])
    indenter = np.pad(line.indenter, ends, constant_values=np.nan)
    if scene.roughness is None:
        tip = float(line.indenter.min())
        indenter = tip + (line.indenter[-1] - tip) * np.abs(x / last) ** scene.indenter.exponent
    surface = np.concatenate([np.zeros(ends[0]), line.surface, -recovering])
    return Section(x, indenter, surface, np.pad(line.touching, ends))


def _touched(line, plane):
    """Least and greatest x, and greatest distance from the axis along y [m], of all contact; None without any."""
    x, y = [], [0.0]
    if line is not None:
        x += line.x[line.touching].tolist()
    if plane is not None:
        touching = plane["pressure"] > 0
        x += plane["x"][touching.any(axis=0)].tolist()
        y += np.abs(plane["y"][touching.any(axis=1)]).tolist()
    return (min(x), max(x), max(y)) if x else None


def _whole(line, plane):
    """Everything, where nothing touches or the surface repeats."""
    x = line.x if plane is None else plane["x"]
    aside = 0.0 if plane is None else np.abs(plane["y"]).max()
    half = (x[1] - x[0]) / 2
    return (float(x[0] - half), float(x[-1] + half)), float(aside + half)


def _worth_seeing(scene, touched, radius):
    first, last, aside = touched
    length = max(last - first, 2 * radius)
    speed = scene.motion.speed if isinstance(scene.motion, Slide) else 0.0
    wake = float(np.clip(MEMORIES * Flow.of(scene.solid, speed).memory / length, BEHIND, MOST_BEHIND))
    start, end = min(first, -radius), max(last, radius)
    seen = float(start - (BEFORE if speed else BEHIND) * length), float(end + wake * length)
    return seen, float(max(aside, radius) + BESIDE * length)


def _space(scene, bem, plane, span, aside):
    """View of the space in 3D, with the parts that the grid of the answer leaves out."""
    x, y = plane["x"], plane["y"]
    beyond = {
        "upstream": max(x[0] - span[0], 0.0),
        "downstream": max(span[1] - x[-1], 0.0),
        "aside": max(aside - min(-y[0], y[-1]), 0.0),
    }
    around = surroundings(bem, scene, plane, **beyond)
    rows, columns = (_padding(all_of_them, grid) for all_of_them, grid in ((around.y, y), (around.x, x)))
    return Space(around, np.pad(plane["pressure"], (rows, columns)))


def _padding(all_of_them, grid):
    """Places before and after those of the grid."""
    before = int(np.argmin(np.abs(all_of_them - grid[0])))
    return before, len(all_of_them) - len(grid) - before
