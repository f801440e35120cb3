"""The report of judged cases: figures, tables, a manifest and one page that holds everything."""

import base64
import csv
import io
import json
import os
import platform
import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version
from importlib.resources import files
from math import degrees
from pathlib import Path

import jinja2
import numpy as np
from matplotlib.ticker import EngFormatter

from scene import Indent, Slide

from .figures import collapse, contact, force_depth, friction_load, friction_speed, smooth_limit, style
from .store import finite, write
from .sweep import Swept
from .verdict import Judgement

FIGURES = (contact, force_depth, friction_speed, friction_load, collapse, smooth_limit)
PACKAGES = ("mdr-bem-crosscheck", "numpy", "scipy", "ducc0", "pyfftw", "numba", "matplotlib", "pydantic")
# Units of the fields of a scene, with prefixes and without; a power law's coefficient has one of its own.
PREFIXED = (
    dict.fromkeys(("radius", "depth", "rms_height", "longest", "shortest", "rolloff"), "m")
    | dict.fromkeys(("modulus", "rubbery_modulus", "glassy_modulus", "equilibrium_modulus", "moduli"), "Pa")
    | dict.fromkeys(("relaxation_time", "relaxation_times", "retardation_times"), "s")
    | {"load": "N"}
)
PLAIN = (
    dict.fromkeys(("instantaneous_compliance", "compliances"), "1/Pa")
    | dict.fromkeys(("lowest_frequency", "highest_frequency"), "rad/s")
    | {"speed": "m/s"}
)
WORDS = {
    "hurst": "Hurst exponent",
    "longest": "longest wave",
    "rolloff": "roll-off",
    "shortest": "shortest wave",
    "poisson_ratio": "Poisson ratio",
}
DOTS_PER_INCH = 220
PAGE, MANIFEST = "report.html", "manifest.json"


@dataclass(frozen=True)
class Drawn:
    """One figure on the page: name, caption, its PNG as base64, and its width [inch]."""

    name: str
    caption: str
    image: str
    inches: float


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
        drawn = tuple(figure for module in FIGURES if (figure := _draw(below, module, judgement)))
        _write_csv(below / "points.csv", [record.columns for record in judgement.table])
        _write_csv(below / "numbers.csv", [asdict(number) for number in (*judgement.numbers, *judgement.checks)])
        sections.append(Section(name, judgement, drawn))
    _write_text(folder / MANIFEST, json.dumps(_storable(manifest(sections, swept)), indent=1, allow_nan=False))
    _write_text(folder / PAGE, page(sections, swept))
    return folder / PAGE


def page(sections: Sequence[Section], swept: Swept) -> str:
    """The page as HTML that needs nothing else: images are inside, nothing is linked."""
    text = (files("compare") / "report.html").read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    template = environment.from_string(text)
    about = {"versions": versions(), "platform": _platform(), "described": described}
    return template.render(sections=sections, swept=swept, **about)


def described(part: object) -> str:
    """A part of a scene in words with units: Sphere, radius 10 mm; what is absent is not named."""
    kind = part.type.replace("-", " ").capitalize()
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
        "platform": _platform(),
        "tasks": {"solved": swept.solved, "reused": swept.reused},
        "wall_seconds": swept.seconds,
        "cases": [_account(section) for section in sections],
    }


def versions() -> dict[str, str]:
    """Of Python and of the packages that numbers depend on."""
    return {"python": platform.python_version()} | {package: version(package) for package in PACKAGES}


def slug(name: str) -> str:
    """A name as it may stand in a path."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    return re.sub(r"[^a-z0-9]+", "-", plain.lower()).strip("-") or "case"


def _draw(folder, module, judgement):
    """Figure as PDF and PNG, its tables as CSV; None if there is nothing to show."""
    with style.applied():
        drawing = module.figure(judgement)
        if drawing is None:
            return None
        image = io.BytesIO()
        drawing.savefig(image, format="png", dpi=DOTS_PER_INCH)
        # Both files in one layout, which takes as long to find as to draw.
        drawing.set_layout_engine("none")
        write(folder / f"{module.NAME}.png", lambda file: file.write(image.getvalue()))
        # Without the date the same numbers give the same file.
        write(
            folder / f"{module.NAME}.pdf",
            lambda f: drawing.savefig(f, format="pdf", metadata={"CreationDate": None}),
        )
    for name, content in module.sheets(judgement).items():
        _write_csv(folder / f"{name}.csv", content)
    return Drawn(
        module.NAME, module.caption(judgement), base64.b64encode(image.getvalue()).decode(), drawing.get_figwidth()
    )


def _write_csv(path, content):
    """Rows as dictionaries, or columns of equal length; every digit is written."""
    if isinstance(content, Mapping):
        names, rows = list(content), zip(*(np.asarray(c).tolist() for c in content.values()), strict=True)
    else:
        names = list(content[0]) if content else []
        rows = ([_number(row[name]) for name in names] for row in content)
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    writer.writerows(rows)
    _write_text(path, text.getvalue())


def _number(value):
    return value.item() if isinstance(value, np.generic) else value


def _write_text(path, text):
    write(path, lambda file: file.write(text.encode()))


def _platform():
    return {"system": platform.system(), "machine": platform.machine(), "processors": os.cpu_count()}


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


def _storable(value):
    """JSON knows no NaN: null stands for it."""
    if isinstance(value, Mapping):
        return {name: _storable(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_storable(entry) for entry in value]
    return finite(_number(value))
