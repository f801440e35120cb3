"""What becomes of Eq. 22 with the loss of every wave at its own frequency: its forms against the simulation."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..paper.parameters import FORCES, SPEEDS
from ..paper.predicted import EVERY, SHORTEST, STIFFNESS, WITH_SMOOTH
from ..paper.shifts import Lossy
from ..plots import style

NAME = "paper-losses"
SHOWN = (0, len(SPEEDS) // 2, len(SPEEDS) - 1)
# Markers of the forms of Eq. 22.
FORMS = {SHORTEST: "s", EVERY: "o", WITH_SMOOTH: "^"}
LINES = ("-", "--", ":")


def figure(found: Sequence[Lossy]) -> Figure | None:
    """A panel for each rubber: each form over the simulation, at three speeds. None without any."""
    if not found:
        return None
    rows = -(-len(found) // 2)
    drawing = style.canvas("double", 0.7 + 2.3 * rows)
    panels = drawing.subplots(rows, 2, sharex=True, sharey="row", squeeze=False)
    for axes, lossy in zip(panels.flat, found, strict=False):
        holds = lossy.predicted.conditions.holds
        for name, colour, marker in _forms():
            off = 100 * _deviations(lossy)[name]
            for speed, line in zip(SHOWN, LINES, strict=True):
                axes.plot(FORCES, off[speed], line, color=colour, linewidth=style.width(0.8))
                for at, inside in ((holds[speed], colour), (~holds[speed], style.paper())):
                    look = {
                        "facecolors": inside,
                        "edgecolors": colour,
                        "linewidths": style.width(0.7),
                        "zorder": 2.5,
                    }
                    axes.scatter(
                        np.array(FORCES)[at], off[speed][at], s=style.mark(0.8) ** 2, marker=marker, **look
                    )
        axes.axhline(0, color=style.grey(0.3), linewidth=style.width(0.65), zorder=0)
        axes.set(xscale="log", title=lossy.loss.symbols)
        style.span(axes, FORCES)
        style.decades(axes)
    for axes in panels.flat[len(found) :]:
        axes.set_axis_off()
    for axes in panels[:, 0]:
        axes.set_ylabel("Eq. 22 / simulation - 1 [%]")
    for axes in panels[-1]:
        axes.set_xlabel("normal force [N]")
    _legend(drawing)
    return drawing


def sheets(found: Sequence[Lossy]) -> dict[str, list[dict]]:
    """Friction at every speed and load: simulated, of the smooth body, of each form; and exponents of the "
    "shifts."""
    points: list[dict] = []
    shifts: list[dict] = []
    for lossy in found:
        simulated, forms, conditions = simulation(lossy), lossy.forms, lossy.predicted.conditions.columns
        rubber = {"loss_exponent": lossy.loss.exponent, "relaxation_time": lossy.loss.relaxation_time}
        points.extend(
            {
                **rubber,
                "speed": speed,
                "normal_force": load,
                "simulated": simulated[i, j],
                "smooth": lossy.smooth[i, j],
                **{name.replace(" ", "_"): form[i, j] for name, form in forms.items()},
                **{name: column[i, j] for name, column in conditions.items()},
            }
            for i, speed in enumerate(SPEEDS)
            for j, load in enumerate(FORCES)
        )
        shifts.append(rubber | exponents(lossy))
    return {NAME: points, f"{NAME}-shifts": shifts} if points else {}


def exponents(lossy: Lossy) -> dict[str, float | None]:
    """Of the shift as a power of the speed: expected, of each form, and simulated with its interval; NaN of curves
    that do not collapse."""
    row = {"expected": lossy.whole.expected, **lossy.rough.laws, **lossy.whole.laws}
    for name, each in (("simulated", lossy.whole), ("simulated less smooth body", lossy.rough)):
        row[name] = each.exponent
        row[f"{name}, low"], row[f"{name}, high"] = each.within
    return row


def caption(found: Sequence[Lossy]) -> str:
    """What the figure shows."""
    speeds = ", ".join(f"{SPEEDS[speed]:.2g}" for speed in SHOWN)
    return (
        "How far Eq. 22, with its number corrected, is off the simulated friction of a rough sphere, at the "
        f"speeds of {speeds} m/s (full, broken, dotted), where the loss modulus grows as the power β of the "
        "frequency. Three forms: with the loss at the frequency of the shortest wave for all waves, as "
        "published; with the loss of every wave at its own frequency, of the line that is solved, straight "
        "between nodes; and the latter with the simulated friction of the smooth sphere added, since Eq. 22 "
        "leaves the macroscopic slope out. Hollow: the macroscopic modulus |G(v/a)| exceeds G₀ by more than a "
        "tenth. The stiffer contact is smaller than the laws have it, and follows the roughness less: with the "
        "shorter τ, of which the modulus is constant, that part of the deviation is gone. "
        f"{' '.join(map(_said, found))} {_regime(found)}"
    )


def _regime(found):
    """Where the loads stand; the same for every loss, as the relaxed contact and the roughness are."""
    ratios = found[0].predicted.conditions.ratios
    height, width, macro, slope = (
        ratios[name].max()
        for name in ("height_over_depth", "contact_over_period", "macro_over_rough", "rms_slope")
    )
    return (
        f"At all loads the rms height is at most {height:.2g} of the depth, the width of the contact at most "
        f"{width:.2g} of the longest wave, and the macroscopic slope at most {macro:.2g} of that of the "
        f"roughness, {slope:.2g}."
    )


def simulation(lossy: Lossy) -> np.ndarray:
    """Simulated friction (speeds, loads), NaN where there is none."""
    friction = np.full(lossy.smooth.shape, np.nan)
    for row, curve in zip(friction, lossy.whole.collapse.curves, strict=True):
        at = np.abs(np.subtract.outer(np.log(FORCES), curve.log_load)).argmin(axis=0)
        row[at] = np.exp(curve.log_friction)
    return friction


def _deviations(lossy):
    simulated = simulation(lossy)
    return {name: form / simulated - 1 for name, form in lossy.forms.items()}


def _said(lossy):
    deviations = _deviations(lossy)
    ranges = "; ".join(f"{name} {np.nanmin(of):+.1%} to {np.nanmax(of):+.1%}" for name, of in deviations.items())
    missing = int(np.isnan(simulation(lossy)).sum())
    failed = (
        f" {lossy.failed} solves failed; {missing} points without any answer are left out." if lossy.failed else ""
    )
    conditions = lossy.predicted.conditions
    ratio = conditions.ratios[STIFFNESS]
    return (
        f"{lossy.loss.symbols}, over all {len(SPEEDS)} speeds and {len(FORCES)} loads: {ranges}; |G(v/a)|/G₀ "
        f"{ratio.min():.2f} to {ratio.max():.2f}. {conditions.words}{failed}"
    )


def _forms():
    """Name, colour and marker of each."""
    return zip(FORMS, (style.ink(), "#CC79A7", "#009E73"), FORMS.values(), strict=True)


def _legend(drawing):
    forms = [
        Line2D([], [], color=colour, marker=marker, markersize=style.mark(0.75), label=name)
        for name, colour, marker in _forms()
    ]
    speeds = [
        Line2D([], [], color=style.grey(0.2), linestyle=line, label=f"{SPEEDS[speed]:.2g} m/s")
        for speed, line in zip(SHOWN, LINES, strict=True)
    ]
    pairs = [handle for pair in zip(forms, speeds, strict=True) for handle in pair]
    style.legend(drawing, pairs, "outside lower center", 3)
