"""The contact of a rough cone and a rough sphere in one dimension, whole and close up (paper, Fig. 1)."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator
from pandas import DataFrame

from ....figures import style, touching
from ....figures.lettering import lettered
from ....report.page import Plot, Tables

NAME = "paper-contacts"
# Half the width of the whole picture in radii of the smooth contact, and the width of the close-up [m].
SHOWN, CLOSE = 1.9, 2e-4
# Height of a panel over its width, and over that of what touches; how many times heights may be exaggerated.
TALL, ROOM = 0.5, 1.3
EXAGGERATIONS = np.outer(10.0 ** np.arange(-3, 4), (1, 2, 3, 4, 5, 6, 8)).ravel()
# Lengths of a scale [m], and the part of the panel that either leg takes at most.
SCALES, LEG = np.outer(10.0 ** np.arange(-9, 0), (1, 2, 5)).ravel(), 0.22


def plot(contacts: DataFrame, lines: Mapping[str, DataFrame]) -> Plot | None:
    """The plot of some contacts; None without any.

    contacts : a row for each shape; lines : x, indenter, surface, contact at the nodes, by the name of the shape
    """
    if contacts.empty:
        return None
    return Plot(
        NAME,
        figure,
        {NAME: contacts, **{f"{NAME}-{shape}": line for shape, line in lines.items()}},
        "Rigid rough profile and surface of the elastomer in steady sliding, heights from the undeformed "
        "surface (dashed). The indenter slides to the left; real contact is bold. Both legs of a scale have "
        f"the length beside them. Below, {CLOSE * 1e3:g} mm (boxed above) in which the elastomer leaves the "
        "indenter most often: behind each asperity it is free and returns exponentially.",
        " ".join(
            f"Rough {row.shape}: friction coefficient {row.friction_coefficient:.3g}, real contact "
            f"{row.contact_length * 1e3:.3g} mm; breaks {row.conditions_broken or 'no condition'}."
            for row in contacts.itertuples()
        ),
    )


def figure(tables: Tables) -> Figure:
    """A column for each shape. Above: the contact. Below: where it ends most often."""
    contacts = tables[NAME]
    drawing = style.canvas("double", 4.4)
    panels = drawing.subplots(2, len(contacts), squeeze=False)
    for (above, below), row in zip(panels.T, contacts.itertuples(), strict=False):
        line = tables[f"{NAME}-{row.shape}"]
        whole = SHOWN * row.smooth_half_width * np.array([-1, 1])
        _panel(above, line, whole, 0.8, f"rough {row.shape}")
        _panel(below, line, _close_up(line["x"].to_numpy(), line["contact"].to_numpy()), 1.3, "close-up")
        above.axhline(0, **style.line(0.3, 0.65, linestyle=(0, (5, 3)), zorder=1))
        (left, right), (bottom, top) = below.get_xlim(), below.get_ylim()
        box = Rectangle(
            (left, bottom), right - left, top - bottom, fill=False, linewidth=style.width(0.8), zorder=5
        )
        above.add_patch(box)
        above.text(0.5, 0.9, "rigid indenter", transform=above.transAxes, ha="center", fontsize=style.small())
        above.text(0.03, 0.05, touching.flow(1.0), transform=above.transAxes, fontsize=style.small())
    lettered(panels.flat)
    style.legend(drawing, panels[0, 0].get_legend_handles_labels()[0], "outside lower center", 3)
    return drawing


def _close_up(x, contact):
    """Ends [m] of the stretch with the most ends of contact."""
    nodes = max(2, round(CLOSE / (x[1] - x[0])))
    ends = np.convolve(np.abs(np.diff(contact.astype(int))), np.ones(nodes), "valid")
    first = int(np.argmax(ends))
    return np.array([x[first], x[first] + CLOSE])


def _panel(axes: Axes, line, limits, width, title) -> None:
    """Both bodies around what touches, with heights exaggerated a round number of times."""
    x, body, surface = (line[name].to_numpy() for name in ("x", "indenter", "surface"))
    contact, seen = line["contact"].to_numpy() == 1, (limits[0] <= x) & (x <= limits[1])
    low, high = min(surface[seen].min(), body[seen].min()), max(surface[seen].max(), body[seen & contact].max())
    span = np.ptp(limits)
    times = max(times for times in EXAGGERATIONS if times * ROOM * (high - low) <= TALL * span)
    height = TALL * span / times
    bottom = low - (height - (high - low)) / 3
    axes.set(xlim=limits * 1e3, ylim=(bottom * 1e6, (bottom + height) * 1e6), aspect=times * 1e-3)
    axes.set(xlabel="x [mm]", ylabel="height [µm]", title=title)
    axes.set_title(f"heights × {times:g}", loc="right", fontsize=style.small(), fontweight="normal")
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.plot(x * 1e3, body * 1e6, color=style.ink(), linewidth=style.width(0.45), label="rigid profile")
    # A marker, too, since contact may be at one node.
    bold = {"linewidth": style.width(width), "markersize": style.width(width), "solid_capstyle": "round"}
    bold |= {"marker": "o", "markeredgewidth": 0}
    drawn = touching.bodies(axes, x * 1e3, body * 1e6, surface * 1e6, contact, axes.get_ylim(), **bold)
    for artist, label in zip(drawn, ("surface of the elastomer", "real contact"), strict=True):
        artist.set_label(label)
    _scale(axes)


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
