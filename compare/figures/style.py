"""One look for all figures, safe for colour blindness, readable in grey and in print.

Settings stand in style sheets next to this module: `print.mplstyle`, and on top of it one for a screen and one for
each journal. Sizes of text, lines and markers are multiples of those of the sheets.
"""

import textwrap
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from io import BytesIO
from os import PathLike
from pathlib import Path
from string import ascii_letters
from threading import RLock
from typing import Any, Literal
from zlib import crc32

import matplotlib.style
import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.ticker import EngFormatter, LogFormatterSciNotation, LogLocator, MaxNLocator, NullFormatter

from scene.printable import printable
from scene.quantities import METRE, argument

# Okabe and Ito: blue and vermillion differ for every reader; marker and line tell them apart in grey.
COLOURS = {
    "MDR": "#0072B2",
    "CorrectedMDR": "#56B4E9",
    "BEM": "#D55E00",
    "ExtendedBEM": "#8A2B06",
    "Persson": "#44AA99",
}
MARKER = {"MDR": "o", "CorrectedMDR": "^", "BEM": "s", "ExtendedBEM": "P", "Persson": "D", "exact": ""}
LINE = {"MDR": "-", "CorrectedMDR": "-.", "BEM": "--", "Persson": (0, (5, 1, 1, 1)), "exact": "-"}
LABEL = {
    "MDR": "1D (MDR)",
    "CorrectedMDR": "1D, corrected",
    "BEM": "3D (BEM)",
    "ExtendedBEM": "3D extended",
    "Persson": "Persson's theory",
    "FrictionLaw": "3D law",
    "exact": "closed form",
}
OTHERS = ("#882255", "#CC79A7", "#8A6D00", "#7E57C2")  # colours of models that did not come with the package
SERIES_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
SERIES_LINES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)), (0, (1, 3)))

TEXT = 8.0  # points of the text for which heights of figures are given
WIDE = 0.65  # width of a letter over the size of its text
AXIS_WIDTH = 5.2  # width that numbers and label of a vertical axis take, in multiples of the text

INCH = 0.0254

# Across one column and across the page [inch].
COLUMNS = {
    "default": (3.5, 7.2),
    "acs": (3.333, 7.0),
    "aip": (3.37, 6.69),
    "aps": (3.375, 7.0),
    "elsevier": (3.543, 7.480),
    "ieee": (3.5, 7.16),
    "iop": (3.346, 5.906),
    "nature": (3.504, 7.205),
    "royal-society": (3.307, 6.890),
    "springer": (3.307, 6.850),
    "wiley": (3.150, 7.087),
}
# Limits of the width of a column that users may ask for [m]; narrower columns than the narrowest journal's cut
# titles.
NARROWEST, WIDEST = 80e-3, 200e-3

Sheet = str | PathLike | Mapping[str, Any]
SHEETS = Path(__file__).parent
DRAWING = RLock()  # of the thread that draws: settings of matplotlib are those of the process
_columns: ContextVar[tuple[float, float]] = ContextVar("columns", default=COLUMNS["default"])


@dataclass(frozen=True)
class Look:
    """Look of figures.

    journal : name in `COLUMNS`, whose columns and style sheet hold
    sheet : the user's own style on top: a .mplstyle file, the name of a matplotlib style, or settings
    width : of a column, in place of the width in the journal, as `columns` takes it
    """

    journal: str = "default"
    sheet: Sheet | None = None
    width: str | float | None = None

    @property
    def sheets(self) -> list[Any]:
        """Style sheets, each on top of those before it."""
        own = [] if self.sheet is None else [self.sheet]
        return [SHEETS / "print.mplstyle", SHEETS / f"{self.journal}.mplstyle", *own]


PRINT, SCREEN = Look(), Look(sheet=SHEETS / "screen.mplstyle")


def columns(journal: str, width: str | float | None = None) -> tuple[float, float]:
    """Widths of a column and of the page [inch].

    width : of a column, as "84 mm" or in metres; the page becomes wider or narrower in proportion. If absent, the
        width in the journal

    Raises ValueError of a width that is no length, or out of what is allowed.
    """
    single, double = COLUMNS[journal]
    if width is None:
        return single, double
    metres = float(argument("width", width, METRE.value))
    if not NARROWEST <= metres <= WIDEST:
        raise ValueError(f"width = {width!r}: {1e3 * NARROWEST:g} mm to {1e3 * WIDEST:g} mm are allowed")
    return metres / INCH, metres / INCH * double / single


@contextmanager
def applied(look: Look = PRINT) -> Iterator[None]:
    """The settings while a figure is drawn or saved, and those of the caller afterwards; one thread at a time.

    What a matplotlibrc of the machine says is left out. Raises ValueError, KeyError or OSError of a look that does
    not exist.
    """
    token = _columns.set(columns(look.journal, look.width))
    try:
        with DRAWING, matplotlib.style.context(look.sheets, after_reset=True):
            yield
    finally:
        _columns.reset(token)


def ink() -> str:
    """The colour of text, and of what is neither one-dimensional nor three-dimensional."""
    return rcParams["text.color"]


def paper() -> str:
    """The colour behind curves, with which hollow markers are filled."""
    return rcParams["axes.facecolor"]


def grey(level: float) -> tuple[str, float]:
    """Between ink (0) and what lies behind it (1)."""
    return ink(), 1 - level


def small() -> float:
    """Size of the text in legends and along curves [point]."""
    return FontProperties(size=rcParams["legend.fontsize"]).get_size_in_points()


def width(times: float = 1.0) -> float:
    """Width of a line [point], in multiples of the width of curves."""
    return times * rcParams["lines.linewidth"]


