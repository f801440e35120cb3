"""Letters of panels, short texts beside points of a curve, and legends, where they cover nothing."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from string import ascii_lowercase

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox
from matplotlib.typing import ColorType

from scene.printable import printable

from . import style

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
# Between a text and what it must not cover [points].
GAP = 1.5
# Between legends and curves [points], and how often room is made for legends: curves beyond the limits come in.
ROOM, PASSES = 3.0, 5


def literal(text: str) -> str:
    """A text of a user's, such as a title, in which nothing is a formula to be set."""
    return printable(text).replace("$", r"\$")


@dataclass(frozen=True)
class Letter:
    """A text at a point of the axes' data; one that is not needed is written where it covers no line either."""

    text: str
    point: tuple[float, float]
    colour: ColorType | None = None
    needed: bool = True


def letter(k: int) -> str:
    """Letter of a panel: a to z, then aa to zz."""
    last = ascii_lowercase[k % 26]
    return last if k < 26 else ascii_lowercase[k // 26 - 1] + last


def lettered(panels: Iterable[Axes], count: int = 1) -> None:
    """A letter before the title of each panel. count : of panels side by side, so that long titles are broken"""
    for k, axes in enumerate(panels):
        text = f"({letter(k)}) {axes.get_title(loc='left')}".strip()
        if count > 1:
            style.head(axes, text, count)
        else:
            axes.set_title(text)


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
            color=letter.colour or style.ink(),
            ha=horizontal,
            va=vertical,
        )
        box = text.get_window_extent()
        within = inside.x0 <= box.x0 and box.x1 <= inside.x1 and inside.y0 <= box.y0 and box.y1 <= inside.y1
        if within and not any(box.padded(GAP * _scale(axes)).overlaps(other) for other in avoided):
            return box
        text.remove()
    return None


def _markers(axes) -> Iterator[Bbox]:
    """Around markers of the data, not those that stand on an axis, where no text does."""
    for line in axes.lines:
        placed = all(line.get_transform().contains_branch_seperately(axes.transData))
        if placed and line.get_marker() not in ("None", "none", "", None):
            yield from (_around(axes, at, MARKER) for at in _shown(line))


def _lines(axes) -> Iterator[Bbox]:
    for line in axes.lines:
        if line.get_linestyle() in ("None", "none", ""):
            continue
        at = _shown(line)
        for start, end in pairwise(at):
            count = max(2, int(np.hypot(*(end - start)) / (PITCH * _scale(axes))))
            yield from (_around(axes, start + t * (end - start), LINE) for t in np.linspace(0, 1, count))


def _shown(line):
    at = line.get_transform().transform(line.get_xydata())  # of level lines across, not that of the data
    return at[np.isfinite(at).all(axis=1)]


def _around(axes, at, half):
    half = half * _scale(axes)
    return Bbox([at - half, at + half])


def _scale(axes):
    return axes.figure.dpi / 72


def covered(axes: Axes, room: float = 0.0) -> int:
    """Number of places of curves, of which one is looked at every few points, the legend of the axes lies over.

    room : around the legend [points]; the figure has to be laid out
    """
    legend = axes.get_legend()
    if legend is None:
        return 0
    box, inside = legend.get_window_extent().padded(room * _scale(axes)), axes.get_window_extent()
    return sum(box.overlaps(each) and inside.overlaps(each) for each in (*_lines(axes), *_markers(axes)))


def clear(drawing: Figure, panels: Sequence[Axes] | np.ndarray) -> None:
    """Widen the vertical axes of panels whose legend lies over curves until it does not.

    Where the legend stands above, room is made above, else below; limits and scales have to be final otherwise.
    """
    engine = drawing.get_layout_engine()
    style.lay_out(drawing)
    for axes in panels:
        _settle(axes)
    for _ in range(PASSES):
        crowded = [axes for axes in panels if covered(axes, ROOM)]
        if not crowded:
            return
        for axes in crowded:
            _widen(axes)
        # Numbers along the axes are others now, and take other room.
        drawing.set_layout_engine(engine)
        style.lay_out(drawing)


def _settle(axes):
    """Leave the legend, if any, in the place that was found for it, of nine."""
    if (legend := axes.get_legend()) is None:
        return
    box, inside = legend.get_window_extent(), axes.get_window_extent()
    across = _side(box.x0 - inside.x0, inside.x1 - box.x1)
    up = _side(box.y0 - inside.y0, inside.y1 - box.y1)
    place = f"{('lower', 'center', 'upper')[up]} {('left', 'center', 'right')[across]}"
    legend.set_loc("center" if place == "center center" else place)


def _side(before, behind):
    """Alignment at the beginning, in the middle or at the end, by the gaps on both sides."""
    return 0 if before < behind / 2 else 2 if behind < before / 2 else 1


def _widen(axes):
    legend, inside = axes.get_legend(), axes.get_window_extent()
    box = legend.get_window_extent()
    above, right = box.y0 + box.y1 > inside.y0 + inside.y1, box.x0 + box.x1 > inside.x0 + inside.x1
    legend.set_loc(f"{'upper' if above else 'lower'} {'right' if right else 'left'}")
    margin = 2 * ROOM * _scale(axes)
    places = [
        each
        for each in (*_lines(axes), *_markers(axes))
        if box.x0 - margin < each.x1 and each.x0 < box.x1 + margin
    ]
    # What curves take of the height of the panel, over what the legend leaves them.
    free = inside.height - box.height - margin
    if above:
        taken = (max(min(each.y1, inside.y1) for each in places) - inside.y0) / free
    else:
        taken = (inside.y1 - min(max(each.y0, inside.y0) for each in places)) / free
    scale = axes.yaxis.get_transform()
    low, high = scale.transform(np.array(axes.get_ylim(), float))
    ends = (low, low + taken * (high - low)) if above else (high - taken * (high - low), high)
    axes.set_ylim(*scale.inverted().transform(np.array(ends)))
    style.decades(axes)
