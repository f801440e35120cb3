"""Letters of panels, short texts beside points of a curve, and legends, where they cover no curve."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from string import ascii_lowercase
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.transforms import Bbox
from matplotlib.typing import ColorType
from numpy import ndarray

from scene.printable import printable

from . import style

# Offset of a text from its point [points] and its alignment, in the order in which they are tried.
PLACES = (
    ((0, 4), "center", "bottom"),
    ((0, -4), "center", "top"),
    ((5, 0), "left", "center"),
    ((-5, 0), "right", "center"),
)
MARKER, ROOM = 2.2, 3.0  # around a marker, and between legends and curves [points]


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
    """Write each above, below or beside its point, wherever it covers nothing, or not at all.

    The axes have to have their final limits and their place in the figure; size [points].
    """
    inside, taken = axes.get_window_extent(), [text.get_window_extent() for text in axes.texts]
    for each in letters:
        colour = style.mixed(each.colour, style.ink(), 0.35)
        for offset, across, up in PLACES:
            look: dict[str, Any] = {
                "textcoords": "offset points",
                "ha": across,
                "va": up,
                "fontsize": size,
                "color": colour,
            }
            text = axes.annotate(each.text, each.point, offset, **look)
            box = text.get_window_extent()
            within = Bbox.union([box, inside]).bounds == inside.bounds
            if within and not (_curves_in(axes, box) or box.count_overlaps(taken)):
                taken.append(box)
                break
            text.remove()


def _curves_in(axes: Axes, box: Bbox) -> bool:
    """Whether a curve or a marker of the axes lies in a box of the figure."""
    around = box.padded(MARKER * axes.figure.dpi / 72)
    for line in axes.lines:
        path: Path = line.get_transform().transform_path(line.get_path())
        drawn = line.get_linestyle() not in ("None", "none", "")
        if path.intersects_bbox(box, filled=False) if drawn else False:
            return True
        if line.get_marker() not in ("None", "none", "", None) and around.count_contains(path.vertices):
            return True
    return False


def covered(axes: Axes, room: float = 0.0) -> bool:
    """Whether the legend of the axes lies over curves. room : around it [points]; the figure has to be laid out"""
    legend = axes.get_legend()
    return legend is not None and _curves_in(axes, legend.get_window_extent().padded(room * axes.figure.dpi / 72))


def clear(drawing: Figure, panels: Sequence[Axes] | ndarray) -> None:
    """Raise the vertical axes of panels whose legend lies over curves, so that it stands above all of them.

    Limits and scales have to be final otherwise.
    """
    engine = drawing.get_layout_engine()
    style.lay_out(drawing)
    for axes in panels:
        if covered(axes, ROOM):
            legend, scale = axes.get_legend(), axes.yaxis.get_transform()
            height = legend.get_window_extent().height + 2 * ROOM * axes.figure.dpi / 72
            low, high = scale.transform(axes.get_ylim())
            above = low + (high - low) / (1 - height / axes.get_window_extent().height)
            axes.set_ylim(*scale.inverted().transform([low, above]))
            style.decades(axes)
            legend.set_loc("upper right")
    # Numbers along the axes are others now, and take other room.
    drawing.set_layout_engine(engine)
    style.lay_out(drawing)
