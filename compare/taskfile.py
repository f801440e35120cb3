"""The file of a task: what was asked, by what code it was answered, and every number with its unit and meaning."""

import json
import math
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from typing import Any

import numpy as np

from scene.vocabulary import FIELDS, MEASURES, NUMBERS, Entry

from .netcdf import Group, Reader, Variable, encoded, opened
from .outcome import Outcome, Row
from .vocabulary import LABELS

CONVENTIONS = "CF-1.11"
# Variables that are no measures; no measure may be called so.
ROWS, OTHERS = "scene", ("scene", "seed", "question", "absent", "settings", "failed", "reason", "fields")
NAMES = tuple(NUMBERS)


def written(
    outcome: Outcome, question: Mapping[str, Any], text: str, about: Mapping[str, str], keeps: bool
) -> bytes:
    """A file of an outcome.

    question : what was asked, as JSON can hold it; text : its canonical text
    about : attributes of the file, by name
    keeps : whether the task keeps fields, even where there are none

    Raises ValueError for a measure whose name is taken, TypeError for fields of a type that no file holds.
    """
    indenter = _indenter(question)
    if taken := {name for row in outcome.rows for name in row.measures} & {*NAMES, *OTHERS}:
        raise ValueError(f"no measure may be called {', '.join(sorted(taken))}")
    variables = _numbers(outcome.rows, indenter) | _seeds(question, len(outcome.rows))
    absent = {}
    for name in dict.fromkeys(name for row in outcome.rows for name in row.measures):
        values = [row.measures.get(name) for row in outcome.rows]
        absent[name] = [row for row, value in enumerate(values) if value is None]
        stored = np.array([math.nan if value is None else value for value in values], float)
        variables[name] = Variable((ROWS,), stored, described(name, {**LABELS, **MEASURES}, indenter))
    failed = np.array([row.reason is not None for row in outcome.rows], bool)
    if failed.any():
        reasons = texts(row.reason or "" for row in outcome.rows)
        variables["failed"] = Variable((ROWS,), failed, {"long_name": "whether there is no answer"})
        variables["reason"] = Variable((ROWS,), reasons, {"long_name": "why there is no answer"})
    settings = texts(canonical(row.settings) if row.settings else "{}" for row in outcome.rows)
    variables["settings"] = Variable((ROWS,), settings, {"long_name": "settings that the solver chose, as JSON"})
    variables["question"] = whole(text, "what was asked, as JSON")
    if any(absent.values()):
        variables["absent"] = whole(canonical(absent), "scenes of which a measure was not taken, as JSON")
    attributes = {
        **about,
        "Conventions": CONVENTIONS,
        "created": datetime.now(UTC).isoformat(timespec="microseconds"),
        "failures": str(failed.sum()),
        "measures": canonical(list(absent)),
    }
    groups = {"fields": along_axes(outcome.fields, indenter)} if outcome.fields or keeps else {}
    return encoded(Group(variables, attributes, groups))


def read(content: bytes, text: str, keeps: bool) -> tuple[str, Outcome]:
    """When a file was written, and its outcome, with the fields if the task keeps them.

    text : canonical, of what is asked

    Raises ValueError where the file is damaged or answers another question, KeyError where something is missing.
    """
    with opened(content) as file:
        if file.values("question").item() != text:
            raise ValueError("the file answers another question")
        rows, kept = _rows(file), file.below("fields") if keeps else None
        fields = {name: kept.values(name) for name in json.loads(kept.text("fields"))} if kept else {}
        return file.text("created"), Outcome(rows, fields)


def described(name: str, entries: Mapping[str, Entry], indenter: str = "") -> dict[str, str]:
    """Attributes of a variable; one that no entry tells of has its name alone."""
    plain = name.replace("_", " ")
    if name not in entries:
        return {"long_name": plain}
    entry = entries[name]
    return {"units": entry.unit_under(indenter), "long_name": plain, "comment": entry.text}


