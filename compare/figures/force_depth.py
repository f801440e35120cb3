"""Normal force against depth at rest, rough and smooth, and how far one dimension is from three."""

from matplotlib.figure import Figure

from .. import metrics
from ..verdict import Judgement
from . import style

NAME = "force-depth"


def figure(judgement: Judgement) -> Figure | None:
    """Above: force. Below: 1D over 3D. None without points."""
    table = judgement.table
    if not metrics.pairs(table, "force-depth"):
        return None
    drawing = style.canvas(style.SINGLE, 3.9)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    exact = metrics.select(table, "force-depth", "exact", True)
    if exact:
        above.plot([r.depth * 1e6 for r in exact], [r.normal_force.mean for r in exact], "-", color="0.45", lw=0.9,
                   label="smooth, closed form")  # fmt: skip
    for solver in ("MDR", "BEM"):
        for smooth in (True, False):
            curve = metrics.select(table, "force-depth", solver, smooth)
            if not curve:
                continue
            body = {"markerfacecolor": "white", "linestyle": "none"} if smooth else {}
            label = f"{style.LABEL[solver]}, {'smooth' if smooth else 'rough'}"
            if smooth and solver == "BEM":
                body |= {"markersize": 6.5, "zorder": 1}
            style.line(above, [r.depth * 1e6 for r in curve], [r.normal_force for r in curve], solver,
                       label=label, **body)  # fmt: skip
    _deviation(below, table)
    above.set(ylabel="normal force [N]", xscale="log", yscale="log")
    below.set(xlabel="depth [µm]", ylabel="1D / 3D - 1 [%]")
    above.legend()
    for axes in (above, below):
        style.decades(axes)
    return drawing


def sheets(judgement: Judgement):
    """Every point of the figure."""
    return {NAME: [record.columns for record in judgement.table if record.kind == "force-depth"]}


def caption(judgement: Judgement) -> str:
    """What the figure shows."""
    return (
        "Force against depth, pressed in at rest. Below: deviation of the one-dimensional force from the "
        f"three-dimensional one at the same depth. {averaged(judgement, 'force-depth')}"
    )


def averaged(judgement: Judgement, kind: str) -> str:
    """How many surfaces, and what bars and bands mean."""
    rough = [r for r in judgement.table if r.kind == kind and not r.smooth]
    if not rough:
        return "The body is smooth: there is no scatter."
    count = {s: max((r.normal_force.count for r in rough if r.solver == s), default=0) for s in ("MDR", "BEM")}
    return (
        f"Rough: mean over {count['MDR']} profiles (1D) and {count['BEM']} surfaces (3D); bars are standard "
        "errors of the mean, bands the standard deviation of one surface."
    )


def _deviation(axes, table):
    axes.axhline(0, color="0.6", linewidth=0.6)
    for smooth, look in ((False, {"color": "black", "marker": "o"}), (True, {"color": "0.45", "marker": "D"})):
        pairs = metrics.pairs(table, "force-depth", smooth)
        if not pairs:
            continue
        values = [metrics.relative_deviation(a.normal_force, b.normal_force) for a, b in pairs]
        errors = [0 if smooth else 100 * error for _, error in values]
        axes.errorbar([a.depth * 1e6 for a, _ in pairs], [100 * value for value, _ in values], yerr=errors,
                      linestyle=":" if smooth else "-", label="smooth" if smooth else "rough", **look)  # fmt: skip
    axes.legend(ncols=2, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.1)
