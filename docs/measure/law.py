"""Errors of the law of friction and of its rivals on random scenes: the table of results/law.md.

python docs/measure/law.py   compares them with results/law/scenes-*.csv
"""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import numpy as np
import pandas
from pandas import DataFrame
from scenes import PAGE, SETS, RandomScene, scenes
from tables import fill, of_count, stored, table

from compare import FrictionLaw, Persson
from compare.trustmap.model import NORMAL
from scene.scales import elastic_contact

LAW = PAGE.parents[1] / "law.md"
SMALL = 0.1  # rms height over depth, up to which roughness is small
FAR = {
    "spheres on a fast Kelvin solid": "spheres on a fast Kelvin solid, v τ/λ_s 15 to 300",
    "blunt bodies": "blunt bodies, n > 6, p/p_rms 0.9 to 4",
}
ROWS: dict[str, Callable[[DataFrame], pandas.Series]] = {
    "h₀ ≤ 0.1 d": lambda d: d["height"] <= SMALL,
    "h₀ > 0.1 d": lambda d: d["height"] > SMALL,
    "x < 0.1": lambda d: d["x"] < 0.1,
    **{words: lambda d, region=region: d["region"] == region for region, words in FAR.items()},
    "all": lambda d: d["height"] > 0,
}
MODELS = {"bare": "bare law", "law": "3D law", "persson": "Persson", "line": "MDR"}


def errors() -> DataFrame:
    """ln(model / 3D) of each scene, where it lies, and whether the interval of the law holds it."""
    rows = []
    for name in SETS:
        known = pandas.read_csv(PAGE.with_name(f"scenes-{name}.csv")).set_index("scene")
        known = known[np.isfinite(known["friction"]) & (known["friction"] > 0)]
        rows += [_errors(each, known.loc[each.number]) for each in scenes(name) if each.number in known.index]
    return DataFrame(rows)


def _errors(each: RandomScene, known) -> dict:
    scene, rest = each.scene, elastic_contact(each.scene)
    found = FrictionLaw().solve(scene)
    low, high = (np.log(found.measures[f"friction_{end}"]) for end in ("low", "high"))
    middle, true = np.log(found.friction_coefficient), np.log(known["friction"])
    # The truth has an error of its own, by which the interval is widened.
    spread = NORMAL * known["error"]
    loaded = scene if scene.motion.load is not None else None
    answers = {
        "bare": found.measures["bare_friction"],
        "law": found.friction_coefficient,
        "persson": Persson().solve(loaded).friction_coefficient if loaded else np.nan,
        "line": known["line"],
    }
    return {
        "set": each.set,
        "scene": each.number,
        "region": each.region,
        "height": scene.roughness.rms_height / rest.depth,
        "waves": rest.radius / scene.roughness.shortest,
        "body": type(scene.indenter).__name__,
        "solid": type(scene.elastomer).__name__,
        "pressed by": scene.motion.pressed_by,
        "x": found.measures["pressure_ratio"],
        "outside": found.measures["outside"],
        "half": (high - low) / 2,
        "held": float(middle - np.hypot(middle - low, spread) <= true <= middle + np.hypot(high - middle, spread)),
        "error": known["error"],
        **{name: float(np.log(value) - true) if value > 0 else np.nan for name, value in answers.items()},
    }


def rows(found: DataFrame) -> Iterator[tuple[str, ...]]:
    """Number of scenes, error of each model in the median and at nine in ten, and coverage, by region."""
    inside = found[found["outside"] == 0]
    for region, chosen in ROWS.items():
        own = inside[chosen(inside)]
        held = int(own["held"].sum())
        low, high = of_count(held, len(own))
        share = f"{100 * held / len(own):.0f} % ({100 * low:.0f} to {100 * high:.0f})"
        yield region, str(len(own)), *(_cell(own[name]) for name in MODELS), _half(own["half"]), share
    outside = found[found["outside"] == 1]
    yield "off the map", str(len(outside)), *(_cell(outside[name]) for name in MODELS), "", ""


def _half(halves):
    return f"{100 * np.expm1(halves.median()):.2g} %"


def _cell(logs):
    off = 100 * np.abs(np.expm1(logs.dropna()))
    shown = (f"{float(f'{each:.2g}'):g}" for each in off.quantile([0.5, 0.9]))
    return f"{' / '.join(shown)} % ({len(off)})" if len(off) else ""


def errors_of(model: str) -> tuple[float, float, int]:
    """Errors of a model that half and nine in ten of the unseen scenes stay below [%], and number of scenes."""
    found = pandas.read_csv(PAGE.with_name("errors.csv"))
    off = 100 * np.abs(np.expm1(found[found["outside"] == 0][model]))
    return off.median(), off.quantile(0.9), len(off)


def parts() -> Mapping[tuple[Path, str], str]:
    """Text between two comments, by the page and the name of the comment, from what is stored."""
    found = pandas.read_csv(PAGE.with_name("errors.csv"))
    return {(LAW, "errors"): table("|scenes|" + "|".join(MODELS.values()) + "|± (95 %)|held", rows(found))}


def main() -> None:
    """Write the errors, and the table of the page."""
    stored(PAGE.with_name("errors.csv"), errors())
    fill(parts())


if __name__ == "__main__":
    main()
