"""The contact of a rough cone and a rough sphere in one dimension, whole and close up (paper, Fig. 1)."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from pandas import DataFrame

from ....figures import style, touching
from ....figures.lettering import lettered
from ....figures.prefixes import prefixed
from ....report.page import Plot, Tables

NAME = "paper-contacts"
# Length of the whole picture over that of the contact, and width of the close-up [m].
SHOWN, CLOSE = 1.5, 2e-4


def plot(sections: Mapping[str, DataFrame]) -> Plot | None:
    """The plot of some contacts, x, indenter, surface, touching by the name of the shape; None without any."""
    if not sections:
        return None
    return Plot(
        NAME,
        figure,
        {f"{NAME}-{shape}": table for shape, table in sections.items()},
        "Rigid rough profile and surface of the elastomer in steady sliding, heights from the undeformed "
        "surface (dashed). The indenter slides to the left; real contact is bold. Below, "
        f"{CLOSE * 1e3:g} mm (marked above) in which the elastomer leaves the indenter most often: behind each "
        "asperity it is free and returns exponentially.",
        f"The {' and the '.join(sections)} touch with the tips of their roughness, fewer behind than in front.",
    )


def figure(tables: Tables) -> Figure:
    """A column for each shape. Above: the contact. Below: where it ends most often."""
    drawing = style.canvas("double", 4.4)
    panels = drawing.subplots(2, len(tables), squeeze=False)
    shown = []
    for column, (name, table) in zip(panels.T, tables.items(), strict=True):
        seen = touching.section_of(table)
        touched = seen.x[seen.touching]
        margin = (SHOWN - 1) / 2 * np.ptp(touched)
        whole, close = (touched[0] - margin, touched[-1] + margin), _close_up(seen)
        for axes, span, title in zip(column, (whole, close), (name.rpartition("-")[2], "close-up"), strict=True):
            limits = _limits(seen, span)
            touching.section(axes, seen, "MDR", span, limits)
            axes.set_title(title)
            shown.append((axes, span, limits))
        along = prefixed(whole, "m")[0]
        column[0].axvspan(along * close[0], along * close[1], **style.line(0.0, 0.4, fill=False, zorder=5))
    lettered(panels.flat)
    style.lay_out(drawing)
    for axes, span, limits in shown:
        touching.exaggeration(axes, span, limits)
    return drawing


def _limits(seen, span):
    """Heights [m] around the surface of the elastomer."""
    shown = seen.surface[(span[0] <= seen.x) & (seen.x <= span[1])]
    room = float(np.ptp(shown))
    return shown.min() - 0.35 * room, shown.max() + 0.45 * room


def _close_up(seen):
    """Ends [m] of the stretch with the most ends of contact."""
    nodes = round(CLOSE / (seen.x[1] - seen.x[0]))
    ends = np.convolve(np.abs(np.diff(seen.touching.astype(int))), np.ones(nodes), "valid")
    first = float(seen.x[np.argmax(ends)])
    return first, first + CLOSE
