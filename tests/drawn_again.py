"""Figures as anyone draws them again: from the tables of a plot as their CSV files have them."""

from io import StringIO

import pandas

from compare.figures import style


def from_files(plot):
    """The figure of a plot."""
    tables = {name: pandas.read_csv(StringIO(table.to_csv(index=False))) for name, table in plot.tables.items()}
    with style.applied():
        drawing = plot.draw(tables, **plot.options)
        drawing.draw_without_rendering()
    return drawing
