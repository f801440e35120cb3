"""What becomes of Eq. 22 with the loss of every wave at its own frequency: its forms against the simulation."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..paper.parameters import FORCES, SPEEDS
from ..paper.shifts import Lossy
from . import style

NAME = "paper-losses"
SHOWN = (0, len(SPEEDS) // 2, len(SPEEDS) - 1)
# Name, colour and marker of each form of Eq. 22.
FORMS = (
    ("shortest wave", "#D55E00", "s"),
    ("every wave", "#0072B2", "o"),
    ("every wave and smooth body", "#009E73", "^"),
)
LINES = ("-", "--", ":")


def figure(found: Sequence[Lossy]) -> Figure | None:
    """A panel for each exponent of the loss: each form over the simulation, at three speeds. None without any."""
    if not found:
        return None
    drawing = style.canvas(style.DOUBLE, 3.1)
    panels = drawing.subplots(1, len(found), sharey=True, squeeze=False)[0]
    for axes, lossy in zip(panels, found, strict=True):
        deviations = _deviations(lossy)
        for name, colour, marker in FORMS:
            for speed, line in zip(SHOWN, LINES, strict=True):
                axes.plot(
                    FORCES,
                    100 * deviations[name][speed],
                    line,
                    color=colour,
                    marker=marker,
                    markersize=3,
                    markerfacecolor="white",
                    linewidth=0.9,
                )
        axes.axhline(0, color="0.3", linewidth=0.7, zorder=0)
        axes.set(xscale="log", xlabel="normal force [N]", title=rf"$\beta$ = {lossy.exponent:g}")
        style.span(axes, FORCES)
        style.decades(axes)
    panels[0].set_ylabel("Eq. 22 / simulation - 1 [%]")
    _legend(drawing)
    return drawing


def sheets(found: Sequence[Lossy]) -> dict[str, list[dict]]:
    """Friction at every speed and load: simulated, of the smooth body, and of each form."""
    rows = []
    for lossy in found:
        simulated, forms = simulation(lossy), _forms(lossy)
        rows.extend(
            {
                "loss_exponent": lossy.exponent,
                "speed": speed,
                "normal_force": load,
                "simulated": simulated[i, j],
                "smooth": lossy.smooth[i, j],
                **{name.replace(" ", "_"): form[i, j] for name, form in forms.items()},
            }
            for i, speed in enumerate(SPEEDS)
            for j, load in enumerate(FORCES)
        )
    return {NAME: rows} if rows else {}


def caption(found: Sequence[Lossy]) -> str:
    """What the figure shows."""
    speeds = ", ".join(f"{SPEEDS[speed]:.2g}" for speed in SHOWN)
    return (
        "How far Eq. 22, with its number corrected, is off the simulated friction of a rough sphere, at the "
        f"speeds of {speeds} m/s (full, broken, dotted), where the loss modulus grows as the power β of the "
        "frequency. Three forms: with the loss at the frequency of the shortest wave for all waves, as "
        "published; with the loss of every wave at its own frequency; and the latter with the simulated "
        "friction of the smooth sphere added, since Eq. 22 leaves the macroscopic slope out. "
        f"{' '.join(map(_said, found))} {_regime(found[0].regime)}"
    )


def _regime(regime):
    """Where the loads stand; the same for every loss, as the relaxed contact and the roughness are."""
    broken = [name for name, holds in regime.flags.items() if not np.all(holds)]
    height, width = np.max(regime.height_over_depth), np.max(regime.contact_over_period)
    macro, slope = np.max(regime.macro_over_rough), np.max(regime.rms_slope)
    return (
        f"At all loads the rms height is at most {height:.2g} of the depth, the width of the contact at most "
        f"{width:.2g} of the longest wave, and the macroscopic slope at most {macro:.2g} of that of the "
        f"roughness, {slope:.2g}. Conditions of the laws that do not hold everywhere: "
        f"{', '.join(broken) or 'none'}."
    )


def simulation(lossy: Lossy) -> np.ndarray:
    """Simulated friction (speeds, loads), NaN where there is none."""
    friction = np.full(lossy.smooth.shape, np.nan)
    for row, curve in zip(friction, lossy.whole.collapse.curves, strict=True):
        at = np.abs(np.subtract.outer(np.log(FORCES), curve.log_load)).argmin(axis=0)
        row[at] = np.exp(curve.log_friction)
    return friction


def _forms(lossy):
    forms = lossy.one_frequency, lossy.spectral, lossy.spectral + lossy.smooth
    return {name: form for (name, *_), form in zip(FORMS, forms, strict=True)}


def _deviations(lossy):
    simulated = simulation(lossy)
    return {name: form / simulated - 1 for name, form in _forms(lossy).items()}


def _said(lossy):
    deviations = _deviations(lossy)
    ranges = "; ".join(f"{name} {np.nanmin(of):+.0%} to {np.nanmax(of):+.0%}" for name, of in deviations.items())
    missing = int(np.isnan(simulation(lossy)).sum())
    failed = (
        f" {lossy.failed} solves failed; {missing} points without any answer are left out." if lossy.failed else ""
    )
    return f"β = {lossy.exponent:g}, over all {len(SPEEDS)} speeds and {len(FORCES)} loads: {ranges}.{failed}"


def _legend(drawing):
    forms = [
        Line2D([], [], color=colour, marker=marker, markersize=3, markerfacecolor="white", label=name)
        for name, colour, marker in FORMS
    ]
    speeds = [
        Line2D([], [], color="0.2", linestyle=line, label=f"{SPEEDS[speed]:.2g} m/s")
        for speed, line in zip(SHOWN, LINES, strict=True)
    ]
    pairs = [handle for pair in zip(forms, speeds, strict=True) for handle in pair]
    drawing.legend(handles=pairs, loc="outside lower center", ncols=3)
