"""A figure on a page: drawn, said in words for those who cannot see it, with the data that it shows."""

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from PIL import Image

from .publish import FORMS, Drawn, draw
from .sheets import Sheet, anchored


@dataclass(frozen=True)
class Illustration:
    """One figure.

    drawn : its picture and its caption
    seen : what is to be seen, in words
    sheets : the data, each as it lies beside the page
    anchor, folder : on the page, and before the names of its files
    """

    drawn: Drawn
    seen: str
    sheets: tuple[Sheet, ...]
    anchor: str
    folder: str

    @property
    def name(self) -> str:
        return self.drawn.name

    @property
    def caption(self) -> str:
        return self.drawn.caption

    @property
    def image(self) -> str:
        """The picture as base64 of a PNG of 256 colours, which weighs a third and looks the same."""
        picture = Image.open(io.BytesIO(base64.b64decode(self.drawn.image))).convert("RGB")
        file = io.BytesIO()
        picture.quantize(256, dither=Image.Dither.NONE).save(file, "PNG", optimize=True)
        return base64.b64encode(file.getvalue()).decode()

    @property
    def files(self) -> list[str]:
        """The pictures that lie beside the page, by their paths from it."""
        return [f"{self.folder}{self.name}.{form}" for form in FORMS]


def illustrate(
    root: Path, below: Path, module: ModuleType, data: Any, suffix: str = "", of: str = ""
) -> Illustration | None:
    """Draw the figure of a module into a folder, and read back its data; None if there is nothing to show.

    root, below : the folder of the page, and the one within it
    suffix : as of draw
    of : what the data belong to, after their titles
    """
    drawn = draw(below, module, data, suffix)
    if drawn is None:
        return None
    folder = "" if below == root else f"{below.relative_to(root).as_posix()}/"
    sheets = tuple(
        Sheet.read(root, below / f"{sheet}.csv", f"{titled(sheet)}{f', {of}' if of else ''}")
        for sheet in drawn.sheets
    )
    return Illustration(drawn, seen(module), sheets, anchored("figure", folder.rstrip("/"), drawn.name), folder)


def titled(name: str) -> str:
    """The name of a figure or a table as a title."""
    return name.replace("-", " ").replace("_", " ").capitalize()


def seen(module: ModuleType) -> str:
    """What the figure of a module shows and where, from its own words."""
    about = (module.__doc__ or "").split("\n\n")[0]
    layout = (module.figure.__doc__ or "").split("\n\n")[0]
    told = [sentence for sentence in _sentences(layout) if not sentence.startswith("None ")]
    return " ".join([*_sentences(about), *told])


def sheets_of(illustrations: Sequence[Illustration]) -> list[Sheet]:
    """All data behind figures, each file once."""
    return list({sheet.file: sheet for each in illustrations for sheet in each.sheets}.values())


def _sentences(text: str) -> list[str]:
    """One line a sentence, each with its stop."""
    words = " ".join(text.split())
    return [f"{sentence.rstrip('.')}." for sentence in words.split(". ") if sentence]
