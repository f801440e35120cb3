"""The master curve in three dimensions: what roughness adds to friction, over that in full contact, is S(x)."""

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame

from . import shades, style
from .curves import curves, limit
from .plot import Plot, Tables

NAME, SHARE = "law", "law-share"


def plot(points: DataFrame, share: DataFrame, missed: str = "", folder: str = "") -> Plot:
    """Plot of the master curve of a series.

    points : speed [m/s], pressure_ratio (x), share_of_full_contact (S of x), measured_share,
        measured_share_low and measured_share_high; claimed, false where the law claims nothing
    share : pressure_ratio, share_of_full_contact_low and share_of_full_contact_high over all speeds
    missed : misfit in words
    """
    caption = (
        "What roughness adds to friction in 3D, over that in full contact, against the mean pressure over the rms "
        "pressure of the roughness there; band, S(x) at all speeds. Below, off it, 5 % in grey. Hollow: too rough "
        "for the law to claim, without bars. Bars: 95 %."
    )
    options = {"missed": missed}
    return Plot(f"{folder}{NAME}", figure, {NAME: points, SHARE: share}, caption, "Points around S(x)", options)


def figure(tables: Tables, missed: str = "") -> Figure:
    """Above: share of full contact. Below: off S(x). missed : misfit in words"""
    points, share = tables[NAME], tables[SHARE]
    drawing = style.canvas("single", 4.6)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(1.5, 1))
    scale = shades.between(points["speed"])
    band = (share[f"share_of_full_contact_{end}"] for end in ("low", "high"))
    above.fill_between(share["pressure_ratio"], *band, color=style.grey(0.65), linewidth=0, label="S(x)")
    below.axhspan(-5, 5, color=style.grey(0.9), linewidth=0)
    below.axhline(0, **style.line(0, 0.8))
    logs = np.log(points.filter(like="measured_share").where(lambda share: share > 0))
    off = logs.sub(np.log(points["share_of_full_contact"]), axis=0)
    for numbers in (points, off):
        numbers.loc[~points["claimed"], ["measured_share_low", "measured_share_high"]] = np.nan

    def look(speed, claimed):
        own = {"color": shades.SPEED(scale(speed)), "marker": "o", "linestyle": "none"}
        return own if claimed else own | {"markerfacecolor": style.paper()}

    for axes, numbers, times in ((above, points, 1), (below, points.assign(**off), 100)):
        curves(axes, numbers, "pressure_ratio", "measured_share", times, ("speed", "claimed"), look)
    above.set(xscale="log", yscale="log", ylabel="share of full contact [1]")
    limit(above, points, "measured_share")
    below.set(title=missed, xlabel=r"$x = p\,/\,p_\mathrm{rms}$ [1]", ylabel="off S(x) [%]")
    hollow = [] if points["claimed"].all() else [style.entry("not claimed", markerfacecolor=style.paper())]
    style.finish(drawing, 3, *hollow, *shades.key(shades.SPEED, points["speed"], "m/s"))
    return drawing
