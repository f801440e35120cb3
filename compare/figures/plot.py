"""Plot: a figure as a function of tables, from which it can be drawn again."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from typing import Any, TypeAlias

from matplotlib.figure import Figure
from pandas import DataFrame

Tables: TypeAlias = Mapping[str, DataFrame]


@dataclass(frozen=True)
class Plot:
    """A figure as a function of tables. The CSV files beside it are these tables.

    name : of its files, without ending, with the folder below that of the page: "sphere/friction-load"
    draw : function of the tables and the options that returns a matplotlib Figure: a module function of
        `compare.figures`, so that it can be drawn again from the files alone
    tables : by name; a table is written to a CSV file of that name beside the figure
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
