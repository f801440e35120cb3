"""One look for all figures: applied locally, safe for colour blindness, readable in grey and in print."""

from collections.abc import Iterator
from contextlib import contextmanager

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from ..metrics import Estimate

# Widths of one and two columns of a journal [inch].
SINGLE, DOUBLE = 3.5, 7.2

# Okabe and Ito: blue and vermillion differ for every reader; marker and line tell them apart in grey.
COLOUR = {"MDR": "#0072B2", "BEM": "#D55E00", "exact": "#000000"}
MARKER = {"MDR": "o", "BEM": "s", "exact": ""}
LINE = {"MDR": "-", "BEM": "--", "exact": "-"}
LABEL = {"MDR": "1D (MDR)", "BEM": "3D (BEM)", "exact": "closed form"}
SERIES_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
SERIES_LINES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)), (0, (1, 3)))

SETTINGS = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.titlesize": 8,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": False,
    "legend.fontsize": 7,
    "legend.frameon": False,
    "legend.handlelength": 2.6,
    "lines.linewidth": 1.1,
    "lines.markersize": 4,
    "errorbar.capsize": 1.5,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "figure.constrained_layout.use": True,
    "figure.dpi": 100,
    "pdf.fonttype": 42,
    "ps.fonttype": 42,
    "mathtext.default": "it",
    "mathtext.fontset": "dejavusans",
}


@contextmanager
def applied() -> Iterator[None]:
    """The settings while a figure is drawn or saved, and those of the caller afterwards."""
    with matplotlib.rc_context(SETTINGS):
        yield


def canvas(width: float, height: float) -> Figure:
    """An empty figure [inch]."""
    return Figure(figsize=(width, height))


def line(axes: Axes, x, estimates: list[Estimate], solver: str, **other) -> None:
    """A curve of means: bars are standard errors, the band is the standard deviation of one surface."""
    look = {
        "color": COLOUR[solver],
        "marker": MARKER[solver],
        "linestyle": LINE[solver],
        "label": LABEL[solver],
    } | other
    x = np.asarray(x, float)
    mean = np.array([e.mean for e in estimates])
    deviation = np.nan_to_num([e.deviation for e in estimates])
    error = np.nan_to_num([e.error for e in estimates])
    axes.errorbar(x, mean, yerr=error, **look)
    if deviation.any():
        below = mean - deviation
        if axes.get_yscale() == "log":
            below = np.maximum(below, 1e-2 * mean)
        axes.fill_between(x, below, mean + deviation, color=look["color"], alpha=0.13, linewidth=0)


def span(axes: Axes, values) -> None:
    """Limits of a logarithmic x axis around values, also one alone, of which matplotlib makes no range."""
    low, high = np.nanmin(values), np.nanmax(values)
    room = (high / low) ** 0.05 if high > low * 1.01 else 2.0
    axes.set_xlim(low / room, high * room)


def decades(axes: Axes) -> None:
    """Readable ticks on logarithmic axes: 1, 2, 5 within two decades, plain numbers where they are short."""
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        if axis.get_scale() != "log":
            continue
        steps = (1, 2, 5) if high / low < 100 else (1,)
        axis.set_major_locator(LogLocator(subs=steps))
        axis.set_minor_formatter(NullFormatter())
        if low >= 1e-4 and high <= 1e4:
            axis.set_major_formatter(lambda value, _: f"{value:g}")


def shades(solver: str, count: int) -> list[tuple[float, float, float]]:
    """`count` shades of a solver's colour, dark to light."""
    base = np.array(matplotlib.colors.to_rgb(COLOUR[solver]))
    return [
        tuple(base * (0.55 + 0.45 * t) + (1 - base) * 0.45 * max(0.0, t - 0.3)) for t in np.linspace(0, 1, count)
    ]
