"""Regime map: friction of 1D over 3D against pressure and speed, contacts behind it, and how well it is known."""

from itertools import product
from typing import Any

import numpy as np
from matplotlib.colors import CenteredNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import Bbox
from pandas import DataFrame

from ...report.page import Plot, Tables
from ...report.plots import shades, style, touching

NAME = "regime-map"
CONTACTS = f"{NAME}-contacts"
# Ratios of labelled lines; one that the map merely grazes, as that of a limit, would show the errors of the map.
LEVELS = (0.25, 0.4, 0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 4.0)
GRAZED = 0.05
# Ratios that are written before all others, where there is no room for all.
FIRST = 0.8, 1.25, 2.0, 1.0
# Where along its line a ratio may be written, in the order of trial.
PLACES = np.array([4, 6, 3, 7, 2, 8, 5, 1, 9]) / 10
# Half an interval, in percent, at which its shades change.
HALVES = 0.0, 1.0, 2.0, 5.0, 10.0
# Shades to a factor of e; one lies about 1.
BANDS = 20
HATCH, BEHIND = "////", 0.85
# Width of the strip of the smooth body and of the gap before it, over that of the map.
STRIP, GAP = 0.06, 0.015
FLAT = [np.inf, np.inf]


def plot(table: DataFrame, contacts: DataFrame, about: str, wide: float) -> Plot:
    """Plot of the ratio of friction over p / (E* h') and v tau q_s.

    table : a rectangle of pressure_over_slope, infinite of the smooth body, and memory_over_shortest, with ratio,
        ratio_low and ratio_high, which are nan where nothing is known
    contacts : those behind it, with the same columns
    about : the scenes in words, as they stand after "friction of"
    wide : half an interval of 95 %, relative, from which on a scene is to be solved in 3D
    """
    caption = (
        f"Friction of {about}. Dots, in the colours of the map: such contacts as solved, but of any H, and half "
        f"to twice the waves. Hatched: an interval of 95 % wider than ±{100 * wide:.0f} %, or beyond what was "
        "measured."
    )
    known = table["ratio"].dropna()
    alternative = (
        f"Map of 1D over 3D, from {known.min():.2g} to {known.max():.2g}; beside it, how well it is known."
    )
    return Plot(NAME, figure, {NAME: table, CONTACTS: contacts}, caption, alternative, {"wide": wide})


def figure(tables: Tables, wide: float) -> Figure:
    """Left: a map with lines of equal ratios, and the smooth body beside it. Right: half its interval."""
    everything, low, high = (_unstacked(tables[NAME], name) for name in ("ratio", "ratio_low", "ratio_high"))
    logarithm, smooth = everything.drop(columns=np.inf), everything[FLAT]
    least, most = (float(end) for end in (np.nanmin(everything), np.nanmax(everything)))
    drawing = style.canvas("double", 3.6)
    axes, known = drawing.subplots(1, 2)
    strip = axes.inset_axes((1 + GAP, 0, STRIP, 1), sharey=axes)
    fields = (axes, logarithm.columns, logarithm), (strip, (0, 1), smooth)

    ends = np.floor(BANDS * least - 0.5) + 0.5, BANDS * most + 1
    look: dict[str, Any] = {"norm": CenteredNorm(0, max(-least, most)), "cmap": shades.ratio()}
    image, _ = (
        panel.contourf(x, each.index, each, levels=np.arange(*ends) / BANDS, **look) for panel, x, each in fields
    )
    half = (high - low).drop(columns=np.inf) / 2
    grey = {"colors": [style.grey(1 - 0.12 * k) for k in range(len(HALVES))], "extend": "max"}
    widths = known.contourf(half.columns, half.index, 100 * half, levels=HALVES, **grey)
    sample = _hatch((axes, known), half, wide)
    _contacts((axes, known), tables[CONTACTS], look)
    for panel in (axes, known):
        panel.set(xscale="log", yscale="log", xlabel="$p\\,/\\,(E^*h')$ [1]", ylabel=r"$v\tau q_s$ [1]")
        panel.set(xlim=(half.columns[0], half.columns[-1]), ylim=(half.index[0], half.index[-1]))
        style.decades(panel)
    axes.set_title("(a) friction 1D / 3D")
    known.set_title("(b) half its interval of 95 %")
    strip.set_title("smooth", loc="center", fontsize=style.small(), fontweight="normal")
    strip.tick_params(which="both", bottom=False, left=False, labelbottom=False, labelleft=False)
    for panel in (axes, strip, known):
        panel.spines[:].set_visible(True)
    place: dict[str, Any] = {"location": "bottom", "aspect": 30}
    bar = shades.colours(drawing, image, "friction, 1D / 3D [1]", ax=axes, **place)
    shades.colours(drawing, widths, "half the interval [%]", ax=known, **place)
    shown = [level for level in LEVELS if least <= np.log(level) <= most]
    bar.set_ticks(np.log(shown).tolist(), labels=[f"{level:g}" for level in shown])
    hollow: dict[str, Any] = {"linestyle": "none", "color": style.ink(), "markerfacecolor": "none"}
    dot = Line2D([], [], marker="o", label="contact, solved", **hollow)
    style.legend(drawing, [dot, *sample], "outside upper center", 2)

    style.lay_out(drawing)  # labels stand on lines as they lie in the end
    at = axes.transData.transform(tables[CONTACTS][["pressure_over_slope", "memory_over_shortest"]])
    reach = style.mark() * drawing.dpi / 72
    dots = [Bbox([each - reach, each + reach]) for each in at]
    levels = [level for level in shown if least + GRAZED < np.log(level) < most - GRAZED]
    for panel, x, each in fields:
        _lines(panel, x, each, levels, dots)
    return drawing


