"""The report of judged cases: figures, tables, a manifest and one page that holds everything."""

import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from math import degrees
from pathlib import Path

from matplotlib.ticker import EngFormatter

from scene import Indent, Slide

from .figures import collapse, contact, force_depth, friction_load, friction_speed, smooth_limit
from .publish import Drawn, draw, machine, render, versions, write_csv, write_json, write_text
from .sweep import Swept
from .verdict import Judgement

FIGURES = (contact, force_depth, friction_speed, friction_load, collapse, smooth_limit)
# Units of the fields of a scene, with prefixes and without; a power law's coefficient has one of its own.
PREFIXED = (
    dict.fromkeys(("radius", "depth", "rms_height", "longest", "shortest", "rolloff", "pixel"), "m")
    | dict.fromkeys(("modulus", "rubbery_modulus", "glassy_modulus", "equilibrium_modulus", "moduli"), "Pa")
    | dict.fromkeys(("relaxation_time", "relaxation_times", "retardation_times"), "s")
    | {"load": "N", "thickness": "m", "shortest_kept": "m"}
)
PLAIN = (
    dict.fromkeys(("instantaneous_compliance", "compliances"), "1/Pa")
    | dict.fromkeys(("lowest_frequency", "highest_frequency"), "rad/s")
    | dict.fromkeys(("temperature", "reference", "c2"), "K")
    | {"speed": "m/s", "activation_energy": "J/mol", "conductivity": "W/(m K)"}
)
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
    """One case on the page: its name, its judgement, its figures."""

    name: str
    judgement: Judgement
    figures: tuple[Drawn, ...] = ()


def write_report(folder: Path, judged: Mapping[str, Judgement], swept: Swept) -> Path:
    """Write everything below a folder, a subfolder a case, and return the path of the page.

    judged : by the name of the case, which becomes that of its subfolder
    swept : of all the cases together
    """
    sections = []
    for name, judgement in judged.items():
        below = folder / slug(name)
        below.mkdir(parents=True, exist_ok=True)
        drawn = tuple(figure for module in FIGURES if (figure := draw(below, module, judgement)))
        write_csv(below / "points.csv", [record.columns for record in judgement.table])
        write_csv(below / "numbers.csv", [asdict(number) for number in (*judgement.numbers, *judgement.checks)])
        sections.append(Section(name, judgement, drawn))
    write_json(folder / MANIFEST, manifest(sections, swept))
    write_text(folder / PAGE, page(sections, swept))
    return folder / PAGE


def page(sections: Sequence[Section], swept: Swept) -> str:
    """The page as HTML that needs nothing else."""
    return render("report.html", sections=sections, swept=swept, described=described)


def described(part: object) -> str:
    """A part of a scene in words with units: Sphere, radius 10 mm; what is absent is not named."""
    name = getattr(part, "type", type(part).__name__)
    kind = KINDS.get(name, name.replace("-", " ").capitalize())
    if isinstance(part, Indent | Slide):
        moved = f" at {_quantity('speed', part.speed)}" if isinstance(part, Slide) else ""
        held = "load" if part.depth is None else "depth"
        pressed = f"{'under' if held == 'load' else 'to'} {_quantity(held, getattr(part, held))}"
        return f"{kind}{moved} {pressed}"
    said = [
        f"{WORDS.get(name, name.replace('_', ' '))} {_quantity(name, value)}"
        for name, value in asdict(part).items()
        if value is not None and name != "type"
    ]
    return ", ".join([kind, *said])


def _quantity(name, value):
    if isinstance(value, tuple):
        return " ".join(_quantity(name, entry) for entry in value)
    if name == "heights":
        return "of {} x {} pixels".format(*value["shape"])
    if isinstance(value, dict):
        return f"of {len(next(iter(value.values())))} rows"
    if name == "angle":
        return f"{degrees(value):.4g}°"
    if name in PREFIXED:
        return EngFormatter(PREFIXED[name])(value)
    return f"{value:.6g} {PLAIN.get(name, '')}".strip() if isinstance(value, float) else str(value)


def manifest(sections: Sequence[Section], swept: Swept) -> dict:
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
