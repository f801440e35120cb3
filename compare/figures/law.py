"""The law in three dimensions: what roughness adds over that in full contact, friction by the shortest wave."""

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame

from . import shades, style
from .curves import AXES, curves, limit
from .plot import Plot, Tables

NAME, SHARE = "law", "law-share"
WAVES, SCENE = "friction-waves", "friction-waves-scene"


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


def waves_plot(law: DataFrame, points: DataFrame, folder: str = "") -> Plot:
    """Plot of friction against the shortest wave that the roughness keeps.

    law : shortest [m], rms_slope, friction, friction_low and friction_high by the law in 3D
    points : of the scene as it stands: model, shortest [m], friction_coefficient_mean, _low and _high
    """
    caption = (
        "Friction against the shortest wave of the roughness by the law in 3D, with its interval of 95 %, and of "
        "the scene as it is solved; grey, waves finer than its own, in the same spectrum."
    )
    return Plot(f"{folder}{WAVES}", waves, {WAVES: law, SCENE: points}, caption, "Friction by the shortest wave")


def waves(tables: Tables) -> Figure:
    """Friction by the law as a band, the scene as points."""
    law, points = tables[WAVES].sort_values("rms_slope"), tables[SCENE]
    drawing = style.canvas("single", 3.0)
    axes, (scale, label) = drawing.subplots(), AXES["shortest"]
    x, look = scale * law["shortest"], style.look("FrictionLaw", marker="")
    axes.fill_between(x, law["friction_low"], law["friction_high"], color=look["color"], alpha=0.3, linewidth=0)
    axes.plot(x, law["friction"], **look)
    axes.axvspan(x.min(), scale * points["shortest"].min(), color=style.grey(0.9), linewidth=0)
    if law["rms_slope"].max() > 1:
        steep = np.exp(np.interp(1, law["rms_slope"], np.log(x)))
        axes.axvline(steep, **style.line(0.3, 0.8, label="rms slope 1"))
    curves(axes, points, "shortest", "friction_coefficient")
    axes.set(xscale="log", yscale="log", xlabel=label, ylabel="friction coefficient [1]")
    style.decades(axes)
    style.legend(drawing, [axes], 2)
    return drawing
