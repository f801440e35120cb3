"""Letters of panels, and short texts beside points of a drawn curve, where they cover nothing."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from string import ascii_lowercase

import numpy as np
from matplotlib.axes import Axes
from matplotlib.transforms import Bbox

# Around a point, where its text may stand: shift [points] and alignment.
PLACES = (
    (0, 4, "center", "bottom"),
    (0, -4, "center", "top"),
    (4, 0, "left", "center"),
    (-4, 0, "right", "center"),
    (4, 3, "left", "bottom"),
    (-4, 3, "right", "bottom"),
    (4, -3, "left", "top"),
    (-4, -3, "right", "top"),
    (0, 9, "center", "bottom"),
    (0, -9, "center", "top"),
    (10, 4, "left", "bottom"),
    (-10, 4, "right", "bottom"),
    (10, -4, "left", "top"),
    (-10, -4, "right", "top"),
)
# Half of what a marker and a line take, and how closely lines are followed [points].
MARKER, LINE, PITCH = 2.2, 0.5, 1.5


@dataclass(frozen=True)
class Letter:
    """A text at a point of the axes' data; one that is not needed is written where it covers no line either."""

    text: str
    point: tuple[float, float]
    colour: str = "black"
    needed: bool = True


def letter(k: int) -> str:
    """Of a panel: a to z, then aa to zz."""
    last = ascii_lowercase[k % 26]
    return last if k < 26 else ascii_lowercase[k // 26 - 1] + last


def write(axes: Axes, letters: Sequence[Letter], size: float) -> None:
    """Write each in the first place that is free; if none is, over a line, or not at all.

    The axes have to have their final limits and their place in the figure; size [points].
    """
    lines = list(_lines(axes))
    solid = [*_markers(axes), *(text.get_window_extent() for text in axes.texts)]
    inside = axes.get_window_extent()
    for letter in letters:
        for avoided in (solid + lines, solid) if letter.needed else (solid + lines,):
            if (box := _placed(axes, letter, size, avoided, inside)) is not None:
                solid.append(box)
                break


def _placed(axes, letter, size, avoided, inside):
    """The box of the text once it stands, None where there is no room."""
    for across, up, horizontal, vertical in PLACES:
        text = axes.annotate(
            letter.text,
            letter.point,
            xytext=(across, up),
            textcoords="offset points",
            fontsize=size,
            color=letter.colour,
            ha=horizontal,
            va=vertical,
        )
        box = text.get_window_extent()
        within = inside.x0 <= box.x0 and box.x1 <= inside.x1 and inside.y0 <= box.y0 and box.y1 <= inside.y1
        if within and not any(box.overlaps(other) for other in avoided):
            return box
        text.remove()
    return None


def _markers(axes) -> Iterator[Bbox]:
    for line in axes.lines:
        if line.get_marker() not in ("None", "none", "", None):
            yield from (_around(axes, at, MARKER) for at in _shown(axes, line))


def _lines(axes) -> Iterator[Bbox]:
    for line in axes.lines:
        if line.get_linestyle() in ("None", "none", ""):
            continue
        at = _shown(axes, line)
        for start, end in pairwise(at):
            count = max(2, int(np.hypot(*(end - start)) / (PITCH * _scale(axes))))
            yield from (_around(axes, start + t * (end - start), LINE) for t in np.linspace(0, 1, count))


def _shown(axes, line):
    at = axes.transData.transform(line.get_xydata())
    return at[np.isfinite(at).all(axis=1)]


def _around(axes, at, half):
    half = half * _scale(axes)
    return Bbox([at - half, at + half])


def _scale(axes):
    return axes.figure.dpi / 72
