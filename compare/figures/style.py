"""One look for all figures: applied locally, safe for colour blindness, readable in grey and in print.

Sizes of text, lines and markers are multiples of those of the look, so that a journal or a style of one's own
changes all of them.
"""

import logging
import re
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from io import BytesIO
from itertools import cycle
from os import PathLike
from pathlib import Path
from threading import RLock
from typing import TYPE_CHECKING, Any, Literal
from zlib import crc32

import matplotlib
import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath
from matplotlib.ticker import LogFormatterSciNotation, LogLocator, MaxNLocator, NullFormatter

from scene.printable import brief
from scene.reading import InvalidInput

from .journals import JOURNALS, Journal

if TYPE_CHECKING:
    from matplotlib.typing import LegendLocType

# Widths of the default columns [inch].
SINGLE, DOUBLE = JOURNALS["default"].single, JOURNALS["default"].double

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

# Font sizes relative to the base size: of all but labels and titles, of texts at points; the base size [point].
SMALL, TINY, TEXT = 0.875, 0.7, 8.0
SCREEN = 110  # dots per inch of what a notebook shows
# What numbers and label of a vertical axis take, in multiples of the text.
BESIDE = 5.2
# Multiples of powers of ten that are written along an axis: the first of which three are in view, else two; the
# very first along two decades or more.
MULTIPLES = (1,), (1, 2, 5), (1, 2, 3, 5), (1, 1.5, 2, 3, 4, 6, 8)
ALIKE = 1.02  # ends of an axis, one over the other, between which no ticks have short numbers
# A blank at which no line ends, and where a title has it.
GLUE, FORMULA = "\u00a0", re.compile(r"v ?τ = \S+( [aλ]\w*)?")
TEXTS = {
    "axes.labelsize": 1.0,
    "axes.titlesize": 1.0,
    "figure.titlesize": 1.0,
    "legend.fontsize": SMALL,
    "legend.title_fontsize": SMALL,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
}
# Lines [point] that no journal has thinner than it allows.
LINES = {
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.1,
    "grid.linewidth": 0.5,
    "patch.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
}
SETTINGS = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": False,
    "legend.frameon": False,
    "legend.handlelength": 2.6,
    "lines.markersize": 4,
    "errorbar.capsize": 1.5,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "mathtext.default": "it",
    "mathtext.fontset": "dejavusans",
}
# What files owe to every journal, whatever a style of one's own says: fonts inside, one size, the same bytes.
FILES = {
    "figure.autolayout": False,
    "figure.constrained_layout.use": True,
    "figure.dpi": 100,
    "pdf.fonttype": 42,
    "ps.fonttype": 42,
    "svg.fonttype": "path",
    "svg.hashsalt": "crosscheck",
}

NO_LOOKS = "backend", "animation"  # of settings: code that is imported, programs that are run


@dataclass(frozen=True)
class Look:
    """Look of figures.

    journal : whose columns and least sizes
    sheet : a style of one's own on top: a .mplstyle file, the name of one of matplotlib's styles, or settings;
        what it gives in points stands, also below the least of the journal
    colours : of solvers by name ("MDR", "BEM"), in place of those that all figures have; a sheet does not change
        them, since its cycle of colours says nothing of dimensions
    """

    journal: Journal = JOURNALS["default"]
    sheet: str | PathLike | Mapping[str, Any] | None = None
    colours: Mapping[str, str] = field(default_factory=dict)

    @property
    def palette(self) -> dict[str, str]:
        """Colours of the solvers; ValueError names what is none."""
        if unknown := set(self.colours) - set(COLOURS):
            raise ValueError(f"no solver {sorted(unknown)[0]!r} has a colour; known are {', '.join(COLOURS)}")
        for solver, colour in self.colours.items():
            if not matplotlib.colors.is_color_like(colour):
                raise ValueError(f"{colour!r}, for {solver}, is no colour")
        return {**COLOURS, **self.colours}

    def settings(self) -> dict[str, Any]:
        """Settings of matplotlib, whole: ours, then the sheet's; sizes that the sheet leaves open follow its text.

        ValueError where the sheet is no style.
        """
        own, _ = read(self.sheet), self.palette
        text = float(own.get("font.size", self.journal.text))
        found = {"font.size": text, **SETTINGS}
        found |= {name: max(times * text, self.journal.least) for name, times in TEXTS.items()}
        found |= {name: max(width, self.journal.line) for name, width in LINES.items()}
        return found | own | FILES


