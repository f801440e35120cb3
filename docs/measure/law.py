"""Errors of the law of friction and of its rivals on random scenes: the table of results/law.md.

python docs/measure/law.py   compares them with results/law/scenes-*.csv
"""

from collections.abc import Iterator

import numpy as np
import pandas
from pandas import DataFrame
from scenes import BLUNT, FAST, SETS, RandomScene, scenes
from scenes import PAGE as SCENES
from tables import fill, of_count, stored, table

from compare import FrictionLaw, Persson
from compare.trustmap.model import NORMAL
from scene.scales import elastic_contact

PAGE = SCENES.parents[1] / "law.md"
ERRORS = SCENES.with_name("errors.csv")
# Rows of the table, by the scenes that each is about.
ROWS = {
    "h₀ ≤ 0.1 d": "outside == 0 and height <= 0.1",
    "h₀ > 0.1 d": "outside == 0 and height > 0.1",
    "x < 0.1": "outside == 0 and x < 0.1",
    f"{FAST}, v τ/λ_s 15 to 300": f"outside == 0 and region == {FAST!r}",
    f"{BLUNT}, n > 6, p/p_rms 0.9 to 4": f"outside == 0 and region == {BLUNT!r}",
    "all": "outside == 0",
    "off the map": "outside == 1",
}
MODELS = {"bare": "bare law", "law": "3D law", "persson": "Persson", "line": "MDR"}


def errors() -> DataFrame:
    """ln(model / 3D) of each scene, where it lies, and whether the interval of the law holds it."""
    rows = []
    for name in SETS:
        known = pandas.read_csv(SCENES.with_name(f"scenes-{name}.csv")).set_index("scene")
        known = known[np.isfinite(known["friction"]) & (known["friction"] > 0)]
        rows += [_errors(each, known.loc[each.number]) for each in scenes(name) if each.number in known.index]
    return DataFrame(rows)


def _errors(each: RandomScene, known) -> dict:
    scene, found = each.scene, FrictionLaw().solve(each.scene)
    low, high = (np.log(found.measures[f"friction_{end}"]) for end in ("low", "high"))
    middle, true = np.log(found.friction_coefficient), np.log(known["friction"])
    # The truth has an error of its own, by which the interval is widened.
    spread, end = NORMAL * known["error"], low if true < middle else high
    answers = {
        "bare": found.measures["bare_friction"],
        "law": found.friction_coefficient,
        "persson": Persson().solve(scene).friction_coefficient if scene.motion.load is not None else np.nan,
        "line": known["line"],
    }
    return {
        "scene": each.number,
        "region": each.region,
        "height": scene.roughness.rms_height / elastic_contact(scene).depth,
        "x": found.measures["pressure_ratio"],
        "outside": found.measures["outside"],
        "half": (high - low) / 2,
        "held": float(abs(true - middle) <= np.hypot(end - middle, spread)),
        **{name: float(np.log(value) - true) if value > 0 else np.nan for name, value in answers.items()},
    }


def rows(found: DataFrame) -> Iterator[tuple[str, ...]]:
    """Number of scenes, error of each model in the median and at nine in ten, and coverage, by region."""
    for region, where in ROWS.items():
        own = found.query(where)
        yield region, str(len(own)), *(_cell(own[name]) for name in MODELS), *_covered(own)


def _covered(own):
    """Half of the interval, and how many it holds; nothing where there are no intervals."""
    half, held, count = 100 * np.expm1(own["half"].median()), int(own["held"].sum()), len(own)
    low, high = of_count(held, count)
    share = f"{100 * held / count:.0f} % ({100 * low:.0f} to {100 * high:.0f})"
    return ("", "") if np.isnan(half) else (f"{half:.2g} %", share)


def _cell(logs):
    off = 100 * np.abs(np.expm1(logs.dropna()))
    shown = (f"{float(f'{each:.2g}'):g}" for each in off.quantile([0.5, 0.9]))
    return f"{' / '.join(shown)} % ({len(off)})" if len(off) else ""


def errors_of(model: str) -> tuple[float, float, int]:
    """Errors of a model that half and nine in ten of the unseen scenes stay below [%], and number of scenes."""
    found = pandas.read_csv(ERRORS)
    off = 100 * np.abs(np.expm1(found.query(ROWS["all"])[model]))
    return off.median(), off.quantile(0.9), len(off)


def parts() -> dict[str, str]:
    """Text between two comments of the page, by the name of the comment."""
    found = pandas.read_csv(ERRORS)
    return {"errors": table("|scenes|" + "|".join(MODELS.values()) + "|± (95 %)|held", rows(found))}


def main() -> None:
    """Write the errors, and the table of the page."""
    stored(ERRORS, errors())
    fill(PAGE, parts())


if __name__ == "__main__":
    main()
