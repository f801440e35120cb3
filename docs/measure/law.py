"""Errors of the law of friction and of its rivals on random scenes: the tables of results/law.md.

python docs/measure/law.py [SET]   holds them against results/law/scenes-SET.csv, by default fresh
"""

import sys
from collections.abc import Callable, Iterator

import numpy as np
import pandas
from pandas import DataFrame
from scenes import PAGE, RandomScene, scenes
from tables import replaced, stored, table

from compare import FrictionLaw, Persson
from compare.models.law.share import FITTED
from scene.scales import elastic_contact

WHICH = {
    "tried": "240 scenes, by which the form of the law and its interval were chosen; S is fitted to planes.",
    "fresh": "640 new scenes, looked at once, when the law was final.",
}
STEEP = "body", "v τ q_s", "law / 3D, least load", "greatest load", "exponent, law", "exponent, 3D"
LAW = PAGE.parents[1] / "law.md"
SMALL = 0.1  # rms height over depth, up to which roughness is small
REGIONS: dict[str, Callable[[DataFrame], pandas.Series]] = {
    "h₀ ≤ 0.1 d": lambda d: d["height"] <= SMALL,
    "h₀ > 0.1 d": lambda d: d["height"] > SMALL,
    "inside": lambda d: d["outside"] == 0,
    "inside, h₀ ≤ 0.1 d": lambda d: (d["outside"] == 0) & (d["height"] <= SMALL),
    "inside, h₀ > 0.1 d": lambda d: (d["outside"] == 0) & (d["height"] > SMALL),
    **{
        f"inside, {words}": lambda d, column=column, kinds=kinds: (d["outside"] == 0) & d[column].isin(kinds)
        for column, kinds, words in (
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
    "inside, x < 0.1": lambda d: (d["outside"] == 0) & (d["x"] < 0.1),
    "outside": lambda d: d["outside"] == 1,
    "all": lambda d: d["height"] > 0,
}
MODELS = {"law": "law", "persson": "Persson", "line": "MDR"}


def errors(name: str) -> DataFrame:
    """ln(model / 3D) of each scene, where it lies, and whether its interval holds it."""
    known = pandas.read_csv(PAGE.with_name(f"scenes-{name}.csv")).set_index("scene")
    return DataFrame(
        [_errors(each, known.loc[each.number]) for each in scenes(name) if each.number in known.index]
    )


def _errors(each: RandomScene, known) -> dict:
    scene, rest = each.scene, elastic_contact(each.scene)
    found = FrictionLaw().solve(scene)
    low, high = (found.measures[f"friction_{end}"] for end in ("low", "high"))
    loaded = scene if scene.motion.load is not None else None
    spread = np.exp(1.96 * known["error"])
    answers = {
        "law": found.friction_coefficient,
        "persson": Persson().solve(loaded).friction_coefficient if loaded else np.nan,
        "line": known["line"],
    }
    return {
        "scene": each.number,
        "height": scene.roughness.rms_height / rest.depth,
        "waves": rest.radius / scene.roughness.shortest,
        "body": type(scene.indenter).__name__,
        "solid": type(scene.elastomer).__name__,
        "pressed by": scene.motion.pressed_by,
        "x": found.measures["pressure_ratio"],
        "share": found.measures["friction_of_roughness"] / found.friction_force,
        "outside": found.measures["outside"],
        "held": float(low / spread <= known["friction"] <= high * spread),
        "error": known["error"],
        **{name: float(np.log(value / known["friction"])) for name, value in answers.items()},
    }


def rows(found: DataFrame) -> Iterator[tuple[str, ...]]:
    """Number of scenes, error of each model in the median and at nine in ten, and coverage, by region."""
    for region, chosen in REGIONS.items():
        own = found[chosen(found)]
        cells = (_cell(own[name]) for name in MODELS)
        held = own["held"]
        yield region, str(len(own)), *cells, f"{100 * held.mean():.0f} %"


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
    found = pandas.read_csv(PAGE.with_name("errors-fresh.csv"))
    claimed = 100 * np.abs(np.expm1(found[REGIONS["inside"](found)]["law"]))
    return (
        "[Another law](docs/results/law.md) holds there: μ = μ_smooth + (F_full / p) S(p / p_rms), friction of "
        "the smooth body and that of all waves in full contact, of which partial contact leaves the share S. Of "
        f"the {len(claimed)} of {len(found)} unseen contacts that it claims, half are within "
        f"{claimed.median():.1f} %, nine in ten within {claimed.quantile(0.9):.1f} %."
    )


def main(name: str = "fresh") -> None:
    """Write the errors, and the tables of the page."""
    found = errors(name)
    stored(PAGE.with_name(f"errors-{name}.csv"), found)
    told = table("|scenes|" + "|".join(MODELS.values()) + "|held", rows(found))
    print(told)
    replaced(LAW, "errors", f"{WHICH[name]}\n\n{told}")
    if PAGE.with_name("steep.csv").exists():
        replaced(LAW, "steep", table("|".join(STEEP), steep()))
    replaced(LAW, "share", table("x|planes|median|nine in ten|standard error", shares()))
    replaced(LAW, "coefficients", table("of|times|value|interval", coefficients()))


if __name__ == "__main__":
    main(*sys.argv[1:])
