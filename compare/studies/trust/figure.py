"""Regime map: friction of 1D over 3D against pressure and speed, the smooth body, and where 3D is to be solved."""

from typing import Any

import numpy as np
from matplotlib.colors import CenteredNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from pandas import DataFrame

from ...report.page import Plot, Tables
from ...report.plots import shades, style, touching

NAME = "regime-map"
# Ratios of labelled lines; one that the map merely grazes, as that of a limit, would show the errors of the map.
LEVELS = (0.25, 0.4, 0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 4.0)
GRAZED = 0.05
# Ratios that are written before all others, where there is no room for all.
FIRST = "0.8", "1.25", "2", "1"
# Shades to a factor of e; one lies about 1.
BANDS = 20
HATCH, BEHIND = "////", 0.85
# Width of the strip of the smooth body and of the gap before it, over that of the map.
STRIP, GAP = 0.06, 0.015
FLAT = [np.inf, np.inf]


def plot(table: DataFrame, about: str, wide: float, folder: str = "") -> Plot:
    """Plot of the ratio of friction over p / (E* h') and v tau q_s.

    table : a rectangle of pressure_over_slope, infinite of the smooth body, and memory_over_shortest, with ratio,
        ratio_low and ratio_high, which are nan where nothing is known
    about : the scenes in words, as they stand after "friction of"
    wide : half an interval of 95 %, relative, from which on a scene is to be solved in 3D
    """
    caption = (
        f"1D over 3D, friction of {about}. Lines: equal ratios, dashed below 1. Right: the smooth body, the limit "
        f"of roughness pressed flat. Hatched: an interval of 95 % wider than ±{100 * wide:.0f} %, or beyond what "
        "was measured."
    )
    known = table["ratio"].dropna()
    alternative = f"Map of 1D over 3D, from {known.min():.2g} to {known.max():.2g}; beside it, the smooth body."
    return Plot(f"{folder}{NAME}", figure, {NAME: table}, caption, alternative, {"wide": wide})


def figure(tables: Tables, wide: float) -> Figure:
    """One map with lines of equal ratios, and the smooth body beside it."""
    everything, low, high = (_unstacked(tables[NAME], name) for name in ("ratio", "ratio_low", "ratio_high"))
    logarithm, smooth = everything.drop(columns=np.inf), everything[FLAT]
    least, most = (float(end) for end in (np.nanmin(everything), np.nanmax(everything)))
    drawing = style.canvas("single", 3.7)
    axes = drawing.subplots()
    strip = axes.inset_axes((1 + GAP, 0, STRIP, 1), sharey=axes)
    fields = (axes, logarithm.columns, logarithm), (strip, (0, 1), smooth)

    ends = np.floor(BANDS * least - 0.5) + 0.5, BANDS * most + 1
    look: dict[str, Any] = {"norm": CenteredNorm(0, max(-least, most)), "cmap": shades.ratio()}
    image, _ = (
        panel.contourf(x, each.index, each, levels=np.arange(*ends) / BANDS, **look) for panel, x, each in fields
    )
    _hatch(axes, (high - low).drop(columns=np.inf) / 2, wide)
    axes.set(xscale="log", yscale="log", xlabel="$p\\,/\\,(E^*h')$ [1]", ylabel=r"$v\tau q_s$ [1]")
    style.decades(axes)
    strip.set(xticks=[0.5], xticklabels=["smooth"])
    strip.tick_params(which="both", bottom=False, left=False, labelleft=False)
    for panel in (axes, strip):
        panel.spines[:].set_visible(True)
    bar = shades.colours(drawing, image, "friction, 1D / 3D [1]", ax=axes, location="bottom", aspect=30)
    shown = [level for level in LEVELS if least <= np.log(level) <= most]
    bar.set_ticks(np.log(shown).tolist(), labels=[f"{level:g}" for level in shown])

    style.lay_out(drawing)  # labels stand on lines as they lie in the end
    levels = [level for level in shown if least + GRAZED < np.log(level) < most - GRAZED]
    for panel, x, each in fields:
        _lines(panel, x, each, levels)
    return drawing


def _hatch(axes, half, wide):
    """Hatch where half an interval is wide or unknown, and say so above."""
    over = (half / wide).fillna(np.inf).clip(upper=2.0)
    hatched = axes.contourf(over.columns, over.index, over, levels=(1, 3), colors="none", hatches=[HATCH])
    hatched.set(edgecolor=style.grey(0.3), linewidth=0)
    axes.set_facecolor(style.grey(BEHIND))
    if (over > 1).any(axis=None):
        sample = Patch(facecolor=style.grey(BEHIND), edgecolor=style.grey(0.3), hatch=HATCH, label="solve in 3D")
        axes.legend(handles=[sample], loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.3)


def _lines(axes, x, logarithm, levels):
    """Draw lines of equal ratios through a map or a strip, and write what neither frame nor another ratio cuts."""
    crossed = [level for level in levels if np.nanmin(logarithm) < np.log(level) < np.nanmax(logarithm)]
    if not crossed:
        return
    widths = [style.width(0.4 if level == 1 else 0.8) for level in crossed]
    look = {"levels": np.log(crossed), "colors": [style.ink()], "linewidths": widths}
    lines = axes.contour(x, logarithm.index, logarithm, **look)
    written = {"fmt": lambda value: f"{np.exp(value):.3g}", "fontsize": style.small()}
    inside, whole, boxes = axes.get_window_extent(), [], []
    for text in sorted(axes.clabel(lines, inline=False, **written), key=lambda text: text.get_text() not in FIRST):
        box = text.get_window_extent()
        cut = not (inside.x0 < box.x0 and box.x1 < inside.x1 and inside.y0 < box.y0 and box.y1 < inside.y1)
        if not cut and not box.count_overlaps(boxes):
            whole.append(text.get_position())
            boxes.append(box)
        text.remove()
    if whole:
        axes.clabel(lines, manual=whole, **written)


def _unstacked(table, name):
    """Logarithms of a column: a row a speed, a column a pressure."""
    return np.log(touching.unstacked(table, "memory_over_shortest", "pressure_over_slope", name))
