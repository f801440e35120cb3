"""Plot: a figure as a function of tables, from which it can be drawn again, and its files: PNG, PDF and SVG."""

import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from typing import Any, TypeAlias

from matplotlib import rcParams
from matplotlib.figure import Figure
from pandas import DataFrame

from . import style

Tables: TypeAlias = Mapping[str, DataFrame]


@dataclass(frozen=True)
class Plot:
    """A figure as a function of tables, which are also written as CSV files next to it.

    name : of its files, without ending, with their folder below the folder of the page: "sphere/friction-load"
    draw : function of the tables and the options that returns a matplotlib Figure: a module function of
        `compare.figures`, so that it can be drawn again from the files alone
    tables : by name; a table is written to a CSV file of that name next to the figure
    caption : what it shows, in at most 60 words
    alternative : what is to be seen, for those who cannot see it
    options : further keyword arguments of `draw` that JSON can hold
    """

    name: str
    draw: Callable[..., Figure]
    tables: Tables
    caption: str
    alternative: str = ""
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def files(self) -> Tables:
        """Tables of the plot by the names of their files, without .csv, with the folder."""
        return {str(PurePosixPath(self.name).with_name(name)): frame for name, frame in self.tables.items()}

    def figure(self) -> Figure:
        """The figure, drawn from the tables in the style that is applied."""
        return self.draw(self.tables, **self.options)


FORMS = ("png", "pdf", "svg")
# Metadata of a file, without the date: the same numbers give the same file.
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


def picture(plot: Plot, forms: Sequence[str] = FORMS[:1], look: style.Look = style.PRINT) -> Picture:
    """Draw a plot in a look, always as PNG too; vector files hold images at the resolution of the PNG."""
    files = {}
    drawing = finished(plot, look)
    with style.applied(look):
        # As wide as the journal asks, whatever the user's style sheet sets.
        whole = drawing.bbox_inches
        for form in ("png", *(form for form in forms if form != "png")):
            file = io.BytesIO()
            drawing.savefig(file, format=form, bbox_inches=whole, metadata=dict(METADATA[form]))
            files[form] = file.getvalue()
    return Picture(files, (float(whole.width), float(whole.height)))


def finished(plot: Plot, look: style.Look = style.PRINT) -> Figure:
    """The figure of a plot, laid out for its PNG: whatever saves it later cuts nothing off."""
    with style.applied(look):
        drawing = plot.figure()
        drawing.set_dpi(rcParams["savefig.dpi"])
        if (layout := drawing.get_layout_engine()) is not None:
            layout.execute(drawing)
            drawing.set_layout_engine(None)  # a placeholder would be drawn once more before a file is
    return drawing