def _hatch(panels, half, wide):
    """Hatch where half an interval is wide or unknown; what says so, where there is any."""
    over = (half / wide).fillna(np.inf).clip(upper=2.0)
    for axes in panels:
        hatched = axes.contourf(over.columns, over.index, over, levels=(1, 3), colors="none", hatches=[HATCH])
        hatched.set(edgecolor=style.grey(0.3), linewidth=0)
        axes.set_facecolor(style.grey(BEHIND))
    sample = Patch(facecolor=style.grey(BEHIND), edgecolor=style.grey(0.3), hatch=HATCH, label="solve in 3D")
    return [sample] if (over > 1).any(axis=None) else []


def _contacts(panels, contacts, look):
    """Contacts that were solved: their own ratios in the first panel, where they lie in the second."""
    at = contacts["pressure_over_slope"], contacts["memory_over_shortest"]
    dots = {"s": style.mark(0.75) ** 2, "edgecolors": [style.ink()], "linewidths": style.width(0.45), "zorder": 3}
    panels[0].scatter(*at, c=np.log(contacts["ratio"]), **dots, **look)
    panels[1].scatter(*at, facecolors="none", **dots)


def _lines(axes, x, logarithm, levels, dots):
    """Draw lines of equal ratios through a map or a strip; write what no frame cuts and no dot or ratio covers."""
    crossed = [level for level in levels if np.nanmin(logarithm) < np.log(level) < np.nanmax(logarithm)]
    if not crossed:
        return
    widths = [style.width(0.4 if level == 1 else 0.8) for level in crossed]
    look = {"levels": np.log(crossed), "colors": [style.ink()], "linewidths": widths}
    lines = axes.contour(x, logarithm.index, logarithm, **look)
    written = {"fmt": lambda value: f"{np.exp(value):.3g}", "fontsize": style.small()}
    paths = dict(zip(crossed, lines.get_paths(), strict=True))
    inside, free, boxes = axes.get_window_extent(), [], list(dots)
    for level, share in product(sorted(crossed, key=lambda level: level not in FIRST), PLACES):
        if level in (each for each, _ in free):
            continue
        vertices = paths[level].vertices
        place = vertices[int(share * len(vertices))]
        text = axes.clabel(lines, [np.log(level)], inline=False, manual=[place], **written)[-1]
        box = text.get_window_extent()
        cut = not (inside.x0 < box.x0 and box.x1 < inside.x1 and inside.y0 < box.y0 and box.y1 < inside.y1)
        if not cut and not box.count_overlaps(boxes):
            free.append((level, place))
            boxes.append(box)
        text.remove()
    if free:
        axes.clabel(lines, manual=[place for _, place in free], **written)


def _unstacked(table, name):
    """Logarithms of a column: a row a speed, a column a pressure."""
    return np.log(touching.unstacked(table, "memory_over_shortest", "pressure_over_slope", name))
