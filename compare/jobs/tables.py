"""What a user measured: friction shifted onto one curve, and maps of heights described. Nothing is solved."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from scene import Topography, markup
from scene.reading import InvalidInput, mistakes

from ..figures import shifted_curves, topography
from ..paper.measured import read_measured
from ..paper.shifts import Shifted
from ..publish import draw
from ..report import slug
from ..runner import SweepResult
from ..statistics.spectra import Description, describe, described
from ..wording import explain, explain_vertical, plus_minus
from .job import Panel, Round

NOTHING: Sequence[Round] = ()


@dataclass(frozen=True)
class Mastercurve:
    """A job, see `job.Job`. path : of a table of friction, load and speed"""

    path: Path

    command, doing, place, folders, files, rounds = "mastercurve", "shifting", "", (), (), NOTHING

    @classmethod
    def of(cls, arguments: Mapping) -> "Mastercurve":
        """The job of these arguments again."""
        return cls(Path(arguments["table"]))

    @property
    def arguments(self) -> dict:
        """The file."""
        return {"table": str(self.path)}

    def judged(self, swept: SweepResult) -> Shifted:
        """The curves and what shifts make of them. Raises InvalidInput."""
        return read_measured(self.path)

    def write(self, folder: Path, judged: Shifted, swept: SweepResult) -> None:
        """The figure and its tables."""
        _draw(folder, self.panels(judged))

    def panels(self, judged: Shifted) -> Iterator[Panel]:
        """One."""
        yield Panel("", shifted_curves, [judged], f"-{slug(self.path.stem)}")

    def lines(self, judged: Shifted) -> Iterator[str]:
        """Verdict, misfit, exponent."""
        rows = self._rows(judged)
        yield f"{rows[0][0]}: {rows[0][1]}"
        for name, text in rows[1:]:
            yield f"  {name}{' ' if name else ''}{text}"

    def tables(self, judged: Shifted) -> Iterator[str]:
        """The same."""
        yield markup.table(self._rows(judged), title=judged.title)

    def _rows(self, judged):
        collapse, vertical = judged.collapse, judged.vertical
        power = plus_minus(judged.exponent, judged.exponent_error)
        if collapse.verdict == "fails":
            power = "none, as these shifts do not bring the curves onto one"
        rows = [
            ("horizontal shifts onto one curve", collapse.verdict),
            ("", explain(collapse)),
            ("misfit", f"{collapse.after.rms:.2%}, without shifts {collapse.before.rms:.2%}"),
            ("shift ~ v^p,", f"p = {power}"),
            ("", explain_vertical(vertical)),
        ]
        if vertical:
            rows.append(("vertical shifts alone", f"leave a misfit of {vertical.alone.rms:.2%}"))
        return rows


@dataclass(frozen=True)
class Map:
    """A job, see `job.Job`. path : of heights; stated : the other fields of a scene's `Topography`"""

    path: Path
    stated: Mapping[str, Any]

    command, doing, place, folders, files, rounds = "topography", "describing", "", (), (), NOTHING

    @classmethod
    def of(cls, arguments: Mapping) -> "Map":
        """The job of these arguments again."""
        return cls(Path(arguments["file"]), arguments["stated"])

    @property
    def arguments(self) -> dict:
        """The file and what was stated of it."""
        return {"file": str(self.path), "stated": dict(self.stated)}

    def judged(self, swept: SweepResult) -> Description:
        """Its sizes, slopes and spectra. Raises InvalidInput."""
        content, adapter = {"file": str(self.path), **self.stated}, TypeAdapter(Topography)
        try:
            return describe(adapter.validate_python(content))
        except ValidationError as error:
            raise InvalidInput("\n".join(mistakes(error, content, adapter))) from error
        except ValueError as error:
            raise InvalidInput(f"{self.path}: {error}") from error

    def write(self, folder: Path, judged: Description, swept: SweepResult) -> None:
        """The figure of its spectra and its tables."""
        _draw(folder, self.panels(judged))

    def panels(self, judged: Description) -> Iterator[Panel]:
        """One."""
        yield Panel("", topography, judged, f"-{slug(self.path.stem)}")

    def lines(self, judged: Description) -> Iterator[str]:
        """A sentence each."""
        yield from described(judged)

    def tables(self, judged: Description) -> Iterator[str]:
        """The same."""
        rows = (line.partition(": ")[::2] for line in described(judged))
        yield markup.table(rows, title=str(self.path.name))


def _draw(folder, panels):
    for panel in panels:
        draw(folder / panel.folder, panel.module, panel.data, panel.suffix)
