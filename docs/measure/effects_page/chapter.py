"""What a study of an effect asks, and what its page says."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from matplotlib.figure import Figure

Rows = Sequence[Mapping[str, object]]


@dataclass(frozen=True)
class Chapter:
    """A chapter of the page on effects.

    tables : name of the comment that they stand behind on the page -> rows
    figures : name -> figure, and data : the same name -> the numbers that are drawn, as rows of a CSV
    """

    tables: Mapping[str, Rows] = field(default_factory=dict)
    figures: Mapping[str, Figure] = field(default_factory=dict)
    data: Mapping[str, Rows] = field(default_factory=dict)
