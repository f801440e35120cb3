"""Figures as files: PNG, PDF and SVG, the same bytes for the same tables."""

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from matplotlib import rc_context
from matplotlib.figure import Figure

from ..report.page import Plot
from . import style

FORMS = ("png", "pdf", "svg")
DOTS_PER_INCH = 300
# What is said of a file, without the date: the same numbers give the same file.
METADATA: Mapping[str, Mapping[str, None]] = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {}}


@dataclass(frozen=True)
class Picture:
    """A figure as it lies in files.

    files : content by form, "png" first
    inches : width and height
    """

    files: Mapping[str, bytes]
    inches: tuple[float, float]

    def named(self, name: str) -> dict[str, bytes]:
        """The files by name; name : without ending."""
        return {f"{name}.{form}": content for form, content in self.files.items()}


def picture(plot: Plot, forms: Sequence[str] = FORMS[:1]) -> Picture:
    """Draw a plot in the current look, with a PNG whatever the forms.

    Raises InvalidInput where the look has text too large for the figure.
    """
    with style.applied():
        return rendered(finished(plot), ("png", *(form for form in forms if form != "png")))


def finished(plot: Plot) -> Figure:
    """The figure of a plot in the current look, laid out for its PNG: whatever saves it later cuts nothing off.

    Raises InvalidInput where the look has text too large for the figure.
    """
    with style.applied(), style.fitting(plot.name):
        drawing = plot.figure()
        drawing.set_dpi(DOTS_PER_INCH)
        style.lay_out(drawing)
        return drawing


def rendered(drawing: Figure, forms: Sequence[str] = FORMS) -> Picture:
    """A figure in some forms, all in one layout; the style has to be applied.

    Vector files hold images, if any, at the resolution of the PNG.
    """
    files = {}
    drawing.set_dpi(DOTS_PER_INCH)
    style.lay_out(drawing)
    # As wide as the journal says, whatever a style of one's own says; a figure with any engine is drawn twice.
    with rc_context({"savefig.bbox": None, "figure.constrained_layout.use": False}):
        drawing.set_layout_engine(None)
        for form in forms:
            file = io.BytesIO()
            drawing.savefig(file, format=form, dpi=DOTS_PER_INCH, metadata=dict(METADATA[form]))
            files[form] = file.getvalue()
    width, height = drawing.get_size_inches()
    return Picture(files, (float(width), float(height)))
