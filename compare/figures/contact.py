"""The contact at the scene's own point: profile in one dimension, map of pressure in three (paper, Fig. 1)."""

import numpy as np
from matplotlib.figure import Figure

from scene.scales import elastic_contact

from ..verdict import Judgement
from ..plots import materials, style

NAME = "contact"


def figure(judgement: Judgement) -> Figure | None:
    """Left: rigid profile and surface of the elastomer. Right: contact pressure. None without either's fields."""
    if not {"MDR", "BEM"} <= judgement.fields.keys():
        return None
    drawing = style.canvas("double", 2.9)
    left, right = drawing.subplots(1, 2, width_ratios=(1.25, 1))
    radius = elastic_contact(judgement.case.scene).radius * 1e3
    _profile(left, judgement.fields["MDR"], radius)
    flow = "elastomer flows →" if judgement.case.slides else "elastomer"
    for axes in (left, right):
        axes.text(0.03, 0.03, flow, transform=axes.transAxes, fontsize=style.small())
    left.text(0.5, 0.9, "rigid indenter", transform=left.transAxes, fontsize=style.small(), ha="center")
    _map(drawing, right, judgement.fields["BEM"], radius)
    return drawing


def sheets(judgement: Judgement) -> dict[str, dict[str, np.ndarray]]:
    """Columns of both panels: x, profile and surface [m] above the undeformed one; x, y [m] and pressure [Pa]."""
    if not {"MDR", "BEM"} <= judgement.fields.keys():
        return {}
    line, plane = judgement.fields["MDR"], judgement.fields["BEM"]
    y, x = np.meshgrid(plane["y"], plane["x"], indexing="ij")
    touched = plane["pressure"] > 0
    return {
        "contact-1d": {
            "x": line["x"],
            "indenter": line["profile"] - _depth(line),
            "surface": -line["displacement"],
            "contact": line["contact"].astype(int),
        },
        "contact-3d": {"x": x[touched], "y": y[touched], "pressure": plane["pressure"][touched]},
    }


def caption(judgement: Judgement) -> str:
    """What the figure shows."""
    motion = judgement.case.motion
    seed = (
        ""
        if judgement.case.roughness is None
        else f" One surface, seed {judgement.case.roughness.seed}, drawn by "
    )
    seed += "each solver in its own dimension from the same spectrum." if seed else ""
    pressed = f"{motion.load:g} N" if motion.load is not None else f"{motion.greatest * 1e6:g} µm"
    moved = f", sliding at {motion.speed:g} m/s" if motion.speed else ", at rest"
    return (
        f"The contact at {pressed}{moved}. Left: rigid indenter and surface of the elastomer in one dimension, "
        "real contact in bold; heights are exaggerated. Right: contact pressure in three dimensions, seen from "
        f"above, colours cut at the 99th percentile. Dashed circle: the smooth relaxed contact.{seed}"
    )


def _depth(line):
    touching = line["contact"]
    return np.mean((line["displacement"] + line["profile"])[touching]) if touching.any() else 0.0


def _profile(axes, line, radius):
    x = line["x"] * 1e3
    body, surface = (line["profile"] - _depth(line)) * 1e6, -line["displacement"] * 1e6
    shown = np.abs(x) < 2.2 * radius
    top = 1.15 * np.abs(surface[shown]).max() * 0.6
    bottom = 1.25 * min(surface[shown].min(), body[shown].min())
    axes.fill_between(x, surface, bottom, color=materials.elastomer(), linewidth=0)
    axes.fill_between(x, body, top, color=materials.indenter(), linewidth=0)
    axes.plot(x, surface, color=materials.surface(), linewidth=style.width(0.65))
    touched = np.where(line["contact"], surface, np.nan)
    axes.plot(
        x,
        touched,
        color=style.COLOUR["MDR"],
        linewidth=style.width(2),
        label="real contact",
        solid_capstyle="butt",
    )
    axes.set(xlim=(x[shown].min(), x[shown].max()), ylim=(bottom, top), xlabel="x [mm]", ylabel="height [µm]")
    axes.legend(loc="lower right", handlelength=1.4)
    axes.set_title("1D: profile")


def _map(drawing, axes, plane, radius):
    pressure = plane["pressure"] / 1e6
    touched = np.ma.masked_less_equal(pressure, 0)
    x, y = plane["x"] * 1e3, plane["y"] * 1e3
    half = (x[1] - x[0]) / 2
    highest = np.percentile(touched.compressed(), 99) if touched.count() else 1.0
    image = axes.imshow(
        touched,
        origin="lower",
        extent=(x[0] - half, x[-1] + half, y[0] - half, y[-1] + half),
        cmap="viridis_r",
        vmin=0,
        vmax=highest,
        interpolation="nearest",
    )
    angle = np.linspace(0, 2 * np.pi, 181)
    axes.plot(
        radius * np.cos(angle), radius * np.sin(angle), "--", color=style.grey(0.3), linewidth=style.width(0.65)
    )
    side = 1.08 * max(radius, np.abs(np.broadcast_to(x, touched.shape))[~touched.mask].max(initial=0.0))
    side = max(side, 1.08 * np.abs(np.broadcast_to(y[:, None], touched.shape))[~touched.mask].max(initial=0.0))
    axes.set(xlim=(-side, side), ylim=(-1.12 * side, side), xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    bar = drawing.colorbar(image, ax=axes, extend="max", shrink=0.9)
    bar.set_label("pressure [MPa]")
    bar.outline.set_linewidth(style.width(0.45))
    axes.set_title("3D: pressure")
