"""One look for all figures, safe for colour blindness, readable in grey and in print.

Settings stand in style sheets beside this module: `print.mplstyle`, and on top of it one for a screen and one for
each journal. Sizes of text, lines and markers are multiples of those of the sheets.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from io import BytesIO
from itertools import cycle
from os import PathLike
from pathlib import Path
from textwrap import wrap
from threading import RLock
from typing import TYPE_CHECKING, Any, Literal
from zlib import crc32

import matplotlib.style
import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure, SubFigure
from matplotlib.font_manager import FontProperties
from matplotlib.ticker import LogFormatterSciNotation, LogLocator, MaxNLocator, NullFormatter

from . import journals

if TYPE_CHECKING:
    from matplotlib.typing import LegendLocType

# Okabe and Ito: blue and vermillion differ for every reader; marker and line tell them apart in grey.
COLOURS = {"MDR": "#0072B2", "CorrectedMDR": "#56B4E9", "BEM": "#D55E00", "Persson": "#44AA99"}
MARKER = {"MDR": "o", "CorrectedMDR": "^", "BEM": "s", "Persson": "D", "exact": ""}
LINE = {"MDR": "-", "CorrectedMDR": "-.", "BEM": "--", "Persson": (0, (5, 1, 1, 1)), "exact": "-"}
LABEL = {
    "MDR": "1D (MDR)",
    "CorrectedMDR": "1D, corrected",
    "BEM": "3D (BEM)",
    "Persson": "Persson's theory",
    "FrictionLaw": "3D law",
    "exact": "closed form",
}
OTHERS = ("#882255", "#CC79A7", "#8A6D00", "#7E57C2")  # colours of models that did not come with the package
SERIES_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
SERIES_LINES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)), (0, (1, 3)))

TEXT = 8.0  # points of the text for which heights of figures are given
WIDE = 0.65  # width of a letter over the size of its text
BESIDE = 5.2  # what numbers and label of a vertical axis take, in multiples of the text
ALIKE = 1.02  # ends of an axis, one over the other, between which no ticks have short numbers

Sheet = str | PathLike | Mapping[str, Any]
SHEETS = Path(__file__).parent
DRAWING = RLock()  # of the thread that draws: settings of matplotlib are those of the process
_columns: ContextVar[tuple[float, float]] = ContextVar("columns", default=journals.COLUMNS["default"])


@dataclass(frozen=True)
class Look:
    """Look of figures.

    journal : name in `journals.COLUMNS`, whose columns and style sheet hold
    sheet : a style of one's own on top: a .mplstyle file, the name of one of matplotlib's styles, or settings
    width : of a column, in place of that of the journal, as `journals.columns` takes it
    """

    journal: str = "default"
    sheet: Sheet | None = None
    width: str | float | None = None

    @property
    def sheets(self) -> list[Any]:
        """Style sheets, each on top of those before it."""
        names = ["print"] if self.journal == "default" else ["print", self.journal]
        own = [] if self.sheet is None else [self.sheet]
        return [*(SHEETS / f"{name}.mplstyle" for name in names), *own]


PRINT, SCREEN = Look(), Look(sheet=SHEETS / "screen.mplstyle")


@contextmanager
def applied(look: Look = PRINT) -> Iterator[None]:
    """The settings while a figure is drawn or saved, and those of the caller afterwards; one thread at a time.

    What a matplotlibrc of the machine says is left out. Raises ValueError, KeyError or OSError of a look that does
    not exist.
    """
    token = _columns.set(journals.columns(look.journal, look.width))
    try:
        with DRAWING, matplotlib.style.context(look.sheets, after_reset=True):
            yield
    finally:
        _columns.reset(token)


class _Colours(dict[str, str]):
    """Colours of models: closed forms are in ink, and another model has one of its own for good."""

    def __missing__(self, solver: str) -> str:
        return ink() if solver == "exact" else _own(solver, OTHERS)


COLOUR = _Colours(COLOURS)


def ink() -> str:
    """The colour of text, and of what is neither one-dimensional nor three-dimensional."""
    return rcParams["text.color"]


def paper() -> str:
    """The colour behind curves, with which hollow markers are filled."""
    return rcParams["axes.facecolor"]


def mixed(first: Any, second: Any, share: float) -> tuple[float, float, float]:
    """Colour between two, with a share of the second."""
    red, green, blue = (1 - share) * np.array(to_rgb(first)) + share * np.array(to_rgb(second))
    return float(red), float(green), float(blue)


def grey(level: float) -> tuple[float, float, float]:
    """Between ink (0) and paper (1)."""
    return mixed(ink(), paper(), level)


def size(times: float = 1.0) -> float:
    """Size of a text [point], in multiples of that of axis labels."""
    return times * rcParams["font.size"]


def small() -> float:
    """Size of the text in legends and beside curves [point]."""
    return FontProperties(size=rcParams["legend.fontsize"]).get_size_in_points()


tiny = small  # numbers at points are as large: journals ask for it


def width(times: float = 1.0) -> float:
    """Width of a line [point], in multiples of that of curves."""
    return times * rcParams["lines.linewidth"]


def mark(times: float = 1.0) -> float:
    """Size of a marker [point], in multiples of that of curves."""
    return times * rcParams["lines.markersize"]


def look(solver: str, **other: Any) -> dict[str, Any]:
    """Colour, marker, line and label of a solver, with other settings of a curve."""
    known = {
        "color": COLOUR[solver],
        "marker": MARKER[solver] if solver in MARKER else _own(solver, SERIES_MARKERS[3:]),
        "linestyle": LINE.get(solver) or _own(solver, SERIES_LINES[3:]),
        "label": label(solver),
    }
    return known | other


def label(solver: str) -> str:
    """Label of a solver: its name, of a model that did not come with the package."""
    return LABEL.get(solver, solver)


def _own(solver: str, choice: Sequence[Any]) -> Any:
    """One of a choice for a model of a name, the same in every figure."""
    return choice[crc32(solver.encode()) % len(choice)]


def line(level: float, times: float = 1.0, **other: Any) -> dict[str, Any]:
    """Colour and width of a line between ink (0) and paper (1), with other settings."""
    return {"color": grey(level), "linewidth": width(times)} | other


def across(column: Literal["single", "double"]) -> float:
    """The width of a figure in the journal [inch]."""
    return dict(zip(("single", "double"), _columns.get(), strict=True))[column]


def png(drawing: Figure) -> bytes:
    """A figure as a screen shows it."""
    image = BytesIO()
    with applied(SCREEN):
        drawing.canvas.print_figure(image, format="png")
    return image.getvalue()


class Drawing(Figure):
    """A figure that a notebook shows, also where pyplot is not in use."""

    _repr_png_ = png


def canvas(column: Literal["single", "double"], height: float) -> Figure:
    """An empty figure as wide as a column or the page of the journal.

    height : for text of 8 points [inch]; it goes with the larger of the text and 1.2 of the small text
    """
    times = max(size(), 1.2 * small()) / TEXT
    return Drawing(figsize=(across(column), height * times), layout="constrained")


def lay_out(drawing: Figure, passes: int = 1) -> None:
    """Find the layout of a figure once, which takes as long as to draw it; whatever is drawn later keeps it."""
    if (engine := drawing.get_layout_engine()) is not None:
        for _ in range(passes):
            engine.execute(drawing)
        drawing.set_layout_engine("none")


def fill(text: str, inches: float, points: float) -> str:
    """The text in lines of about that length, broken between words; lines of its own stay."""
    letters = max(1, int(72 * inches / (WIDE * points)))
    return "\n".join(line for given in text.split("\n") for line in wrap(given, letters))


def head(axes: Axes, text: str, count: int) -> None:
    """A title of a panel, one of so many side by side, in lines that leave the next its numbers and label."""
    inches = axes.figure.figure.get_figwidth() / count - BESIDE * size() / 72
    axes.set_title(fill(text, inches, small()), fontsize=small())


def columns(labels: Iterable[str], inches: float, most: int) -> int:
    """Number of columns of a legend of these labels, so that it is no wider; at most so many."""
    around = rcParams["legend.handlelength"] + rcParams["legend.handletextpad"] + rcParams["legend.columnspacing"]
    widest = (WIDE * max(map(len, labels)) + around) * small() / 72
    return max(1, min(most, int(inches / widest)))


def legend(
    drawing: Figure | SubFigure, handles: Sequence[Any], place: "LegendLocType", most: int, **other: Any
) -> None:
    """Outside of all panels, of artists with labels, in as many columns as fit, at most so many."""
    labels = [handle.get_label() for handle in handles]
    inches = drawing.bbox.width / rcParams["figure.dpi"]
    drawing.legend(handles=handles, loc=place, ncols=columns(labels, inches, most), **other)


def span(axes: Axes, values) -> None:
    """Limits of a logarithmic x axis around values, also one alone, of which matplotlib makes no range.

    Where no value is known, because no solve had an answer, the axis stays as it is.
    """
    known = [value for value in values if np.isfinite(value)]
    if known:
        low, high = min(known), max(known)
        room = (high / low) ** 0.05 if high > low * 1.01 else 2.0
        axes.set_xlim(low / room, high * room)


def decades(*panels: Axes) -> None:
    """Readable ticks on logarithmic axes: few and round, two at least, plain numbers where they are short.

    An axis on which all values are nearly the same gets the room of one value.
    """
    for axis in (axis for axes in panels for axis in (axes.xaxis, axes.yaxis) if axis.get_scale() == "log"):
        low, high = axis.get_view_interval()
        if high < ALIKE * low:
            low, high = low / 1.5, 1.5 * high
            getattr(axis.axes, f"set_{axis.axis_name}lim")(low, high)
        powers = LogLocator(subs=(1,) if high >= 100 * low else (1, 2, 5))
        axis.set_major_locator(powers if high >= 5 * low else MaxNLocator(4))
        axis.set_major_formatter(LogFormatterSciNotation(minor_thresholds=(np.inf, np.inf)))  # every tick has one
        axis.set_minor_formatter(NullFormatter())
        axis.set_tick_params(which="minor", label1On=False)  # or empty labels are measured, which takes longest
        if low >= 1e-4 and high <= 1e4:
            axis.set_major_formatter(lambda value, _: f"{value:g}")


def forms() -> Iterator[dict[str, Any]]:
    """Marker and line of one curve after another, without end."""
    return (
        {"marker": marker, "linestyle": line} for marker, line in zip(cycle(SERIES_MARKERS), cycle(SERIES_LINES))
    )


def shades(solver: str, count: int) -> list[tuple[float, float, float]]:
    """`count` shades of a solver's colour, from near ink to near paper."""
    dark, light = mixed(COLOUR[solver], ink(), 0.45), mixed(COLOUR[solver], paper(), 0.315)
    return [mixed(dark, light, share) for share in np.linspace(0, 1, count)]


def bars(values, low, high) -> np.ndarray:
    """Lengths (2, N) of error bars from intervals, as `errorbar` takes them; NaN, no bar, with an end unknown."""
    values, low, high = (np.asarray(each, float) for each in (values, low, high))
    found = np.clip([values - low, high - values], 0.0, None)
    return np.where(np.isfinite(found).all(axis=0), found, np.nan)