DRAWING = RLock()  # of the thread that draws
_current: ContextVar[Look] = ContextVar("look", default=Look())  # noqa: B039


def current() -> Look:
    """The look that figures are drawn in now."""
    return _current.get()


@contextmanager
def applied(look: Look | None = None) -> Iterator[None]:
    """The settings while a figure is drawn or saved, and those of the caller afterwards.

    look : the current one by default; what a matplotlibrc of the machine says is left out

    One thread draws at a time: settings are those of the process, and mathtext mixes up formulas of two.
    """
    from matplotlib import style as styles

    look = look or current()
    with DRAWING, chosen(look), styles.context("default"):
        settings: dict[Any, Any] = look.settings()
        with matplotlib.rc_context(settings):
            yield


@contextmanager
def fitting(name: str) -> Iterator[None]:
    """While a figure is laid out, the style applied; InvalidInput where no room is left for its panels."""
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("error", "constrained_layout not applied", UserWarning)
            yield
    except UserWarning as warning:
        if "constrained_layout not applied" not in str(warning):
            raise
        raise InvalidInput(
            f"{name}: text of {rcParams['font.size']:g} points leaves its panels no room in columns of "
            f"{across('single'):.3g} in. and pages of {across('double'):.3g} in.; a lower font.size is needed"
        ) from None


@contextmanager
def chosen(look: Look) -> Iterator[None]:
    """Make a look the current one, for all that is drawn inside; ValueError where it is none."""
    with DRAWING:  # also of the log of matplotlib, which tells mistakes in a style
        look.settings()
    token = _current.set(look)
    try:
        yield
    finally:
        _current.reset(token)


class _Palette(Mapping):
    """Colours of solvers, and of closed forms, in the current look; another model has one of its own for good."""

    def __getitem__(self, solver: str) -> str:
        return ink() if solver == "exact" else current().palette.get(solver) or _own(solver, OTHERS)

    def __iter__(self) -> Iterator[str]:
        return iter((*COLOURS, "exact"))

    def __len__(self) -> int:
        return len(COLOURS) + 1


COLOUR = _Palette()


def ink() -> str:
    """The colour of text, and of what is neither one-dimensional nor three-dimensional."""
    return rcParams["text.color"]


def paper() -> str:
    """The colour behind curves, with which hollow markers are filled."""
    return rcParams["axes.facecolor"]


def grey(level: float) -> tuple[float, float, float]:
    """Between ink (0) and paper (1)."""
    dark, light = (np.array(matplotlib.colors.to_rgb(colour)) for colour in (ink(), paper()))
    return tuple(((1 - level) * dark + level * light).tolist())


def size(times: float = 1.0) -> float:
    """Size of a text [point], in multiples of that of axis labels; never below the least of the journal."""
    return max(times * rcParams["font.size"], current().journal.least)


def small() -> float:
    """Size of the text in legends and beside curves [point]."""
    return size(SMALL)


def tiny() -> float:
    """Size of numbers at points [point]."""
    return size(TINY)


def width(times: float = 1.0) -> float:
    """Width of a line [point], in multiples of that of curves; never below the least of the journal."""
    return max(times * rcParams["lines.linewidth"], current().journal.line)


def mark(times: float = 1.0) -> float:
    """Size of a marker [point], in multiples of that of curves."""
    return times * rcParams["lines.markersize"]


