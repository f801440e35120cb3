"""A surface seen obliquely from above: a block with a deformed top, in parallel projection, lit from one side.

Faces are drawn from the farthest to the nearest, so that what is near covers what is far. Heights are enlarged by
a number that is stated.
"""

from dataclasses import dataclass
from math import radians
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator

from ...figures import style, touching
from ...figures.prefixes import prefixed

# Height of the relief as drawn, at most, and of the block below it, as shares of the deeper side of the surface.
TALL, BLOCK = 0.22, 0.08
EXAGGERATIONS = np.outer(10.0 ** np.arange(-3, 10), (1, 2, 3, 5)).ravel()
LIGHT = np.array([-0.45, 0.35, 0.82])  # towards the light, from the left and behind
DULLEST, ON_PRESSURE = (
    0.45,
    0.5,
)  # of full light in full shade; of that shade, how much lies on colours of pressure
TICK = 0.018  # of the width of the picture
CMAP = "viridis_r"


@dataclass(frozen=True)
class Camera:
    """Parallel projection from the front right.

    azimuth, elevation : [rad]; exaggeration : how often heights are enlarged
    """

    azimuth: float = radians(24)
    elevation: float = radians(42)
    exaggeration: float = 1.0

    def place(self, x, y, z) -> tuple[np.ndarray, np.ndarray]:
        """Across and up in the picture, of points that lie along x, y and up."""
        x, y, z = np.broadcast_arrays(x, y, z)
        away = y * np.cos(self.azimuth) - x * np.sin(self.azimuth)
        up = away * np.sin(self.elevation) + self.exaggeration * z * np.cos(self.elevation)
        return x * np.cos(self.azimuth) + y * np.sin(self.azimuth), up

    def aspect(self, width: float, depth: float) -> float:
        """Height over width of a level surface in the picture."""
        across, up = self.place(np.array([0, width, width, 0]), np.array([0, 0, depth, depth]), 0.0)
        return float(np.ptp(up) / np.ptp(across))

    @property
    def tilt(self) -> float:
        """Angle of a line along x in the picture [degrees]."""
        across, up = self.place(*np.eye(3)[0])
        return float(np.degrees(np.arctan2(up, across)))


def exaggeration(width: float, depth: float, relief: float) -> float:
    """Round number by which heights are enlarged, on a surface of a width and a depth, and a relief [m]."""
    fitting = EXAGGERATIONS[EXAGGERATIONS * relief <= TALL * max(width, depth)]
    return float(fitting.max(initial=EXAGGERATIONS[0])) if relief > 0 else 1.0


def block(axes: Axes, x, y, height, pressure, highest: float, camera: Camera) -> ScalarMappable:
    """Block of elastomer with a deformed top, coloured where there is pressure; returns what its colours mean.

    x (N,), y (M,) ; height, pressure (M, N), on axes without a frame to which the projection gives equal scales
    """
    base = height.min() - BLOCK * max(np.ptp(x), np.ptp(y)) / camera.exaggeration
    far = slice(None, None, -1)  # rows behind one another, the farthest first
    across, up = camera.place(x[None, :], y[far, None], height[far])
    scale = ScalarMappable(Normalize(0, highest), CMAP)
    middle = _faces(pressure)
    colours = np.where(middle[..., None] > 0, scale.to_rgba(middle)[..., :3], touching.elastomer())
    shade = _shade(x, y, height, camera.exaggeration)
    shade = np.where(middle > 0, 1 - ON_PRESSURE * (1 - shade), shade)[..., None]
    mesh = axes.pcolormesh(
        across, up, np.clip(colours * shade, 0, 1)[far], shading="flat", rasterized=True, antialiased=False
    )
    mesh.set_edgecolor("face")
    mesh.set_linewidth(0.1)
    _wall(axes, camera, x, np.full_like(x, y[0]), height[0], base, 0.86)
    _wall(axes, camera, np.full_like(y, x[-1]), y, height[:, -1], base, 0.72)
    axes.set(aspect="equal", anchor="N")
    axes.set_axis_off()
    return scale


def _wall(axes, camera, x, y, top, base, sun):
    """A side of the block, with the level of the undeformed surface."""
    colour = sun * np.array(touching.elastomer())
    across, up = camera.place(x, y, top)
    foot = camera.place(x[::-1], y[::-1], base)
    axes.fill(np.append(across, foot[0]), np.append(up, foot[1]), color=colour, linewidth=0)
    axes.plot(across, up, color=touching.skin(), linewidth=style.width(0.65))
    axes.plot(*camera.place(x[[0, -1]], y[[0, -1]], 0.0), **style.line(0.35, 0.5, linestyle=(0, (5, 3))))


