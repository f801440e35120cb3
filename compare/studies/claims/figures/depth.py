"""Depth and force of one series at rest, and pressed in at constant rates, in one dimension against three."""

from typing import Any

from matplotlib.figure import Figure

from ....figures import shades, style
from ....figures.curves import intervals
from ....figures.lettering import clear, lettered
from ....report.page import Tables

SOLVER = {"1D": "MDR", "3D": "BEM"}
CLOSED = "closed form"
# Neighbouring markers are drawn apart by this factor of the load or depth, either way.
APART = 1.02
# Labels of what is measured less the smooth closed form, in rms heights or percent, and of 1D less 3D; factor of
# the first.
LABELS = {
    "load": ("depth less the smooth one [$h_0$]", "depth 1D - 3D [% of smooth]", 1.0),
    "depth": ("force less the smooth one [%]", "force 1D / 3D - 1 [%]", 100.0),
}
PRESCRIBED = {"load": ("normal force [N]", 1.0), "depth": ("depth [µm]", 1e6)}


def depth(tables: Tables) -> Figure:
    """Less the smooth closed form, 1D less 3D, and stiffness."""
    points, differences, stiffness = tables["depth"], tables["depth-differences"], tables["depth-stiffness"]
    prescribed = "load" if "load" in points else "depth"
    less, apart, unit = LABELS[prescribed]
    across, scale = PRESCRIBED[prescribed]
    drawing = style.canvas("double", 3.1)
    deviation, difference, stiff = panels = drawing.subplots(1, 3)
    grey = style.line(0.45, 0.8, zorder=1)
    for axes, name in ((deviation, less), (difference, apart)):
        axes.axhline(0, **grey)
        axes.set(xscale="log", xlabel=across, ylabel=name)
        style.span(axes, scale * points[prescribed])
    hollow = {"markerfacecolor": style.paper(), "linestyle": "none"}
    for index, (dimension, own) in enumerate(points.groupby("dimension")):
        solver, x = SOLVER[dimension], scale * own[prescribed] * APART ** (2 * index - 1)
        smooth = _look(solver, label=f"{dimension}, smooth") | hollow
        intervals(deviation, x, own, "smooth_deviation", unit, **smooth)
        intervals(deviation, x, own, "rough_deviation", unit, **_look(solver, label=f"{dimension}, rough"))
    looks: dict[str, dict[str, Any]] = {
        "smooth": {"color": style.grey(0.5), "marker": "D", "linestyle": ":", "markerfacecolor": style.paper()},
        "rough": {"color": style.ink(), "marker": "o"},
    }
    for body, own in differences.groupby("body"):
        look = _look("exact", **looks[body], label=f"1D against 3D, {body}")
        intervals(difference, scale * own[prescribed], own, "difference", 100.0, **look)
    for dimension, own in stiffness.groupby("dimension"):
        if dimension == CLOSED:
            stiff.plot(own["normal_force"], 1e-3 * own["stiffness"], label="smooth, closed form", **grey)
        else:
            intervals(stiff, own["normal_force"], own, "stiffness", 1e-3, **_look(SOLVER[dimension], label=None))
    stiff.set(xscale="log", yscale="log", xlabel="normal force [N]", ylabel="stiffness [kN/m]")
    lettered(panels)
    handles = [handle for axes in panels for handle in axes.get_legend_handles_labels()[0]]
    style.legend(drawing, handles, "outside lower center", 4)
    style.decades(*panels)
    return drawing


def pressed_in(tables: Tables) -> Figure:
    """Force against depth at each rate: left 1D, middle 3D, right 1D over 3D."""
    every, ratios = tables["pressed-in"], tables["pressed-in-ratios"]
    drawing = style.canvas("double", 3.2)
    one, three, ratio = panels = drawing.subplots(1, 3)
    three.sharey(one)
    scale = shades.between(every["rate"])
    ratio.axhline(0, **style.line(0.45, 0.8, zorder=1))
    cross = {"color": style.COLOUR["exact"], "markersize": style.mark(1.25)}
    rates = sorted(set(every["rate"]))
    for k, rate in enumerate(rates):
        colour, apart = shades.SPEED(scale(rate)), APART ** (k - (len(rates) - 1) / 2)
        thin = {"color": colour, "linewidth": style.width(0.55)}
        rough, smooth, closed = ("rough", "smooth", "smooth, closed form") if k == 0 else (None,) * 3
        for axes, (dimension, solver) in zip((one, three), SOLVER.items(), strict=True):
            own = every[(every["rate"] == rate) & (every["dimension"] == dimension)]
            depths = 1e6 * own["depth"]
            intervals(axes, depths * apart, own, "normal_force", **_look(solver, color=colour, label=rough))
            axes.plot(depths, own["smooth_normal_force"], label=smooth, **thin)
            axes.plot(depths, own[CLOSED.replace(" ", "_")], "+", label=closed, **cross)
        own = ratios[ratios["rate"] == rate]
        look = _look("exact", color=colour, marker="D", label=None)
        intervals(ratio, 1e6 * own["depth"] * apart, own, "rough_difference", 100.0, **look)
        ratio.plot(1e6 * own["depth"], 100 * own["smooth_difference"], **thin)
    for axes, solver in ((one, "MDR"), (three, "BEM")):
        axes.set(yscale="log", title=style.LABEL[solver])
    ratio.set(ylabel="force 1D / 3D - 1 [%]", title="1D over 3D")
    for axes in panels:
        axes.set(xscale="log", xlabel="depth [µm]")
        style.span(axes, 1e6 * every["depth"])
    style.decades(*panels)
    one.set_ylabel("normal force [N]")
    lettered(panels)
    one.legend()
    place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.05, "pad": 0.02}
    shades.bar(drawing, panels, shades.SPEED, scale, "rate of indentation [m/s]", **place)
    clear(drawing, (one,))
    return drawing


def _look(solver, **other):
    return style.look(solver, linewidth=style.width(0.7), markersize=style.mark(0.9)) | other
