"""The contact of a rough cone and a rough sphere in one dimension, whole and close up (paper, Fig. 1)."""

from collections.abc import Mapping
from dataclasses import fields

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from scene import Cone, Regime
from scene.regime import SMALL_SLOPE

from ..paper.contacts import Configuration
from ..plots import materials, style

NAME = "paper-contacts"
# Half the width of the whole picture in radii of the smooth contact, and the width of the close-up [m].
SHOWN, CLOSE = 1.9, 2e-4
# Height of a panel over its width, and over that of what touches; how many times heights may be exaggerated.
TALL, ROOM = 0.5, 1.3
EXAGGERATIONS = np.outer(10.0 ** np.arange(-3, 4), (1, 2, 3, 4, 5, 6, 8)).ravel()
# Lengths of a scale [m], and the part of the panel that either leg takes at most.
SCALES, LEG = np.outer(10.0 ** np.arange(-9, 0), (1, 2, 5)).ravel(), 0.22


def figure(contacts: Mapping[str, Configuration]) -> Figure | None:
    """A column for each shape. Above: the contact. Below: where it ends most often. None without any."""
    solved = _solved(contacts)
    if not solved:
        return None
    drawing = style.canvas("double", 4.4)
    panels = drawing.subplots(2, len(solved), squeeze=False)
    for (above, below), letter, (shape, at) in zip(panels.T, "ab", solved.items(), strict=False):
        heights = _heights(at)
        whole, close = SHOWN * at.relaxed.radius * np.array([-1, 1]), _close_up(at)
        for axes, limits, name, width in (
            (above, whole, f"({letter}) rough {shape}", 0.8),
            (below, close, "close-up", 1.3),
        ):
            _frame(axes, limits, *heights)
            _bodies(axes, *heights, width)
            _scale(axes)
            axes.set_title(name)
        above.axhline(0, color=style.grey(0.3), linewidth=style.width(0.65), linestyle=(0, (5, 3)), zorder=1)
        (left, right), (bottom, top) = below.get_xlim(), below.get_ylim()
        above.add_patch(
            Rectangle((left, bottom), right - left, top - bottom, fill=False, linewidth=style.width(0.8), zorder=5)
        )
        above.text(0.5, 0.9, "rigid indenter", transform=above.transAxes, ha="center", fontsize=style.small())
        above.text(0.03, 0.05, "elastomer flows →", transform=above.transAxes, fontsize=style.small())
    style.legend(drawing, panels[0, 0].get_legend_handles_labels()[0], "outside lower center", 3)
    return drawing


def sheets(contacts: Mapping[str, Configuration]) -> dict[str, dict[str, np.ndarray]]:
    """Columns of each shape: x, indenter and surface [m], heights above the undeformed surface, and contact."""
    found = {}
    for shape, at in _solved(contacts).items():
        x, body, surface, contact = _heights(at)
        found[f"{NAME}-{shape}"] = {"x": x, "indenter": body, "surface": surface, "contact": contact.astype(int)}
    return found


def caption(contacts: Mapping[str, Configuration]) -> str:
    """What the figure shows."""
    parameters = " ".join(f"Rough {shape}: {_parameters(at)}" for shape, at in contacts.items())
    steep = any(at.row.measures["rms_slope"] > SMALL_SLOPE for at in _solved(contacts).values())
    outside = (
        f" Slopes above {SMALL_SLOPE:g} lie outside what a linear theory of contact presupposes." if steep else ""
    )
    return (
        "Rigid rough profile and surface of the elastomer at its nodes in steady sliding, in one dimension. "
        "Heights are those above the undeformed surface (dashed). Both legs of a scale are of the length beside "
        "it: where the upright one is longer, heights are stretched. In the frame of the indenter the elastomer "
        f"flows to the right; real contact is in bold. Below, {CLOSE * 1e3:g} mm (boxed above) in which the "
        "elastomer leaves the indenter most often: behind each asperity it is free and returns exponentially. "
        f"{parameters}{outside}"
    )


def _solved(contacts):
    return {shape: at for shape, at in contacts.items() if at.row.reason is None}