def mark(times: float = 1.0) -> float:
    """Size of a marker [point], in multiples of the size on curves."""
    return times * rcParams["lines.markersize"]


def look(solver: str, **other: Any) -> dict[str, Any]:
    """Colour, marker, line and label of a model, with other settings of a curve.

    Closed forms are in ink; a model that did not come with the package has looks of its own, the same everywhere.
    """
    own = crc32(solver.encode()) % 4
    return {
        "color": ink() if solver == "exact" else COLOURS.get(solver, OTHERS[own]),
        "marker": MARKER.get(solver, SERIES_MARKERS[3 + own]),
        "linestyle": LINE.get(solver, SERIES_LINES[3 + own]),
        "label": label(solver),
    } | other


def colour(solver: str) -> str:
    """Colour of a model."""
    return look(solver)["color"]


def label(solver: str) -> str:
    """Label of a model; a model that did not come with the package has its name."""
    return LABEL.get(solver, solver)


def line(level: float, times: float = 1.0, **other: Any) -> dict[str, Any]:
    """Colour and width of a line between ink (0) and paper (1), with other settings."""
    return {"color": grey(level), "linewidth": width(times)} | other


def across(column: Literal["single", "double"]) -> float:
    """The width of a figure in the journal [inch]."""
    return _columns.get()[column == "double"]


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
    times = max(rcParams["font.size"], 1.2 * small()) / TEXT
    return Drawing(figsize=(across(column), height * times), layout="constrained")


def literal(text: str) -> str:
    """A text of a user's, such as a title, in which nothing is a formula to be set."""
    return printable(text).replace("$", r"\$")


def lettered(panels: Iterable[Axes]) -> None:
    """A letter before the title of each panel. Titles are broken where the panel ends."""
    for letter, axes in zip(ascii_letters, panels, strict=False):
        place: Any = axes.get_subplotspec()
        share = len(place.colspan) / place.get_gridspec().ncols
        inches = share * axes.figure.bbox.width / axes.figure.dpi - AXIS_WIDTH * rcParams["font.size"] / 72
        letters = max(1, int(72 * inches / (WIDE * rcParams["font.size"])))
        axes.set_title(textwrap.fill(f"({letter}) {axes.get_title('left')}", letters))


def legend(drawing: Figure, panels: Iterable[Axes], most: int, *more: Any) -> None:
    """Put a legend below all panels: each label once, in as many columns as fit, up to `most`.

    more : artists that are named first
    """
    drawn = (each for axes in panels for each in axes.get_legend_handles_labels()[0])
    handles = [*more, *drawn, *more]  # of a label the last counts, at the place of the first
    entries = [*{each.get_label(): each for each in handles}.values()]
    for columns in range(most, 0, -1):
        made = drawing.legend(handles=entries, loc="outside lower center", ncols=columns)
        if columns == 1 or made.get_window_extent().width <= drawing.bbox.width:
            return
        made.remove()


def finish(drawing: Figure, most: int, *more: Any) -> None:
    """Make logarithmic axes readable, letter the titles, and add one legend of at most `most` columns.

    more : entries of the legend that come first
    """
    panels = [axes for axes in drawing.axes if axes.get_label() != "<colorbar>"]
    decades(*panels)
    lettered(panels)
    legend(drawing, panels, most, *more)


def entry(label: str, **look: Any) -> Line2D:
    """Entry of a legend: a marker."""
    return Line2D([], [], **{"marker": "o", "linestyle": "none", "color": grey(0.3), "label": label} | look)


def decades(*panels: Axes) -> None:
    """Readable ticks on logarithmic axes: few and round, two at least, plain numbers where they are short.

    An axis on which all values are nearly the same has room around them.
    """
    for axis in (axis for axes in panels for axis in (axes.xaxis, axes.yaxis) if axis.get_scale() == "log"):
        low, high = axis.get_view_interval()
        if high < 1.02 * low:
            low, high = getattr(axis.axes, f"set_{axis.axis_name}lim")(low / 2, 2 * high)
        powers = LogLocator(subs=(1,) if high >= 100 * low else (1, 2, 5))
        axis.set_major_locator(powers if high >= 5 * low else MaxNLocator(4))
        axis.set_major_formatter(LogFormatterSciNotation(minor_thresholds=(np.inf, np.inf)))  # every tick has one
        axis.set_minor_formatter(NullFormatter())
        axis.set_tick_params(which="minor", label1On=False)  # or empty labels are measured, which takes longest
        if low >= 1e-4 and high <= 1e4:  # also where a figure is saved in another style
            axis.set_major_formatter(lambda value, _: f"{value:g}")


def shades(solver: str, count: int) -> np.ndarray:
    """`count` shades of a model's colour (N, 4), from near ink to near paper."""
    scale = LinearSegmentedColormap.from_list(solver, [ink(), colour(solver), paper()])
    return scale(np.linspace(0.28, 0.66, count))


def prefixed(values, unit: str) -> tuple[float, str]:
    """Factor on values in a unit of SI, and the unit that they then have, so that the greatest is 1 to 1000.

    Beyond the prefixes, and of nothing but zero or NaN, the unit stays.
    """
    finite = np.abs(np.asarray(values, float))
    greatest = np.max(finite[np.isfinite(finite)], initial=0.0)
    power = 3 * int(np.floor(np.log10(greatest) / 3 + 1e-12)) if greatest > 0 else 0
    prefixes = EngFormatter.ENG_PREFIXES
    return (10.0**-power, prefixes[power] + unit) if power in prefixes else (1.0, unit)
