"""Results as tables for others: CSV with units in the header, LaTeX for a paper."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import floor, isfinite, isinf, isnan, log10
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from scene.reading import InvalidInput

from .archive import RESULTS, SOLVED, load
from .store import write

if TYPE_CHECKING:
    import xarray

FORMS = {"csv": ".csv", "latex": ".tex"}
# Columns of a point that a paper has room for, with the points in a table for each kind of curve.
POINT = ("solver", "smooth", "speed", "load", "depth", "normal_force", "depth_reached", "friction_coefficient")
ERROR, DEVIATION = "_error", "_deviation"
# Without an exponent of ten are numbers from the one to below the other.
LEAST_PLAIN, MOST_PLAIN = 1e-3, 1e5
DIGITS = 4
# An error this small over its value is one of rounding: a prescribed load, as the solver met it.
ROUNDING = 1e-9
ESCAPED = (
    {character: f"\\{character}" for character in "&%$#_{}"}
    | {character: f"{{{character}}}" for character in "[]*"}  # behind a line's end they would be its arguments
    | {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "\n": " ", '"': "''"}
    | {
        "<": "$<$",
        ">": "$>$",
        "|": "$|$",
        "±": r"$\pm$",
        "×": r"$\times$",
        "·": r"$\cdot$",
        "−": "$-$",
        "√": r"$\surd$",
    }
    | {"≤": r"$\leq$", "≥": r"$\geq$", "∞": r"$\infty$", "°": r"$^\circ$", "→": r"$\to$", "≈": r"$\approx$"}
    | {raised: f"$^{{{plain}}}$" for raised, plain in zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-", strict=True)}
    | {"µ": r"$\mu$", "μ": r"$\mu$", "α": r"$\alpha$", "β": r"$\beta$", "γ": r"$\gamma$", "δ": r"$\delta$"}
    | {"η": r"$\eta$", "θ": r"$\theta$", "λ": r"$\lambda$", "ν": r"$\nu$", "ξ": r"$\xi$", "π": r"$\pi$"}
    | {"ρ": r"$\rho$", "σ": r"$\sigma$", "τ": r"$\tau$", "φ": r"$\varphi$", "ω": r"$\omega$", "Δ": r"$\Delta$"}
)


@dataclass(frozen=True)
class Table:
    """Columns of one length.

    name : of the file, without its ending; title : in words
    columns : values by name; units : by name, empty of what has none
    """

    name: str
    title: str
    columns: Mapping[str, Sequence[Any]]
    units: Mapping[str, str]


def export(path: str | Path, folder: str | Path, form: str) -> list[Path]:
    """Write the tables of results into a folder, which is made; returns the files.

    path : a file of results or a folder that a command left, as of archive.load
    form : "csv", every digit and a unit behind each name, or "latex", rounded, for booktabs

    Raises InvalidInput where there is no table, ValueError for another form, OSError as archive.load and for what
    cannot be written.
    """
    if form not in FORMS:
        raise ValueError(f"form = {form!r}: one of {', '.join(FORMS)}")
    path, folder = Path(path), Path(folder)
    found = _printed(path) if form == "latex" else _whole(path)
    made = {table.name: table for table in found if table.columns}
    if not made:
        raise InvalidInput(f"{path}: holds no table that {form} could show")
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for table in made.values():
        target = folder / f"{table.name}{FORMS[form]}"
        content = (_latex if form == "latex" else _csv)(table).encode()
        write(target, partial(_put, content=content))
        written.append(target)
    return written


def _put(file, content):
    file.write(content)


def latex(rows: Sequence[Mapping[str, Any]], caption: str = "", label: str = "") -> str:
    """Rows as a table of LaTeX with booktabs, in a `table`; everything in it is escaped.

    rows : header -> cell, the same headers in each: text, a number, or (value, error) for value ± error, to two
        digits of the error; NaN is a dash. Text stands on the left, numbers on the right.
    """
    names = list(rows[0]) if rows else []
    sides = "".join("l" if any(isinstance(row[name], str) for row in rows) else "r" for name in names)
    body = [" & ".join(cell(row[name]) for name in names) + r" \\" for row in rows]
    head = " & ".join(escaped(name) for name in names) + r" \\"
    lines = [r"\begin{table}", r"  \centering"]
    lines += [rf"  \caption{{{escaped(caption)}}}"] if caption else []
    lines += [rf"  \label{{{label}}}"] if label else []
    lines += [rf"  \begin{{tabular}}{{{sides}}}", r"    \toprule", f"    {head}", r"    \midrule"]
    lines += [*(f"    {line}" for line in body), r"    \bottomrule", r"  \end{tabular}", r"\end{table}"]
    return "\n".join(lines) + "\n"


def cell(value: Any) -> str:
    """One cell: see `latex`."""
    value = value.item() if isinstance(value, np.generic) else value
    match value:
        case bool():
            return "yes" if value else "no"
        case str() | None:
            return escaped(value or "")
        case int():
            return f"${value}$" if value < 0 else str(value)
        case float():
            return _number(value)
    value, error = value
    told = isfinite(value) and isfinite(error) and abs(error) > ROUNDING * abs(value)
    return _with_error(value, error) if told else _number(value)


def escaped(text: str) -> str:
    """Text that LaTeX prints as it is; letters beyond ASCII that are no symbols are left to its input encoding."""
    return "".join(ESCAPED.get(character, character) for character in text)


def _number(value):
    if isnan(value):
        return "--"
    if isinf(value):
        return r"$\infty$" if value > 0 else r"$-\infty$"
    power = _power(value)
    if power:
        return rf"${value / 10.0**power:.{DIGITS - 1}f} \times 10^{{{power}}}$"
    text = f"{value:.{DIGITS}g}"
    return f"${text}$" if value < 0 else text


def _with_error(value, error):
    power = _power(value or error)
    value, error = value / 10.0**power, error / 10.0**power
    digits = max(0, 1 - floor(log10(abs(error))))
    both = rf"{value:.{digits}f} \pm {error:.{digits}f}"
    return rf"$({both}) \times 10^{{{power}}}$" if power else f"${both}$"


def _power(value):
    """Of ten, that is written behind a number; none behind one of ordinary size."""
    return 0 if value == 0 or LEAST_PLAIN <= abs(value) < MOST_PLAIN else floor(log10(abs(value)))


def _whole(path) -> Iterator[Table]:
    """Every table there is, as it is stored."""
    for place, found in _nodes(load(path)):
        for dimension in found.sizes:
            along = {name: each for name, each in found.variables.items() if each.dims == (dimension,)}
            columns = {name: each.values.tolist() for name, each in along.items()}
            units = {name: each.attrs.get("units", "") for name, each in along.items()}
            few = "" if len(found.sizes) == 1 else f"-{dimension}"
            yield Table(_slug(place or path.stem) + few, place, columns, units)


def _printed(path) -> Iterator[Table]:
    """Those that a paper has room for; of a folder without a file of results, the tables that lie in it."""
    tree = load(path)
    for place, found in _nodes(tree):
        above, _, kind = place.rpartition("/")
        if kind == "points":
            yield from _curves(above, found)
        elif kind in ("numbers", "checks"):
            columns = {"quantity": found.number.values.tolist(), "found": found.written.values.tolist()}
            yield Table(_slug(place), _title(above, kind), columns, {})
        elif kind == "collapses":
            yield _collapses(above, tree[place])
        elif not above and kind != SOLVED and "scene" in found.dims:
            yield _rows(path, found)
    if path.is_dir() and not any(path.rglob(RESULTS)):
        yield from (_read(found, found.relative_to(path)) for found in sorted(path.rglob("*.csv")))


def _nodes(tree: xarray.Dataset | xarray.DataTree):
    """Each dataset by its place, without the slash before it."""
    if not hasattr(tree, "subtree"):
        return [("", tree)]
    return [(node.path.strip("/"), node.to_dataset(inherit=False)) for node in tree.subtree]


def _curves(above, found):
    """A table for each kind of curve, of the columns that say something."""
    for kind in dict.fromkeys(found.kind.values.tolist()):
        chosen = found.isel(point=found.kind.values == kind)
        columns = {}
        for name in POINT:
            values = chosen[name].values.tolist()
            if f"{name}{ERROR}" in chosen:
                values = list(zip(values, chosen[f"{name}{ERROR}"].values.tolist(), strict=True))
            if not all(isinstance(value, float) and isnan(value) for value in values):
                columns[name] = values
        units = {name: chosen[name].attrs.get("units", "") for name in columns}
        yield Table(_slug(f"{above}/{kind}"), _title(above, f"points of the curve {kind}"), columns, units)


def _collapses(above, node):
    names = {"misfit_before": "misfit before", "misfit": "misfit after", "scatter": "scatter"}
    columns: dict[str, list] = {name: [] for name in ("solver", *names.values(), "exponent", "verdict")}
    for solver, below in node.children.items():
        columns["solver"].append(solver)
        for name, said in names.items():
            columns[said].append(below[name].item())
        columns["exponent"].append((below["exponent"].item(), below["exponent_error"].item()))
        columns["verdict"].append(below.attrs["verdict"])
    columns = columns if node.children else {}
    return Table(_slug(f"{above}/collapses"), _title(above, "collapse by horizontal shifts"), columns, {})


def _rows(path, found):
    """Numbers of one task, less the texts that are there for the record."""
    along = {name: each for name, each in found.variables.items() if each.dims == ("scene",)}
    kept = {name: each for name, each in along.items() if name not in ("settings", "failed")}
    columns = {name: each.values.tolist() for name, each in kept.items()}
    units = {name: each.attrs.get("units", "") for name, each in kept.items()}
    return Table(_slug(path.stem), found.attrs.get("title", path.stem), columns, units)


def _read(path, place):
    """A table that a command left as CSV in a place below its folder."""
    with path.open(encoding="utf-8", newline="") as file:
        names, *rows = list(csv.reader(file)) or [[]]
    columns = {name: [_value(row[k]) for row in rows] for k, name in enumerate(names)}
    return Table(_slug(place.with_suffix("").as_posix()), path.stem.replace("-", " "), columns, {})


def _value(text):
    try:
        return int(text) if text.lstrip("-").isdecimal() else float(text)
    except ValueError:
        return text


def _csv(table):
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_head(name, table.units.get(name, "")) for name in table.columns)
    writer.writerows(zip(*table.columns.values(), strict=True))
    return text.getvalue()


def _latex(table):
    heads = {name: _head(name, table.units.get(name, "")).replace("_", " ") for name in table.columns}
    heads = {name: head.replace("^2", "²") for name, head in heads.items()}
    rows = [
        {heads[name]: value for name, value in zip(heads, values, strict=True)}
        for values in zip(*table.columns.values(), strict=True)
    ]
    return latex(rows, table.title, f"tab:{table.name}")


def _head(name, unit):
    return name if unit in ("", "1") else f"{name} [{unit}]"


def _title(above, what):
    return f"{above}: {what}" if above else what


def _slug(place):
    return "-".join(part for part in place.replace("_", "-").split("/") if part) or "results"