def ruled(axes: Axes, x, y, height, camera: Camera) -> None:
    """Scales along the lower edges of the block, x in front and y at the right, and one of heights at the left."""
    base = height.min() - BLOCK * max(np.ptp(x), np.ptp(y)) / camera.exaggeration
    scale, unit = prefixed([*x[[0, -1]], *y[[0, -1]]], "m")
    length = TICK * (np.ptp(x) + np.ptp(y))
    for along, name, place, out, sides in (
        (x, "x", lambda t: camera.place(t, y[0], base), (0.0, -1.0), ("center", "top")),
        (y, "y", lambda t: camera.place(x[-1], t, base), (1.0, -0.45), ("left", "top")),
    ):
        ticks = _ticks(scale * along[[0, -1]]) / scale
        feet = np.transpose(place(ticks))
        ends = feet + length * np.array(out)
        lines = LineCollection([*zip(feet, ends, strict=True)], colors=[style.ink()], linewidths=style.width(0.5))
        axes.add_collection(lines)
        look: dict[str, Any] = {"fontsize": style.small(), "ha": sides[0], "va": sides[1]}
        for tick, (across, up) in zip(ticks, ends + 0.4 * length * np.array(out), strict=True):
            axes.text(across, up, f"{scale * tick:.10g}".replace("-", "−"), **look)
        middle = np.transpose(place(along[[0, -1]].mean())) + 4.2 * length * np.array(out)
        axes.text(middle[0], middle[1], f"{name} [{unit}]", **look | {"fontsize": style.size()})
    _standing(axes, x, y, height, camera, length)


def _standing(axes, x, y, height, camera, length):
    """A bar as high as a round height, at the left behind, with how often heights are enlarged."""
    lengths = EXAGGERATIONS * 1e-12
    size = float(lengths[lengths <= np.ptp(height)].max(initial=lengths[0]))
    scale, unit = prefixed(size, "m")
    across, up = camera.place(x[0], y[0], np.array([height[0, 0] - size, height[0, 0]]))
    across = across - 1.5 * length
    axes.plot(across, up, color=style.ink(), linewidth=style.width(0.9), solid_capstyle="butt")
    text = f"{scale * size:g} {unit}"
    axes.text(across[0] - 0.5 * length, up.mean(), text, fontsize=style.small(), ha="right", va="center")


def arrow(axes: Axes, x, y, height, camera: Camera, text: str, forwards: bool) -> None:
    """Arrow along x above the far edge, with words: which way what presses slides, forwards along -x."""
    lift = height.max() + 0.07 * np.ptp(y) / camera.exaggeration
    part = np.array([0.9, 0.55] if forwards else [0.55, 0.9])
    across, up = camera.place(x[0] + part * np.ptp(x), y[-1], lift)
    look = {"arrowstyle": "-|>", "color": style.ink(), "linewidth": style.width(0.9), "shrinkA": 0, "shrinkB": 0}
    start, end = zip(across, up, strict=True)
    axes.annotate("", end, start, arrowprops=look, annotation_clip=False)
    axes.plot(across, up, alpha=0.0)  # by which the axes make room
    axes.text(
        across.mean(),
        up.mean() + 0.02 * np.ptp(x),
        text,
        fontsize=style.small(),
        ha="center",
        va="bottom",
        rotation=camera.tilt,
        rotation_mode="anchor",
    )


def _faces(values):
    """Means over the four corners of each face."""
    return (values[1:, 1:] + values[1:, :-1] + values[:-1, 1:] + values[:-1, :-1]) / 4


def _shade(x, y, height, enlarged):
    """Light on each face, from DULLEST to 1."""
    along_y, along_x = np.gradient(enlarged * height, y, x)
    normal = np.stack([-_faces(along_x), -_faces(along_y), np.ones((len(y) - 1, len(x) - 1))], -1)
    lit = normal @ LIGHT / np.linalg.norm(normal, axis=-1) / np.linalg.norm(LIGHT)
    level = LIGHT[2] / np.linalg.norm(LIGHT)
    return np.clip(1 + (lit - level) * (1 - DULLEST), DULLEST, 1.15)


def _ticks(ends) -> np.ndarray:
    """A few round numbers between two."""
    ticks = np.asarray(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]).tick_values(*ends))
    return ticks[(ends[0] <= ticks) & (ticks <= ends[1])]
