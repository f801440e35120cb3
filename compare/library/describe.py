"""Parts of a scene in words with units, and names that may stand in a path."""

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import asdict
from math import degrees
from typing import Any

from scene import Program, Shear, Slide
from scene.files.reading import InvalidInput
from scene.motion import PRESSES
from scene.plan import by
from scene.printable import brief
from scene.scene import FEW, unit_of

# Units that take prefixes: 10 mm for 0.01 m.
PREFIXED = ("m", "Pa", "s", "N", "N/m", "Hz")
WORDS = {
    "hurst": "Hurst exponent",
    "longest": "longest wave",
    "rolloff": "roll-off",
    "shortest": "shortest wave",
    "shortest_kept": "shortest wave kept",
    "longest_kept": "longest wave kept",
    "poisson_ratio": "Poisson ratio",
    "reference": "stated at",
}
KINDS = {"wlf": "WLF"}
# Folders that commands write into themselves, and devices of Windows; letters of a folder.
TAKEN = {"solved", "figures", "tables", "con", "prn", "aux", "nul"} | {
    f"{device}{number}" for device in ("com", "lpt") for number in range(10)
}
MOST_LETTERS = 200


def described(part: Any) -> str:
    """A part of a scene in words with units: Sphere, radius 10 mm; what is absent is not named."""
    name = getattr(part, "type", type(part).__name__)
    kind = KINDS.get(name, name.replace("-", " ").capitalize())
    said = [
        f"{WORDS.get(name, name.replace('_', ' '))} {_quantity(part, name)}"
        for name, value in asdict(part).items()
        if value is not None and name != "type"
    ]
    return ", ".join([kind, *said])


def conditions(motion: Any) -> str:
    """Speed, and load or depth, of a motion in words: 0.1 m/s, 1 N."""
    if isinstance(motion, Program):
        greatest = _prefixed(motion.greatest, PRESSES[motion.pressed_by].symbol)
        return f"a program of {_prefixed(motion.duration, 's')}, up to {greatest}"
    if isinstance(motion, Shear):
        drawn = "force" if motion.displacement is None else "displacement"
        return f"{_quantity(motion, motion.pressed_by)}, drawn to {_quantity(motion, drawn)}"
    names = ("speed", motion.pressed_by) if isinstance(motion, Slide) else (motion.pressed_by,)
    return ", ".join(_quantity(motion, name) for name in names)


def slug(name: str) -> str:
    """Name as it may stand in a path."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    return re.sub(r"[^a-z0-9]+", "-", plain.lower()).strip("-") or "case"


def folders(names: Iterable[str], what: str) -> dict[str, str]:
    """Folders of what has these names, by name.

    what : that has the names, for mistakes

    Raises InvalidInput of a name whose folder has another use, and of two that share one.
    """
    found: dict[str, str] = {}  # names by folder
    for name in names:
        if not (isinstance(name, str) and name.isprintable()):
            raise InvalidInput(f"{what} {brief(repr(name))}: a name is a text in printable letters")
        folder, why = slug(name), ""
        if folder in TAKEN:
            why = f"its folder, {folder}, has another use"
        elif len(folder) > MOST_LETTERS:
            why = f"its folder has more than {MOST_LETTERS} letters"
        elif folder in found:
            why = f"has the folder of {brief(found[folder])!r}, {folder}"
        if why:
            raise InvalidInput(f"{what} {brief(name)!r}: {why}: choose another name")
        found[folder] = name
    return {name: folder for folder, name in found.items()}


def _quantity(part, name):
    value = asdict(part)[name]
    if name == "heights":
        shape = value["shape"]
        return f"of {by(shape)} {'points' if len(shape) == 1 else 'pixels'}"
    if isinstance(value, dict):
        return f"of {len(next(iter(value.values())))} rows"
    unit, several = unit_of(type(part), name), value if isinstance(value, tuple) else (value,)
    if len(several) > FEW:
        return f"of {len(several)} values"
    return " ".join(_written(each, unit) for each in several)


def _written(value, unit):
    """A number with its unit, and whatever else as it is."""
    if not isinstance(value, float):
        return str(value)
    if unit == "rad":
        return f"{degrees(value):.4g}°"
    return _prefixed(value, unit) if unit in PREFIXED else f"{value:.6g} {unit or ''}".strip()


def _prefixed(value, unit):
    """A number with its unit under a prefix of SI."""
    from matplotlib.ticker import EngFormatter  # only where something is described

    return EngFormatter(unit)(value)