def look(solver: str, **other: Any) -> dict[str, Any]:
    """Colour, marker, line and label of a solver, with other settings of a curve."""
    known = {
        "color": COLOUR[solver],
        "marker": MARKER.get(solver) or ("" if solver == "exact" else _own(solver, SERIES_MARKERS[3:])),
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
    return {"single": current().journal.single, "double": current().journal.double}[column]


def png(drawing: Figure) -> bytes:
    """A figure as a screen shows it."""
    image = BytesIO()
    with applied():
        drawing.canvas.print_figure(image, format="png", dpi=SCREEN)
    return image.getvalue()


class Drawing(Figure):
    """A figure that a notebook shows, also where pyplot is not in use."""

    _repr_png_ = png


def canvas(column: Literal["single", "double"], height: float) -> Figure:
    """An empty figure as wide as a column or the page of the journal.

    height : for text of 8 points, and 7 where it is small [inch]; it goes with the text
    """
    times = max(size() / TEXT, small() / (SMALL * TEXT))
    return Drawing(figsize=(across(column), height * times))


def lay_out(drawing: Figure, passes: int = 1) -> None:
    """Find the layout of a figure once, which takes as long as to draw it; whatever is drawn later keeps it."""
    engine = drawing.get_layout_engine()
    if engine is not None:
        for _ in range(passes):
            engine.execute(drawing)
        drawing.set_layout_engine("none")


def text_width(text: str, points: float, weight: str = "normal") -> float:
    """Width of one line of text at a size [inch]."""
    font = FontProperties(size=points, weight=weight)
    return TextToPath().get_text_width_height_descent(text, font, ismath="$" in text)[0] / 72


def fill(text: str, inches: float, points: float, weight: str = "normal") -> str:
    """The text in lines that are no longer, broken between words, not in a speed; lines of its own stay."""
    lines: list[str] = []
    for given in text.split("\n"):
        line = ""
        for word in FORMULA.sub(lambda found: found[0].replace(" ", GLUE), given).split(" "):
            longer = f"{line} {word}".strip()
            if line and text_width(longer, points, weight) > inches:
                lines.append(line)
                longer = word
            line = longer
        lines.append(line)
    return "\n".join(lines)


def head(axes: Axes, text: str, count: int) -> None:
    """A title of a panel, one of so many side by side, in lines that leave the next its numbers and label."""
    inches = axes.figure.figure.get_figwidth() / count - BESIDE * size() / 72
    weight = rcParams["axes.titleweight"]
    axes.set_title(fill(text, inches, small(), weight), fontsize=small())


def columns(labels: Iterable[str], inches: float, most: int) -> int:
    """Number of columns of a legend of these labels, so that it is no wider; at most so many."""
    # Widths of matplotlib: the handle, its gap to the label, and that between columns, in multiples of the text.
    around = rcParams["legend.handlelength"] + rcParams["legend.handletextpad"] + rcParams["legend.columnspacing"]
    points = FontProperties(size=rcParams["legend.fontsize"]).get_size_in_points()
    widest = max(text_width(label, points) for label in labels) + around * points / 72
    return max(1, min(most, int((inches - rcParams["legend.borderaxespad"] * points / 36) / widest)))


def legend(
    drawing: Figure | SubFigure, handles: Sequence[Any], place: "LegendLocType", most: int, **other: Any
) -> None:
    """Outside of all panels, of artists with labels, in as many columns as fit, at most so many."""
    labels = [handle.get_label() for handle in handles]
    inches = drawing.bbox.width / rcParams["figure.dpi"]
    drawing.legend(handles=handles, loc=place, ncols=columns(labels, inches, most), **other)


def read(sheet: str | PathLike | Mapping[str, Any] | None) -> dict[str, Any]:
    """The settings of a style that are a matter of looks, no programs to run; ValueError says what is wrong."""
    from matplotlib import style as styles

    if sheet is None:
        return {}
    if isinstance(sheet, Mapping):
        try:
            given: Mapping[Any, Any] = matplotlib.RcParams(sheet)
        except (KeyError, ValueError) as error:
            raise ValueError(f"no style of matplotlib: {error}") from None
    elif not isinstance(sheet, str | PathLike):
        raise ValueError(f"{brief(repr(sheet))}: a file, a name of a style or settings are needed")
    elif str(sheet) in styles.library:
        given = styles.library[str(sheet)]
    elif Path(sheet).is_file():
        given = _parsed(Path(sheet))
    else:
        known = ", ".join(styles.available)
        raise ValueError(f"no style {str(sheet)!r}: neither a file nor one of matplotlib's, {known}")
    return {name: given[name] for name in given if not name.startswith(NO_LOOKS)}


def _parsed(path: Path) -> Mapping[Any, Any]:
    """The settings of a file; matplotlib only logs what it does not understand."""
    heard: list[str] = []
    listener = logging.Handler()
    listener.emit = lambda record: heard.append(" ".join(record.getMessage().split()))  # type: ignore[method-assign]
    logger = logging.getLogger("matplotlib")
    logger.addHandler(listener)
    propagates, logger.propagate = logger.propagate, False
    try:
        given = matplotlib.rc_params_from_file(path, fail_on_error=True, use_default_template=False)
    except (ValueError, UnicodeDecodeError) as error:
        raise ValueError(f"{path} is no style of matplotlib: {error}") from None
    finally:
        logger.propagate = propagates
        logger.removeHandler(listener)
    if heard:
        raise ValueError(f"{path} is no style of matplotlib: {heard[0].split(' You probably')[0]}")
    return given


def span(axes: Axes, values) -> None:
    """Limits of a logarithmic x axis around values, also one alone, of which matplotlib makes no range.

    Where no value is known, because no solve had an answer, the axis stays as it is.
    """
    known = [value for value in values if np.isfinite(value)]
    if not known:
        return
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
        axis.set_major_locator(_locator(low, high))
        axis.set_major_formatter(LogFormatterSciNotation(minor_thresholds=(np.inf, np.inf)))  # every tick has one
        axis.set_minor_formatter(NullFormatter())
        axis.set_tick_params(which="minor", label1On=False)  # or empty labels are measured, which takes longest
        if low >= 1e-4 and high <= 1e4:
            axis.set_major_formatter(lambda value, _: f"{value:g}")


def _locator(low, high):
    """The ticks of a logarithmic axis; where it is so short that none of the multiples will do, even steps."""
    if high / low >= 100:
        return LogLocator(subs=MULTIPLES[0])
    powers = 10.0 ** np.arange(np.floor(np.log10(low)), np.log10(high) + 1)
    ticks = {each: np.outer(powers, each) for each in MULTIPLES[1:]}
    seen = {each: np.sum((low <= own) & (own <= high)) for each, own in ticks.items()}
    chosen = [each for least in (3, 2) for each, count in seen.items() if count >= least]
    return LogLocator(subs=chosen[0]) if chosen else MaxNLocator(4)


def forms() -> Iterator[dict[str, Any]]:
    """Marker and line of one curve after another, without end."""
    return (
        {"marker": marker, "linestyle": line} for marker, line in zip(cycle(SERIES_MARKERS), cycle(SERIES_LINES))
    )


def shades(solver: str, count: int) -> list[tuple[float, float, float]]:
    """`count` shades of a solver's colour, from near ink to near paper."""
    base, dark, light = (np.array(matplotlib.colors.to_rgb(each)) for each in (COLOUR[solver], ink(), paper()))
    return [
        tuple(base + 0.45 * (1 - t) * (dark - base) + 0.45 * max(0.0, t - 0.3) * (light - base))
        for t in np.linspace(0, 1, count)
    ]


def bars(values, low, high) -> np.ndarray:
    """Lengths (2, N) of error bars from intervals, as `errorbar` takes them; NaN, no bar, with an end unknown."""
    values, low, high = (np.asarray(each, float) for each in (values, low, high))
    found = np.clip([values - low, high - values], 0.0, None)
    return np.where(np.isfinite(found).all(axis=0), found, np.nan)
