"""The file of a judged case: every point, every number with its meaning, what collapsed, and the contact."""

import json
from collections.abc import Iterable, Mapping, Sequence
from datetime import UTC, datetime
from math import isfinite
from typing import Any

import numpy as np

from scene.vocabulary import MEASURES, NUMBERS

from .cases import Case
from .mastercurve import Collapse
from .metrics import Record
from .netcdf import Group, Variable, encoded
from .taskfile import CONVENTIONS, along_axes, described, texts, whole
from .verdict import Judgement, Number
from .written import as_json

# What the columns of a point are, less what `scene.vocabulary` says.
COLUMNS = {
    "kind": ("", "which curve the point belongs to"),
    "solver": ("", "who answered"),
    "smooth": ("", "whether the body has no roughness"),
    "speed": ("m/s", "speed that was prescribed"),
    "load": ("N", "load that was prescribed, NaN where a depth was"),
    "depth": ("m", "depth that was prescribed, NaN where a load was"),
    "points": ("1", "points of the grid along a side"),
    "depth_reached": ("m", NUMBERS["depth"].text),
    "friction_coefficient": ("1", "friction force over normal force"),
    "friction_spread": ("1", "difference of two estimates of the friction in 3D, over the friction"),
    "failures": ("1", "solves without an answer"),
    "surfaces": ("1", "solves with an answer, over which the means are"),
}
ESTIMATED = {"_deviation": "standard deviation of one surface: ", "_error": "standard error of the mean: "}
CURVES = {
    "speed": ("m/s", "speed of a curve"),
    "shift": ("1", "ln p(v)/p(v_ref) by which the curve is shifted along ln F"),
    "shift_error": ("1", "standard error of the shift, NaN where it is unknown"),
}


def written(judgement: Judgement) -> bytes:
    """A netCDF-4 file of a judgement, in groups: points, numbers, checks, collapses, fields, failures, costs.

    What was asked, with the settings of the solvers, is in `case_json` and `case_toml` of the root.
    """
    content = as_json(Case, judgement.case)
    indenter = judgement.case.indenter.type
    variables = {
        "case_json": whole(json.dumps(content, ensure_ascii=False), "what was asked, as JSON"),
        "case_toml": whole(toml(content), "what was asked, as the file of a case"),
    }
    groups = {
        "points": _points(judgement.table, indenter),
        "numbers": _numbers(judgement.numbers),
        "checks": _numbers(judgement.checks),
        "failures": _table("failure", judgement.failures, ("task", "reason")),
        "collapses": Group(groups={name: _collapse(found) for name, found in judgement.collapses.items()}),
        "fields": Group(groups={name: along_axes(kept, indenter) for name, kept in judgement.fields.items()}),
        "costs": _costs(judgement.seconds),
    }
    attributes = {
        "title": judgement.case.title,
        "Conventions": CONVENTIONS,
        "source": "mdr-bem-crosscheck",
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
    }
    return encoded(Group(variables, attributes, groups))


def toml(content: Mapping[str, Any]) -> str:
    """Content as TOML: values first, then a table each; what is None is left out."""
    content = _present(content)
    tables = {name: value for name, value in content.items() if isinstance(value, Mapping)}
    lines = [f"{name} = {_toml(value)}" for name, value in content.items() if name not in tables]
    for name, table in tables.items():
        lines += ["", f"[{name}]", *(f"{key} = {_toml(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def _toml(value):
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {_toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, float) and not isfinite(value):
        return repr(value)
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def _present(value):
    """Less what is None, which TOML has not."""
    if isinstance(value, Mapping):
        return {name: _present(entry) for name, entry in value.items() if entry is not None}
    return [_present(entry) for entry in value] if isinstance(value, list) else value


def _costs(seconds):
    spent = np.array(list(seconds.values()), float)
    meaning = {
        "units": "s",
        "comment": "Processor time of all solves of the case, those of earlier runs included.",
    }
    return Group(
        {"solver": Variable(("solver",), texts(seconds)), "seconds": Variable(("solver",), spent, meaning)}
    )


def _points(table: Sequence[Record], indenter):
    columns = [record.columns for record in table]
    names = columns[0] if columns else ()
    return Group({name: _column([row[name] for row in columns], name, indenter) for name in names})


def _column(values, name, indenter):
    whose = next((name.removesuffix(end) for end in ESTIMATED if name.endswith(end)), name)
    meaning = described(whose, {**MEASURES, **NUMBERS}, indenter)
    if whose in COLUMNS:
        unit, text = COLUMNS[whose]
        meaning = {"units": unit, "long_name": whose.replace("_", " "), "comment": text}
    if whose != name:
        spread = ESTIMATED[name.removeprefix(whose)]
        meaning |= {"long_name": name.replace("_", " "), "comment": spread + meaning.get("comment", "")}
    values = texts(values) if values and isinstance(values[0], str) else np.array(values)
    return Variable(("point",), values, {key: value for key, value in meaning.items() if value})


def _numbers(numbers: Iterable[Number]):
    rows = [(each.name, each.written, each.text, each.value, each.error) for each in numbers]
    named = _table("number", [row[:3] for row in rows], ("number", "written", "definition"))
    values = {
        name: Variable(("number",), np.array([row[3 + k] for row in rows], float), {"long_name": meaning})
        for k, (name, meaning) in enumerate(
            {"value": "in SI units; the definition says of what", "error": "as the definition says"}.items()
        )
    }
    return Group({**named.variables, **values})


def _table(dimension, rows, names):
    return Group({name: Variable((dimension,), texts(row[k] for row in rows), {}) for k, name in enumerate(names)})


def _collapse(found: Collapse):
    columns = zip(CURVES.items(), (found.speeds, found.shifts, found.shift_errors), strict=True)
    variables = {
        name: Variable(("speed",), values, {"units": unit, "comment": text})
        for (name, (unit, text)), values in columns
    }
    numbers = {
        "misfit_before": (found.before.rms, "rms of ln mu about one curve without shifts"),
        "misfit": (found.after.rms, "rms of ln mu about one curve with the shifts that bring it lowest"),
        "scatter": (found.scatter, "rms standard error of ln mu, NaN if unknown"),
        "exponent": (found.exponent, "of p ~ v^exponent"),
        "exponent_error": (found.exponent_error, "standard error of the exponent, NaN if unknown"),
    }
    variables |= {
        name: Variable((), np.array(value, float), {"units": "1", "comment": text})
        for name, (value, text) in numbers.items()
    }
    told = {"verdict": found.verdict, "overlaps": str(found.overlaps), "separable": str(found.separable)}
    return Group(variables, told)
