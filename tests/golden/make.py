"""Golden answers: numbers that a change of the inside must keep, and the one command that makes them.

python tests/golden/make.py [NAME...]   makes the parts named, or all, and prints how far each moved

A part is a table, a row for each number: claim, where, model; verdict; value, low, high; scale, the least size
that a change is compared with. The scenes stand in `scenes.json`, one a line.
"""

import json
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from math import inf, nan
from pathlib import Path

import numpy as np
import pandas

import compare
from bem3d import BEM
from compare.statistics.griderror import LEAST
from mdr1d import MDR
from scene import Refused, Scene, SolveError

HERE = Path(__file__).parent
KEY = ["claim", "where", "model"]
ENDS = ["low", "high"]
COLUMNS = [*KEY, "verdict", "value", *ENDS, "scale"]
CLOSE = 1e-9  # least change that counts, over the size of a number; another processor moves solves by up to 7e-13
STUDIES = "collapse", "solids", "hurst", "parameters", "regime", "depth"
# Surfaces and profiles of the scenes of a run, in place of an interval.
FIXED = {'interval = "5%"': "surfaces = 3\nprofiles = 12"}
# Friction below this share of the normal force is rounding, and so is a ratio minus one.
NOTHING = 1e-6
# Measures that count work or tell the residual of an iteration.
EFFORT = {"rounds", "transform_pairs", "time_steps", "heating_solves"}
EFFORT |= {f"tangential_{name}" for name in ("applications", "residual", "rounds")}
CONTACT = {"contact", "contact_length", "contact_fraction", "points_across_contact", "stiffness"}


def findings(command: Callable, **options) -> pandas.DataFrame:
    """Findings of a command in an empty folder, compared with the largest of tolerance, half-width and NOTHING."""
    with tempfile.TemporaryDirectory() as folder:
        found = command(output=folder, report=False, yes=True, **options).findings
    half = (found["high"] - found["low"]) / 2
    found["scale"] = np.fmax(found["tolerance"], half.where(np.isfinite(half)))
    found["scale"] = np.fmax(found["scale"], np.where(found["unit"] == "1", NOTHING, np.nan))
    return found[COLUMNS]


def run(**options) -> pandas.DataFrame:
    """Findings of the default scenes, on fixed surfaces."""
    with tempfile.TemporaryDirectory() as folder:
        files = [compare.new(name, Path(folder) / f"{name}.toml") for name in ("paper-sphere", "paper-cone")]
        for file in files:
            text = file.read_text(encoding="utf-8")
            for stated, instead in FIXED.items():
                assert stated in text, f"{file.name} no longer states {stated}"
                text = text.replace(stated, instead)
            file.write_text(text, encoding="utf-8")
        return findings(partial(compare.run, files), **options)


def trust(**_) -> pandas.DataFrame:
    """Advice of the trust map: the ratio, first with the interval of the mean, then of a single surface."""
    rows = []
    for name, scene, _ in scenes("cheap"):
        for quantity, found in compare.trust(scene).corrections.items():
            for of, low, high in (
                (quantity, found.low, found.high),
                (f"{quantity} of one surface", found.surface_low, found.surface_high),
            ):
                rows.append((of, name, found.model, found.advice, found.ratio, low, high, nan))
    return pandas.DataFrame(rows, columns=COLUMNS)


def solved(group: str, *models, **_) -> pandas.DataFrame:
    """Numbers and fields of scenes by models; the settings of a scene make each model."""
    rows = []
    for name, scene, settings in scenes(group):
        for model in models:
            solver = model(**settings.get(model.__name__, {}))
            try:
                numbers = dict(numbers_of(solver.solve(scene)))
                verdict = "solved"
            except (Refused, SolveError) as error:
                numbers, verdict = {"normal_force": (nan, nan)}, type(error).__name__
            rows += [
                (claim, name, solver.name, verdict, value, nan, nan, scale)
                for claim, (value, scale) in numbers.items()
            ]
    return pandas.DataFrame(rows, columns=COLUMNS)


