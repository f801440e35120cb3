"""The report of judged cases: figures, tables, a manifest and one page that holds everything."""

import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from math import degrees
from pathlib import Path
from typing import Any

from matplotlib.ticker import EngFormatter

from scene import Indent, Slide
from scene.quantities import unit_of

from .figures import collapse, contact, contact_maps, force_depth, friction_load, friction_speed, smooth_limit
from .glossary import Definitions
from .illustration import Illustration, illustrate, sheets_of
from .publish import machine, render, versions, write_csv, write_json, write_text
from .sheets import Sheet, reading
from .sources import behind
from .sweep import SweepResult
from .verdict import Judgement, Number

FIGURES = (contact, contact_maps, force_depth, friction_speed, friction_load, collapse, smooth_limit)
# Units that take prefixes: 10 mm for 0.01 m.
PREFIXED = ("m", "Pa", "s", "N", "N/m", "Hz")
WORDS = {
    "hurst": "Hurst exponent",
    "longest": "longest wave",
    "rolloff": "roll-off",
    "shortest": "shortest wave",
    "shortest_kept": "shortest wave kept",
    "poisson_ratio": "Poisson ratio",
    "reference": "stated at",
}
KINDS = {"wlf": "WLF"}
PAGE, MANIFEST = "report.html", "manifest.json"


@dataclass(frozen=True)
class Section:
    """One case on the page: its name, its judgement, its figures, and all of its points as data."""

    name: str
    judgement: Judgement
    points: Sheet
    figures: tuple[Illustration, ...] = ()

    @property
    def slug(self) -> str:
        """Of its folder."""
        return slug(self.name)

    @property
    def anchor(self) -> str:
        """On the page."""
        return f"case-{self.slug}"

    @property
    def title(self) -> str:
        return self.judgement.case.title or self.name

    def row(self, number: Number) -> str:
        """Anchor of one of its numbers."""
        every = (*self.judgement.numbers, *self.judgement.checks)
        return f"{self.anchor}.{every.index(number) + 1}"


def write_report(folder: Path, judged: Mapping[str, Judgement], swept: SweepResult) -> Path:
    """Write everything below a folder, a subfolder a case, and return the path of the page.

    judged : by the name of the case, which becomes that of its subfolder
    swept : of all the cases together
    """
    sections = [section(folder, name, judgement) for name, judgement in judged.items()]
    write_json(folder / MANIFEST, manifest(sections, swept))
    write_text(folder / PAGE, page(sections, swept))
    return folder / PAGE


def section(folder: Path, name: str, judgement: Judgement) -> Section:
    """Write the figures and tables of one case into its subfolder."""
    below = folder / slug(name)
    below.mkdir(parents=True, exist_ok=True)
    title = judgement.case.title or name
    drawn = (illustrate(folder, below, module, judgement, of=title) for module in FIGURES)
    write_csv(below / "points.csv", [record.columns for record in judgement.table])
    write_csv(below / "numbers.csv", [asdict(number) for number in (*judgement.numbers, *judgement.checks)])
    points = Sheet.read(folder, below / "points.csv", f"Points, {title}")
    return Section(name, judgement, points, tuple(figure for figure in drawn if figure))


def page(sections: Sequence[Section], swept: SweepResult) -> str:
    """The page as HTML that needs nothing else."""
    return render(
        "report.html",
        title="One dimension against three",
        contents=[("summary", "Summary"), *((each.anchor, each.title) for each in sections)],
        sections=sections,
        summary=summary(sections),
        sheets=[sheet for each in sections for sheet in (each.points, *sheets_of(each.figures))],
        definitions=Definitions(),
        described=described,
        behind=behind,
        **reading(),
        swept=swept,
    )


def summary(sections: Sequence[Section]) -> list[tuple[str, list[Number | None]]]:
    """Each number that matters by its name, with what it is in each case; None where it was not asked."""
    names = dict.fromkeys(number.name for each in sections for number in each.judgement.numbers)
    found = [{number.name: number for number in each.judgement.numbers} for each in sections]
    return [(name, [numbers.get(name) for numbers in found]) for name in names]


def fragment(judgement: Judgement) -> str:
    """The numbers that matter as a table in HTML, to be put into another page."""
    return render(
        "fragment.html",
        title=judgement.case.title or "One dimension against three",
        numbers=judgement.numbers,
        failures=len(judgement.failures),
    )


def described(part: Any) -> str:
    """A part of a scene in words with units: Sphere, radius 10 mm; what is absent is not named."""
    name = getattr(part, "type", type(part).__name__)
    kind = KINDS.get(name, name.replace("-", " ").capitalize())
    if isinstance(part, Indent | Slide):
        moved = f" at {_quantity(part, 'speed')}" if isinstance(part, Slide) else ""
        return (
            f"{kind}{moved} {'to' if part.pressed_by == 'depth' else 'under'} {_quantity(part, part.pressed_by)}"
        )
    said = [
        f"{WORDS.get(name, name.replace('_', ' '))} {_quantity(part, name)}"
        for name, value in asdict(part).items()
        if value is not None and name != "type"
    ]
    return ", ".join([kind, *said])


def _quantity(part, name):
    value = asdict(part)[name]
    if name == "heights":
        return "of {} x {} pixels".format(*value["shape"])
    if isinstance(value, dict):
        return f"of {len(next(iter(value.values())))} rows"
    unit, several = unit_of(type(part), name), value if isinstance(value, tuple) else (value,)
    return " ".join(_written(each, unit) for each in several)


def _written(value, unit):
    """A number with its unit, and whatever else as it is."""
    if not isinstance(value, float):
        return str(value)
    if unit == "rad":
        return f"{degrees(value):.4g}°"
    return EngFormatter(unit)(value) if unit in PREFIXED else f"{value:.6g} {unit or ''}".strip()


def manifest(sections: Sequence[Section], swept: SweepResult) -> dict:
    """What was solved with what: versions, platform, tasks, and for each case its settings, seeds and timings."""
    return {
        "versions": versions(),
        "platform": machine(),
        "tasks": {"solved": swept.solved, "reused": swept.reused},
        "wall_seconds": swept.seconds,
        "cases": [_account(section) for section in sections],
    }


def slug(name: str) -> str:
    """A name as it may stand in a path."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    return re.sub(r"[^a-z0-9]+", "-", plain.lower()).strip("-") or "case"


def _account(section):
    """What a case was solved with, and what that took."""
    judgement, case = section.judgement, section.judgement.case
    return {
        "name": section.name,
        "title": case.title,
        "scene": asdict(case.scene),
        "study": asdict(case.plan()),
        "settings": {"MDR": asdict(case.mdr), "BEM": asdict(case.bem)},
        "seeds": _seeds(case),
        "processor_seconds": dict(judgement.seconds),
        "failures": [{"what": what, "reason": reason} for what, reason in judgement.failures],
        "numbers": [asdict(number) for number in judgement.numbers],
        "checks": [asdict(number) for number in judgement.checks],
    }


def _seeds(case):
    if case.roughness is None:
        return {}
    first, plan = case.roughness.seed, case.plan()
    return {"MDR": list(range(first, first + plan.profiles)), "BEM": list(range(first, first + plan.surfaces))}
