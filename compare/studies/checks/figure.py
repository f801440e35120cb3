"""Misfit of every law over its bound."""

from typing import Any

from matplotlib.figure import Figure
from pandas import DataFrame

from ...figures import style
from ...figures.plot import Plot, Tables

NAME = "verify"
LEAST, MOST = 1e-6, 1e3  # of a misfit over its bound, that are shown


def plot(laws: DataFrame, model: str) -> Plot:
    """The plot of the laws of a scorecard that were asked."""
    return Plot(
        NAME,
        figure,
        {NAME: laws[["group", "law", "outcome", "nearness"]]},
        f"Misfit of {model} in each law over the bound of that law. Right of the line a law fails; those below "
        "1e-6 and above 1000 are shown there.",
        "Rows of points, one a group, left and right of a vertical line at one.",
    )


def figure(tables: Tables) -> Figure:
    """A row of points a group; open where a law fails."""
    laws = tables[NAME]
    groups = list(dict.fromkeys(laws["group"]))
    drawing = style.canvas("double", 0.8 + 0.28 * max(len(groups), 1))
    axes = drawing.subplots()
    for row, group in enumerate(groups):
        own = laws[laws["group"] == group]
        for outcome, marker in (("holds", "o"), ("fails", "X")):
            shown = own[own["outcome"] == outcome]["nearness"].clip(LEAST, MOST)
            inside = style.ink() if outcome == "fails" else "none"
            look: dict[str, Any] = {
                "linestyle": "none",
                "marker": marker,
                "color": style.ink(),
                "markerfacecolor": inside,
            }
            axes.plot(shown, [row] * len(shown), **look)
    axes.axvline(1.0, **style.line(0.4))
    axes.set_yticks(range(len(groups)), groups)
    axes.set(xscale="log", xlabel="misfit over bound [1]", ylim=(len(groups) - 0.5, -0.5))
    return drawing
