"""Errors of the law of friction and of its rivals on random scenes: the tables of results/law.md.

python docs/measure/law.py   holds them against results/law/scenes-*.csv
"""

from collections.abc import Callable, Iterator

import numpy as np
import pandas
from pandas import DataFrame
from scenes import PAGE, SETS, RandomScene, scenes
from tables import of_count, replaced, stored, table

from compare import FrictionLaw, Persson
from compare.models.law.parts import FITTED
from compare.trustmap.model import NORMAL
from scene.scales import elastic_contact

STEEP = "body", "v τ q_s", "law / 3D, least load", "greatest load", "exponent, law", "exponent, 3D"
LAW = PAGE.parents[1] / "law.md"
SMALL = 0.1  # rms height over depth, up to which roughness is small
ROWS: dict[str, Callable[[DataFrame], pandas.Series]] = {
    "h₀ ≤ 0.1 d": lambda d: d["height"] <= SMALL,
    "h₀ > 0.1 d": lambda d: d["height"] > SMALL,
    "x < 0.1": lambda d: d["x"] < 0.1,
    **{
        words: lambda d, column=column, kinds=kinds: d[column].isin(kinds)
        for column, kinds, words in (
            ("region", ["spheres on a fast Kelvin solid"], "spheres on a fast Kelvin solid, v τ/λ_s 15 to 300"),
            ("region", ["blunt bodies"], "blunt bodies, n > 6, p/p_rms 0.9 to 4"),
            ("body", ["Sphere"], "spheres"),
            ("body", ["Cone"], "cones"),
            ("body", ["PowerLaw"], "other powers"),
            ("solid", ["Kelvin"], "Kelvin"),
            ("solid", ["StandardLinearSolid"], "standard solids"),
            ("solid", ["Prony"], "Prony"),
            ("solid", ["Fractional"], "fractional"),
            ("pressed by", ["load"], "load prescribed"),
            ("pressed by", ["depth"], "depth prescribed"),
        )
    },
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
        told = f"{100 * held / len(own):.0f} % ({100 * low:.0f} to {100 * high:.0f})"
        yield region, str(len(own)), *(_cell(own[name]) for name in MODELS), _half(own["half"]), told
    outside = found[found["outside"] == 1]
    yield "off the map", str(len(outside)), *(_cell(outside[name]) for name in MODELS), "", ""


def _half(halves):
    return f"{100 * np.expm1(halves.median()):.2g} %"


def _cell(logs):
    off = 100 * np.abs(np.expm1(logs.dropna()))
    return f"{off.median():.2g} / {off.quantile(0.9):.2g} % ({len(off)})" if len(off) else ""


def steep() -> Iterator[tuple[str, ...]]:
    """Law over 3D under both loads at each speed, and the exponent of the load of each."""
    found = pandas.read_csv(PAGE.with_name("steep.csv"))
    for (body, speed), own in found.groupby(["body", "speed"], sort=False):
        ratios = own["law"] / own["friction"]
        span = np.log(own["load"].iloc[-1] / own["load"].iloc[0])
        powers = (np.log(own[name].iloc[-1] / own[name].iloc[0]) / span for name in ("law", "friction"))
        yield (
            body,
            f"{speed:g}",
            *(f"{each:.3f}" for each in ratios),
            *(f"{each:.3f}".replace("-", "−") for each in powers),
        )


def shares() -> Iterator[tuple[str, ...]]:
    """Misfits of planes held out."""
    for row in pandas.read_csv(PAGE.with_name("share.csv")).to_dict("records"):
        off = (f"{100 * row[name]:.2g} %" for name in ("median", "nine in ten", "error"))
        yield f"{row['from']:g} to {row['to']:g}", str(int(row["planes"])), *off


def coefficients() -> Iterator[tuple[str, ...]]:
    """Coefficients of S."""
    of = {"level": "A", "bend": "B", "power": "C"}
    for row in pandas.read_csv(FITTED).to_dict("records"):
        value, low, high = (f"{row[name]:.3g}".replace("-", "−") for name in ("value", "low", "high"))
        times = "1" if row["times"] == "one" else row["times"].replace("*", " × ")
        yield of[row["to"]], times, value, f"{low} to {high}"


def answer() -> str:
    """The law and its errors on fresh scenes, in two sentences."""
    found = pandas.read_csv(PAGE.with_name("errors.csv"))
    claimed = 100 * np.abs(np.expm1(found[found["outside"] == 0]["law"]))
    return (
        "[Another law](docs/results/law.md) holds there: μ = μ_smooth + (F_full / p) S(p / p_rms), friction of "
        "the smooth body and that of all waves in full contact, of which partial contact leaves the share S. "
        f"Corrected by the trust map it is within {claimed.median():.1f} % of 3D in half of {len(claimed)} unseen "
        f"contacts, {claimed.quantile(0.9):.1f} % in nine of ten."
    )


def main() -> None:
    """Write the errors, and the tables of the page."""
    found = errors()
    stored(PAGE.with_name("errors.csv"), found)
    told = table("|scenes|" + "|".join(MODELS.values()) + "|± (95 %)|held", rows(found))
    print(told)
    replaced(LAW, "errors", told)
    if PAGE.with_name("steep.csv").exists():
        replaced(LAW, "steep", table("|".join(STEEP), steep()))
    replaced(LAW, "share", table("x|planes|median|nine in ten|standard error", shares()))
    replaced(LAW, "coefficients", table("of|times|value|interval", coefficients()))


if __name__ == "__main__":
    main()
