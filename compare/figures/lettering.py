"""Letters of panels, short texts beside points of a curve, and legends, where they cover nothing."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from string import ascii_lowercase

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox
from matplotlib.typing import ColorType

from scene.printable import printable

from . import style

# Around a point, where its text may stand: how far [points], and on which sides of it, the nearest first.
AWAY = 4, 7, 10
SIDES = (0, 1), (0, -1), (1, 0), (-1, 0), (1, 0.75), (-1, 0.75), (1, -0.75), (-1, -0.75)
ACROSS, UP = {0: "center", 1: "left", -1: "right"}, {0: "center", 1: "bottom", -1: "top"}
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
    """A text at a point of the axes' data."""

    text: str
    point: tuple[float, float]
    colour: ColorType


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
    """Write each in the first place in which it covers nothing and no other marker is nearer, or not at all.

    The axes have to have their final limits and their place in the figure; size [points].
    """
    marks = list(_markers(axes))
    centres = [mark.get_points().mean(axis=0) for mark in marks]
    taken = [*marks, *_lines(axes), *(text.get_window_extent() for text in axes.texts)]
    for letter in letters:
        if (box := _placed(axes, letter, size, centres, taken)) is not None:
            taken.append(box)


def _placed(axes, letter, size, centres, taken):
    """The box of the text once it stands, None where there is no room."""
    dark = 0.65 * np.array(to_rgb(letter.colour)) + 0.35 * np.array(to_rgb(style.ink()))
    look = {"textcoords": "offset points", "fontsize": size, "color": tuple(dark.tolist())}
    inside, gap, own = axes.get_window_extent(), GAP * _scale(axes), axes.transData.transform(letter.point)
    for away, (across, up) in product(AWAY, SIDES):
        place = {"xytext": (away * across, away * up), "ha": ACROSS[across], "va": UP[np.sign(up)]}
        text = axes.annotate(letter.text, letter.point, **place, **look)
        box = text.get_window_extent().padded(gap)
        within = inside.x0 <= box.x0 and box.x1 <= inside.x1 and inside.y0 <= box.y0 and box.y1 <= inside.y1
        apart = [np.hypot(*np.maximum(np.maximum(box.min - at, at - box.max), 0)) for at in (own, *centres)]
        if within and apart[0] <= min(apart) + gap and not any(box.overlaps(other) for other in taken):
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
