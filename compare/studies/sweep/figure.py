"""Friction of a sweep against speed, or against load at one speed, in both dimensionalities."""

from matplotlib.figure import Figure
from pandas import DataFrame

from ...report.page import Plot, Tables
from ...report.plots import style
from ...report.plots.curves import intervals, unanswered

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
    """One panel: friction against speed, or against load or depth where there is one speed."""
    means = tables["friction"]
    prescribed = "load" if "load" in means else "depth"
    across = "speed" if means["speed"].nunique() > 1 else prescribed
    other = prescribed if across == "speed" else "speed"
    drawing = style.canvas("single", 2.6)
    axes = drawing.subplots()
    for solver, of_solver in means[means["speed"] > 0].groupby("solver", sort=False):
        for index, (value, curve) in enumerate(of_solver.groupby(other)):
            label = style.label(str(solver))
            if of_solver[other].nunique() > 1:
                label += f", {value:.3g} {UNITS[other]}"
            line = style.SERIES_LINES[index % len(style.SERIES_LINES)]
            look = style.look(solver, label=label, linestyle=line, capsize=2)
            intervals(axes, curve[across], curve, "friction_coefficient", **look)
            unanswered(axes, curve[across], curve["friction_coefficient_mean"], look["color"], label)
    axes.set(xscale="log", yscale="log", ylabel="coefficient of friction [1]")
    axes.set_xlabel(f"{WORDS[across]} [{UNITS[across]}]")
    axes.legend()
    style.decades(axes)
    return drawing