def numbers_of(result) -> Iterator[tuple[str, tuple[float, float]]]:
    """Numbers of a result by name, each with its scale: forces, depth, measures, and one number of each field.

    The number of a field is its mean under a weight that grows from 1 to 2 along it; its scale, the root mean
    square. A pressure far above the pressure of the roughness says only that there is hardly any. An error far
    below LEAST is only known to be less. Whether the last pixel still touches without a force is left to rounding.
    """
    forces = np.append(result.fields.get("normal_force", ()), result.normal_force)
    rounding = NOTHING * float(np.nanmax(np.abs(forces)))
    numbers = {name: getattr(result, name) for name in ("normal_force", "depth", "friction_force")}
    left_out = EFFORT if result.normal_force else {*EFFORT, *CONTACT}
    for name, value in (numbers | dict(result.measures)).items():
        if name not in left_out and not (name == "pressure_ratio" and value > 1 / NOTHING):
            scale = LEAST if name == "friction_error" else rounding if "friction" in name else nan
            yield name, (value, scale)
    for name, field in result.fields.items():
        if name in left_out:
            continue
        values = np.nan_to_num(np.asarray(field, float).ravel())
        weighted = float(values @ np.linspace(1, 2, values.size)) / values.size
        scale = float(np.sqrt(np.mean(values**2)))
        yield f"field {name}", (weighted, max(scale, rounding) if name.startswith("friction_") else scale)


def scenes(group: str) -> Iterator[tuple[str, Scene, dict]]:
    """Scenes of a group of the file: name, scene, settings by model."""
    for each in json.loads((HERE / "scenes.json").read_text(encoding="utf-8"))[group]:
        yield each["name"], Scene(**each["scene"]), each.get("settings", {})


PARTS: dict[str, Callable[..., pandas.DataFrame]] = {
    "solvers": partial(solved, "solvers", MDR, BEM),
    "law": partial(solved, "cheap", compare.FrictionLaw),
    "trust": trust,
    "run": run,
    "regress": partial(findings, compare.regress),
    "paper": partial(findings, partial(compare.paper, "quick")),
    **{name: partial(findings, partial(compare.study, name, "quick")) for name in STUDIES},
}


def made(name: str, workers: int | None = None) -> pandas.DataFrame:
    """A part as it is found now."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", compare.Doubtful)
        table = PARTS[name](workers=workers)
    table = table.assign(scale=[float(f"{each:.3g}") for each in table["scale"]]).set_index(KEY)
    assert table.index.is_unique, f"{name} has two numbers at the key {table.index[table.index.duplicated()][0]}"
    return table


def stored(name: str) -> pandas.DataFrame:
    """A part as it was stored."""
    text = dict.fromkeys([*KEY, "verdict"], str)
    table = pandas.read_csv(HERE / f"{name}.csv", dtype=text)
    return table.fillna(dict.fromkeys(text, "")).set_index(KEY)


def moved(old: pandas.DataFrame, new: pandas.DataFrame, *columns: str) -> pandas.Series:
    """Largest change of each row in some columns, over the size of its number; infinite where one came or went.

    The size is the largest of value and scale, as stored and as found.
    """
    old, new = old.align(new, join="inner", axis=0)
    size = pandas.concat([old[["value", "scale"]], new[["value", "scale"]]], axis=1).abs().max(axis=1)
    before, now = old[list(columns)], new[list(columns)]
    change = (now - before).abs().div(size.replace(0.0, 1.0), axis=0)
    return change.mask(before.eq(now) | (before.isna() & now.isna()), 0.0).fillna(inf).max(axis=1)


def differences(old: pandas.DataFrame, new: pandas.DataFrame, *columns: str) -> list[str]:
    """Lines on rows that came or went, and on those that moved in some columns, the farthest first."""
    lines = [f"gone: {key}" for key in old.index.difference(new.index)]
    lines += [f"new: {key}" for key in new.index.difference(old.index)]
    changes = moved(old, new, *columns)
    for key, change in changes[changes > CLOSE].sort_values(ascending=False).items():
        numbers = (f"{name} {old.loc[key, name]:.12g}, now {new.loc[key, name]:.12g}" for name in columns)
        lines.append(f"moved by {change:.2g} of its size: {key}: {'; '.join(numbers)}")
    return lines


def verdicts(old: pandas.DataFrame, new: pandas.DataFrame) -> list[str]:
    """Lines on verdicts that changed."""
    before, now = old["verdict"].align(new["verdict"], join="inner")
    return [f"verdict: {key}: {before[key]}, now {now[key]}" for key in before.index[before != now]]


def main(*names: str) -> None:
    """Make parts, and print what is not as it was stored."""
    for name in names or PARTS:
        file, new = HERE / f"{name}.csv", made(name)
        if file.exists():
            old = stored(name)
            lines = [*verdicts(old, new), *differences(old, new, "value", *ENDS)]
            lines.append(f"{name}: the largest change is {moved(old, new, 'value', *ENDS).max():.2g}")
            print(*lines, sep="\n")
        new.to_csv(file, lineterminator="\n")
        print(f"{name}: {len(new)} numbers written", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