def _parameters(at):
    scene, row = at.scene, at.row
    body, solid, motion, rough = scene.indenter, scene.elastomer, scene.motion, scene.roughness
    shape = f"θ = {np.degrees(body.angle):g}°" if isinstance(body, Cone) else f"R = {body.radius * 1e3:g} mm"
    given = (
        f"{shape}, H = {rough.hurst:g}, load {motion.load:g} N, G = {solid.modulus:g} Pa, "
        f"τ = {solid.relaxation_time:g} s, v = {motion.speed:g} m/s, rms height {rough.rms_height * 1e6:g} µm, "
        f"one profile (seed {rough.seed})"
    )
    if row.reason is not None:
        return f"{given}; it failed and is left out: {row.reason}."
    return (
        f"{given}; found: depth of the macroscopic tip {row.depth * 1e6:.3g} µm, real contact "
        f"{row.measures['contact_length'] * 1e3:.3g} mm, rms slope {row.measures['rms_slope']:.3g}, friction "
        f"coefficient {row.friction_coefficient:.3g}. Smooth and at rest the half-width is "
        f"{at.relaxed.radius * 1e3:.3g} mm and the depth {at.relaxed.depth * 1e6:.3g} µm. {_broken(row)}"
    )


def _broken(row):
    """Conditions of the laws that break."""
    regime = Regime(*(row.measures[field.name] for field in fields(Regime)))
    broken = [name for name, holds in regime.flags.items() if not holds]
    return f"Of the conditions of the laws it breaks {', '.join(broken) or 'none'}."


def _heights(at: Configuration) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """x, rigid profile and surface [m] above the undeformed surface, and where they touch."""
    fields = at.fields
    return fields["x"], fields["profile"] - at.row.depth, -fields["displacement"], fields["contact"]


def _close_up(at):
    """The stretch [m] with the most ends of contact."""
    x, contact = at.fields["x"], at.fields["contact"]
    nodes = max(2, round(CLOSE / (x[1] - x[0])))
    ends = np.convolve(np.abs(np.diff(contact.astype(int))), np.ones(nodes), "valid")
    first = int(np.argmax(ends))
    return np.array([x[first], x[first] + CLOSE])


def _frame(axes: Axes, limits, x, body, surface, contact) -> None:
    """Limits around what touches, with heights exaggerated a round number of times."""
    seen = (limits[0] <= x) & (x <= limits[1])
    low, high = min(surface[seen].min(), body[seen].min()), max(surface[seen].max(), body[seen & contact].max())
    width = np.ptp(limits)
    times = max(times for times in EXAGGERATIONS if times * ROOM * (high - low) <= TALL * width)
    height = TALL * width / times
    bottom = low - (height - (high - low)) / 3
    axes.set(xlim=limits * 1e3, ylim=(bottom * 1e6, (bottom + height) * 1e6), aspect=times * 1e-3)
    axes.set(xlabel="x [mm]", ylabel="height [µm]")
    axes.xaxis.set_major_locator(MaxNLocator(5))


def _scale(axes):
    """Two legs of one length, along and upright, in the corner below on the right."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    most = LEG * min((right - left) * 1e-3, (top - bottom) * 1e-6)
    length = SCALES[most >= SCALES].max()
    corner = right - 0.04 * (right - left), bottom + 0.07 * (top - bottom)
    x = [corner[0] - length * 1e3, corner[0], corner[0]]
    y = [corner[1], corner[1], corner[1] + length * 1e6]
    axes.plot(x, y, color=style.ink(), linewidth=style.width(), zorder=5, gid="scale", solid_capstyle="butt")
    said = f"{length * 1e6:g} µm"
    axes.text(
        x[0] - 0.012 * (right - left), corner[1], said, ha="right", va="center", fontsize=style.small(), zorder=5
    )


def _bodies(axes, x, body, surface, contact, width):
    x, body, surface = x * 1e3, body * 1e6, surface * 1e6
    bottom, top = axes.get_ylim()
    axes.fill_between(x, np.maximum(surface, bottom), bottom, color=materials.elastomer(), linewidth=0)
    axes.fill_between(x, np.minimum(body, top), top, color=materials.indenter(), linewidth=0)
    axes.plot(x, body, color=style.ink(), linewidth=style.width(0.45), label="rigid profile")
    axes.plot(x, surface, color=materials.surface(), linewidth=style.width(0.7), label="surface of the elastomer")
    # A marker, too, since contact may be at one node.
    axes.plot(
        x,
        np.where(contact, surface, np.nan),
        color=style.COLOUR["MDR"],
        linewidth=style.width(width),
        marker="o",
        markersize=style.width(width),
        markeredgewidth=0,
        label="real contact",
        solid_capstyle="round",
    )
