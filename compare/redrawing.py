"""Figures made again, for another journal or in another style, from what is stored: nothing is solved."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import Any

from scene.reading import InvalidInput

from . import publish
from .jobs.job import Found, Job, recalled
from .manifest import Manifest, manifests
from .recalling import of_other_code
from .store import Store

# Module and class of the job of each command that leaves figures.
JOBS = {
    "run": ("cases", "Cases"),
    "study": ("studies", "Conducted"),
    "paper": ("paper", "Paper"),
    "workprecision": ("costs", "Costs"),
    "mastercurve": ("tables", "Mastercurve"),
    "topography": ("tables", "Map"),
}
FIGURES = "figures"


@dataclass(frozen=True, repr=False)
class Redrawn:
    """What was made again.

    folder : of the figures; names : of the figures, with the folders below it
    aged : whether something of it was solved by other code, or with other versions, than these
    """

    folder: Path
    names: tuple[str, ...]
    aged: bool = False

    def __str__(self) -> str:
        return "\n".join([*(f"  {name}" for name in self.names), self.summary])

    __repr__ = __str__

    @property
    def summary(self) -> str:
        """How many, where, and whether of other code."""
        aged = "Some of it was solved by other code, or with other versions, than these.\n" if self.aged else ""
        return f"{aged}\n{len(self.names)} figures: {self.folder.resolve()}"


def redraw(
    folder: str | Path,
    journal: str = "default",
    style: str | PathLike | Mapping[str, Any] | None = None,
    output: str | Path | None = None,
    told: Callable[[str], Any] = lambda line: None,
) -> Redrawn:
    """Make every figure of what a command left in a folder again, without solving.

    journal : a name of compare.figures.journals.JOURNALS
    style : a style of matplotlib of your own on top: a file, a name, or settings
    output : where to; `figures` in the folder if absent
    told : is called with how far it is: what is read, and every figure that is drawn

    Raises InvalidInput where there is nothing to draw, no such journal or style, Refused where solves are missing.
    """
    target, aged = Path(output or Path(folder) / FIGURES), False
    names: list[str] = []
    with ExitStack() as looks:
        try:
            looks.enter_context(publish.look(journal, style))
        except ValueError as error:
            raise InvalidInput(str(error)) from error
        for each in manifests(folder):
            stored = sum(1 for _ in each.solved.glob("*.nc"))
            told(f"Reading what {each.folder} is made of: {stored} stored results")
            found = recall(each)
            aged |= bool(of_other_code(list(found.swept.outcomes), Store(each.solved)))
            place = found.job.place if each.folder != Path(folder) else ""
            for name in _drawn(target / place, found, place):
                told(f"  {name}")
                names.append(name)
    if not names:
        raise InvalidInput(f"{folder}: what is left here has no figures")
    return Redrawn(target, tuple(names), aged)


def recall(manifest: Manifest) -> Found:
    """What a command found, judged again from what it stored. Raises InvalidInput, Refused."""
    return recalled(job_of(manifest), manifest.solved)


def job_of(manifest: Manifest) -> Job:
    """The job of the command that wrote a manifest. Raises InvalidInput of one without figures."""
    try:
        module, name = JOBS[manifest.command]
    except LookupError as error:
        raise InvalidInput(f"{manifest.folder}: crosscheck {manifest.command} leaves no figures") from error
    try:
        return getattr(import_module(f".jobs.{module}", __package__), name).of(manifest.arguments)
    except (LookupError, ValueError) as error:
        raise InvalidInput(
            f"{manifest.folder}: written by another version, which asked otherwise; run the command again"
        ) from error


def _drawn(folder, found, place) -> Iterator[str]:
    """Every figure of a job with its tables; the names."""
    for panel in found.job.panels(found.judged):
        below = folder / panel.folder
        below.mkdir(parents=True, exist_ok=True)
        if drawn := publish.draw(below, panel.module, panel.data, panel.suffix):
            yield "/".join(part for part in (place, panel.folder, drawn.name) if part)