def canonical(value: Any) -> str:
    """JSON that is the same for equal values on every platform; numbers that JSON lacks are named."""
    try:
        return _json(value)
    except ValueError:
        return _json(_named(value))


def _json(value):
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def _named(value):
    if isinstance(value, float) and not math.isfinite(value):
        return {"not finite": repr(value)}
    if isinstance(value, Mapping):
        return {name: _named(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_named(entry) for entry in value]
    return value


def _numbers(rows, indenter) -> dict[str, Variable]:
    scenes = {ROWS: Variable((ROWS,), np.arange(len(rows)), {"long_name": "which scene of the question"})}
    return scenes | {
        name: Variable(
            (ROWS,), np.array([getattr(row, name) for row in rows], float), described(name, NUMBERS, indenter)
        )
        for name in NAMES
    }


def _seeds(question, count):
    """Seeds of the roughness of each scene, where the question states them."""
    scenes = question.get("scenes", ())
    seeds = [(scene.get("roughness") or {}).get("seed") for scene in scenes]
    if len(seeds) != count or not all(isinstance(seed, int) and seed < 2**63 for seed in seeds):
        return {}
    return {"seed": Variable((ROWS,), np.array(seeds, np.int64), {"long_name": "seed of the roughness"})}


def _indenter(question):
    """The type of the first, as a scene file names it; empty of a question about no scene."""
    scenes = [*question.get("scenes", ()), *question.values(), *question.get("timed", {}).values()]
    return next(
        (each["indenter"]["type"] for each in scenes if isinstance(each, Mapping) and "indenter" in each), ""
    )


def along_axes(fields: Mapping[str, np.ndarray], indenter: str = "") -> Group:
    """Fields along the axes of the vocabulary, where all of them agree on how long those are."""
    known = {name: np.asarray(values) for name, values in fields.items()}
    # A field that is called like an axis is that axis, or there is none.
    places = {name: values for name, values in known.items() if name in FIELDS and FIELDS[name].axes == (name,)}
    lengths = {name: values.size if values.ndim == 1 else -1 for name, values in places.items()}
    variables = {}
    for name, values in known.items():
        entry = FIELDS.get(name)
        axes = entry.axes if entry else ()
        if len(axes) > values.ndim:
            axes = tuple(axis for axis in axes if axis != "y")
        agree = len(axes) == values.ndim and all(
            lengths.setdefault(axis, size) == size for axis, size in zip(axes, values.shape, strict=True)
        )
        if not agree:
            axes = tuple(f"{name}_{axis}" for axis in range(values.ndim))
        variables[name] = Variable(
            axes, values, described(name, FIELDS if agree else {**LABELS, **MEASURES}, indenter)
        )
    return Group(variables, {"fields": canonical(list(known))})


def _rows(file: Reader):
    taken = json.loads(file.text("measures"))
    absent = json.loads(file.values("absent").item()) if "absent" in file else dict.fromkeys(taken, ())
    settings = [json.loads(text, object_hook=_unnamed) for text in file.values("settings")]
    numbers = {name: file.floats(name, len(settings)) for name in NAMES}
    measures = {name: file.floats(name, len(settings)) for name in taken}
    reasons = [None] * len(settings)
    if "failed" in file:
        marked = zip(file.values("failed"), file.values("reason"), strict=True)
        reasons = [reason if failed else None for failed, reason in marked]
    return tuple(
        Row(
            **{name: values[row] for name, values in numbers.items()},
            measures={name: values[row] for name, values in measures.items() if row not in absent[name]},
            settings=setting,
            reason=reasons[row],
        )
        for row, setting in enumerate(settings)
    )


def texts(values: Iterable[str]) -> np.ndarray:
    """Values of a variable that holds strings."""
    found = list(values)
    return np.array([*found, None], object)[: len(found)]


def whole(text: str, meaning: str) -> Variable:
    """One text, however long: attributes hold no more than 64 kB."""
    return Variable((), np.array(text, object), {"long_name": meaning})


def _unnamed(value):
    return float(value["not finite"]) if value.keys() == {"not finite"} else value
