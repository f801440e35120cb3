"""Friction of a sweep against speed, or against load at one speed, in both dimensionalities."""

from matplotlib.figure import Figure
from pandas import DataFrame

from ...figures import style
from ...figures.curves import intervals, unanswered
from ...figures.lettering import clear, lettered
from ...report.page import Plot, Tables

UNITS = {"speed": "m/s", "load": "N", "depth": "m"}
WORDS = {"speed": "speed", "load": "normal force", "depth": "depth"}


def plot(means: DataFrame) -> Plot:
    """The plot of the means of a sweep."""
    return Plot(
        "friction",
        figure,
        {"friction": means},
        "Coefficient of friction in one and in three dimensions. Bars are intervals of 95 %: scatter of the "
        "draws, widened by the change on halving the grid.",
        "Friction of both models as two curves with error bars.",
    )


def figure(tables: Tables) -> Figure:
    """Friction against speed, or load or depth at one speed; several curves in a panel of each model."""
    means = tables["friction"]
    means = means[means["speed"] > 0]
    prescribed = "load" if "load" in means else "depth"
    across = "speed" if means["speed"].nunique() > 1 else prescribed
    other = prescribed if across == "speed" else "speed"
    solvers, count = list(means["solver"].unique()), means[other].nunique()
    several = count > 1
    drawing = style.canvas("double" if several else "single", 2.9 if several else 2.6)
    panels = drawing.subplots(1, len(solvers) if several else 1, sharex=True, sharey=True, squeeze=False)[0]
    for axes, solver in zip(panels if several else len(solvers) * [panels[0]], solvers, strict=True):
        shades = style.shades(str(solver), count) if several else [style.COLOUR[str(solver)]]
        curves = means[means["solver"] == solver].groupby(other)
        for shade, form, (value, curve) in zip(shades, style.forms(), curves, strict=False):
            own = form | {"label": f"{value:.3g} {UNITS[other]}"} if several else {}
            look = style.look(str(solver), color=shade, capsize=2, **own)
            intervals(axes, curve[across], curve, "friction_coefficient", **look)
            unanswered(axes, curve[across], curve["friction_coefficient_mean"], shade, look["label"])
        axes.set(xscale="log", yscale="log", xlabel=f"{WORDS[across]} [{UNITS[across]}]")
        if several:
            axes.set_title(style.label(str(solver)))
    style.span(panels[0], means[across])
    panels[0].set_ylabel("coefficient of friction [1]")
    style.decades(*panels)
    for axes in panels:
        axes.legend(ncols=2 if count > 4 else 1)
    if several:
        lettered(panels)
        clear(drawing, panels)
    return drawing
