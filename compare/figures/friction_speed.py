"""Coefficient of friction against speed at the scene's load or depth."""

import numpy as np
from matplotlib.figure import Figure

from mdr1d.equations import interpolation, plateau, similarity_variable

from .. import metrics
from ..verdict import Judgement
from ..plots import style
from .force_depth import averaged
from ..plots.lettering import clear

NAME = "friction-speed"
LAW = (
    "Eq. 19 with exponent 1.5 and the rms slope that the 1D profiles have; it leaves the slope of the smooth "
    "shape out."
)


def figure(judgement: Judgement) -> Figure | None:
    """Above: friction. Below: 1D over 3D. None unless something slides."""
    pairs = metrics.pairs(judgement.table, "speed")
    if not pairs:
        return None
    drawing = style.canvas("single", 3.9)
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2.2, 1))
    above.set(xscale="log", yscale="log", ylabel="coefficient of friction [1]")
    style.span(above, [a.speed for a, _ in pairs])
    for solver in ("MDR", "BEM"):
        curve = metrics.select(judgement.table, "speed", solver)
        style.line(above, [r.speed for r in curve], [r.friction_coefficient for r in curve], solver)
    lowest = above.get_ylim()[0]
    _paper(above, judgement, [a for a, _ in pairs])
    # Where the smooth shape rules, Eq. 19 lies decades below: it must not press the curves together.
    above.set_ylim(bottom=max(above.get_ylim()[0], lowest / 3))
    above.legend()
    ratios = [metrics.ratio(a.friction_coefficient, b.friction_coefficient) for a, b in pairs]
    errors = np.nan_to_num([error for _, error in ratios])
    below.axhline(1, color=style.grey(0.6), linewidth=style.width(0.55))
    below.errorbar(
        [a.speed for a, _ in pairs], [value for value, _ in ratios], yerr=errors, color=style.ink(), marker="o"
    )
    below.set(xlabel="speed [m/s]", ylabel="1D / 3D [1]", ylim=(0, None))
    for axes in (above, below):
        style.decades(axes)
    clear(drawing, (above,))
    return drawing


def sheets(judgement: Judgement):
    """Every point of the figure."""
    return {NAME: [record.columns for record in judgement.table if record.kind == "speed"]}


def caption(judgement: Judgement) -> str:
    """What the figure shows."""
    motion = judgement.case.motion
    held = f"load of {motion.load:g} N" if motion.load is not None else f"depth of {motion.greatest * 1e6:g} µm"
    paper = "" if judgement.case.roughness is None else f" Dotted: {LAW}"
    return (
        f"Coefficient of friction against speed at a {held}; below, the ratio of one dimension to three with its "
        f"standard error.{paper} {averaged(judgement, 'speed')}"
    )


def law(judgement: Judgement, load, speed, rms_slope):
    """mu of Eq. 19 at loads [N] and speeds [m/s]."""
    case = judgement.case
    time = float(case.scene.solid.retardation()[2].max())
    shape = (case.indenter.mdr_coefficient, case.indenter.exponent)
    # Eqs. 18 and 19 are written for a Poisson ratio of 1/2.
    modulus = case.scene.solid.indentation_modulus / 4
    xi = similarity_variable(load, modulus, time, speed, rms_slope, *shape)
    return plateau(rms_slope) * interpolation(xi)


def _paper(axes, judgement, records):
    rms_slope = records[0].rms_slope.mean
    if not np.isfinite(rms_slope) or not np.isfinite(records[0].load) or len(records) < 2:
        return
    speed = np.geomspace(records[0].speed, records[-1].speed, 101)
    mu = law(judgement, records[0].load, speed, rms_slope)
    axes.plot(speed, mu, ":", color=style.grey(0.3), linewidth=style.width(0.9), label="Eq. 19, roughness alone")
