"""Heights, slopes and spectra of a map that a user measured: `crosscheck topography`."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import nan
from pathlib import Path
from typing import Any, TypeAlias

import xarray

from scene import Topography
from scene.files.reading import InvalidInput
from scene.printable import printable

from ...report.page import Block, Findings, Text
from ...solving.task import Batch, Outcome, Task
from ...solving.vocabulary import attributes
from ...solving.words import sentences
from ...statistics.finding import Claim, Finding
from ..study import Judgement, Study
from . import figure as plots
from .spectra import Description, describe

Side: TypeAlias = str | float
Surface: TypeAlias = Any  # a path, or heights as an array of any library
WAVES = "Rms of the derivatives of its waves."
EXPONENT = "Exponent H of C_2D ~ q^(-2H - 2) between roll-off and cut-off, which are found with it."


def _law(name: str) -> Callable[[Description], float]:
    """A number of the self-affine law, NaN where there is none."""
    return lambda found: getattr(found.law, name, nan)


# Name, sentence, meaning, unit, and number out of a Description.
NUMBERS: tuple[tuple[str, str, str, str, Callable[[Description], float]], ...] = (
    ("rms-height", "Rms height", "Rms of the pixels, levelled.", "m", lambda it: it.rms_height),
    ("rms-slope", "Rms slope of the full gradient, spectral", WAVES, "1", lambda it: it.rms_slope),
    ("rms-slope-x", "Rms slope along x, spectral", WAVES, "1", lambda it: it.slopes[0]),
    ("rms-slope-y", "Rms slope along y, spectral", WAVES, "1", lambda it: it.slopes[1]),
    ("hurst", "Hurst exponent", EXPONENT, "1", _law("hurst")),
    ("longest", "Longest wavelength of the self-affine band", "", "m", _law("longest")),
    ("shortest", "Shortest wavelength of the self-affine band", "", "m", _law("shortest")),
)


ANSWERED = ("topography.rms-height", "topography.rms-slope", "topography.hurst")  # claims of the answer


@dataclass(frozen=True)
class Map(Study):
    """Description of a measured map of heights.

    given : path of the heights, or the heights
    stated : the other fields of a scene's `Topography`
    """

    given: Surface
    stated: Mapping[str, Any]

    command = "topography"

    @classmethod
    def of(cls, file: Surface, pixel: Side | Sequence[Side] | None = None, **stated: Any) -> "Map":
        """The study of a file or of heights. Raises InvalidInput for what a field of `Topography` does not allow.

        pixel : side of a pixel, "1 um" or [m], or sides along x and y; what is None, is left to the file or the
            default
        """
        stated |= {"pixel": pixel}
        # An option that a command line repeats is an empty list where it is absent.
        given = {name: None if isinstance(each, list) and not each else each for name, each in stated.items()}
        study = cls(file, {name: each for name, each in given.items() if each is not None})
        study.description  # noqa: B018
        return study

    @property
    def name(self) -> str:
        """Name of the file, or of what holds the heights."""
        path = isinstance(self.given, str | Path)
        return printable(Path(self.given).name) if path else type(self.given).__name__

    @property
    def title(self) -> str:  # type: ignore[override]
        return f"Topography of {self.name}"

    @property
    def inputs(self) -> Mapping[str, Any]:
        held = self.description.topography.heights
        path = isinstance(self.given, str | Path)
        named = {"file": printable(str(self.given))} if path else {"heights": held.digest}
        plain = {name: each if isinstance(each, str | float) else str(each) for name, each in self.stated.items()}
        return named | plain

    @cached_property
    def description(self) -> Description:
        """Sizes, slopes and spectra. Raises InvalidInput."""
        path = isinstance(self.given, str | Path)
        content: dict[str, Any] = {"file" if path else "heights": self.given, **self.stated}
        try:
            return describe(Topography(**content))
        except ValueError as error:
            lines = [each.removeprefix("Topography: ") for each in str(error).splitlines()]
        named = (each if str(self.given) in each or not path else f"{self.given}: {each}" for each in lines)
        raise InvalidInput("\n".join(named))

    def batches(self) -> Sequence[Batch]:
        return ()

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Spectra of the map: on rings of wave numbers, and of its rows."""
        rings, rows = self.description.rings, self.description.rows
        spectra = {
            "/rings": ("ring", {"q": rings.q, "density_2d": rings.density, "waves": rings.waves}),
            "/rows": ("wave", {"q": rows.q, "density_1d": rows.density}),
        }
        return xarray.DataTree.from_dict(
            {
                place: xarray.Dataset({name: (dim, values, attributes(name)) for name, values in columns.items()})
                for place, (dim, columns) in spectra.items()
            }
        )

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """Height, slopes, and the self-affine law with its interval; nothing is claimed of them."""
        found, law, findings = self.description, self.description.law, []
        for name, sentence, meaning, unit, number in NUMBERS:
            claim = Claim(f"topography.{name}", sentence, meaning=meaning, unit=unit)
            values: dict[str, Any] = {"value": float(number(found)), "where": self.name, "dimension": "measured"}
            if name == "hurst":
                values |= {"regime": found.band, "reason": "; ".join(found.warnings)}
                if law is not None:
                    values |= {"scatter": (law.low, law.high), "grid": 0.0}
            findings.append(Finding(claim, **values))
        shown = [each for each in findings if each.claim.id in ANSWERED]
        answer = [*(f"Warning: {each}." for each in self.description.warnings), *sentences(shown)]
        return Judgement(findings, answer, [plots.plot(self.description), Findings(findings)], self.setting)

    @property
    def notes(self) -> tuple[str, ...]:
        return self.description.topography.notes

    @property
    def setting(self) -> Sequence[Block]:
        """Size of the map, what was done to it, and the band of the law."""
        found, map_ = self.description, self.description.topography
        (rows, columns), (x, y), (px, py) = map_.heights.shape, map_.size, map_.pixel
        lines = [
            f"size: {columns} x {rows} pixels of {px:.4g} x {py:.4g} m, {x:.4g} x {y:.4g} m",
            f'level: "{map_.level}" taken off; repeat: "{map_.repeat}"; peaks: "{map_.peaks}"',
            *([f"waves shorter than {map_.shortest_kept:.4g} m are left out"] if map_.shortest_kept else []),
            *map_.notes,
            *([f"self-affine band: {found.band}"] if found.band else []),
        ]
        return [Text("\n\n".join(lines))]
