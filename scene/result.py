"""Result of a solver: the same fields from either dimension."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np

from .files.reading import validator
from .printable import plain_table, table
from .scene import Scene
from .vocabulary import FIELDS, MEASURES, NUMBERS, Entry

if TYPE_CHECKING:
    import xarray

UNKNOWN = Entry("", "")  # of what a model names by itself


@dataclass(frozen=True)
class Result:
    """One solved scene. Printed, it is a table of its numbers.

    scene : what was asked
    solver, settings : name of the solver and every setting it solved with, the derived ones included
    normal_force, friction_force : F_N, F_x [N]; F_x > 0 opposes the motion of the indenter. Per length of a
        Cylinder [N/m], on a cell of a Plane
    depth : of the macroscopic tip below the undeformed surface [m], > 0 into the elastomer; see Cylinder and Plane
        for what theirs is counted from
    residual : left in the discrete contact conditions, relative; the solver's docstring defines it
    operator_applications : operator applications, in equivalents of the finest grid
    seconds : processor time of the solve [s]; these three are NaN of a model that does not tell
    measures : what else the solver measured, name -> number in SI units
    fields : arrays on the solver's grid, name -> array, SI units
    """

    scene: Scene
    solver: str
    settings: Mapping[str, Any]
    normal_force: float
    depth: float
    friction_force: float = 0.0
    residual: float = nan
    operator_applications: float = nan
    seconds: float = nan
    measures: Mapping[str, float] = field(default_factory=dict)
    fields: Mapping[str, np.ndarray] = field(default_factory=dict, repr=False)

    @property
    def friction_coefficient(self) -> float:
        """mu = F_x / F_N; NaN where nothing is pressed."""
        return self.friction_force / self.normal_force if self.normal_force else nan

    def to_xarray(self) -> "xarray.Dataset":
        """Numbers, measures and fields as a Dataset, each with its unit and definition.

        The settings are attributes; so is where the numbers come from, see `provenance`.
        """
        kind, rough = self.scene.indenter.type, self.scene.roughness
        seeds = [rough.seed] if hasattr(rough, "seed") else []
        found = labelled(self.fields, kind)
        for name, (value, entry) in self._numbers.items():
            label = f"{name}_at_end" if name in found else name  # a field is its history
            found[label] = (), value, entry.attributes(name, kind)
        return found.assign_attrs(
            provenance(self.scene, seeds)
            | {"solver": self.solver}
            | {name: str(value) for name, value in self.settings.items()}
        )

    @property
    def _numbers(self) -> dict[str, tuple[float, Entry]]:
        """Numbers and measures by name, each with its entry."""
        named = {name: getattr(self, name) for name in NUMBERS} | dict(self.measures)
        return {name: (float(value), {**NUMBERS, **MEASURES}.get(name, UNKNOWN)) for name, value in named.items()}

    def __str__(self) -> str:
        return plain_table(((name, value, unit) for name, value, unit, _ in self._rows), self._title)

    def _repr_html_(self) -> str:
        return table(self._rows, ("name", "value", "unit", "meaning"), self._title)

    @property
    def _title(self) -> str:
        shown = (
            f"{name} = {value:.6g}" if isinstance(value, float) else f"{name} = {value}"
            for name, value in self.settings.items()
        )
        return ", ".join([self.solver, *shown])

    @property
    def _rows(self) -> list[tuple[str, float | str, str, str]]:
        """Numbers, measures and fields: name, value, unit, meaning."""
        shown: list[tuple[str, float | str, Entry]] = [(name, *found) for name, found in self._numbers.items()]
        for name, values in self.fields.items():
            shown.append((name, f"array {' x '.join(map(str, values.shape))}", FIELDS.get(name, UNKNOWN)))
        kind = self.scene.indenter.type
        return [(name, value, entry.unit_under(kind), entry.text) for name, value, entry in shown]


def provenance(scene: Scene, seeds: Sequence[int] | np.ndarray = ()) -> dict[str, str]:
    """Attributes of a Dataset that say where its numbers come from: the scene as JSON, the version, and the seeds.

    seeds : of the rough surfaces, ascending; none of a body without draws
    """
    attributes = {"scene": validator(Scene).dump_json(scene, exclude_none=True).decode(), "source": source()}
    if len(seeds) > 0:
        rows = np.split(seeds, np.flatnonzero(np.diff(seeds) > 1) + 1)
        attributes["seeds"] = ", ".join(f"{row[0]} to {row[-1]}" if len(row) > 1 else str(row[0]) for row in rows)
    return attributes


def source() -> str:
    """Name and version of the package, by which every Dataset says where it comes from."""
    return f"mdr-bem-crosscheck {version('mdr-bem-crosscheck')}"


def labelled(fields: Mapping[str, np.ndarray], indenter: str) -> "xarray.Dataset":
    """Fields along the axes of the vocabulary, where all of them agree on how long those are.

    indenter : kind of the body, on which units depend
    """
    import xarray  # slow, and few results need it

    # A field that is called like an axis is that axis, or there is none.
    known = {name: FIELDS.get(name) for name in fields}
    axes = {name: np.asarray(fields[name]) for name, entry in known.items() if entry and entry.axes == (name,)}
    lengths = {name: values.size if values.ndim == 1 else -1 for name, values in axes.items()}
    variables = {}
    for name, entry in known.items():
        values = np.asarray(fields[name])
        dims = entry.axes if entry else ()
        if len(dims) > values.ndim:
            dims = tuple(axis for axis in dims if axis != "y")
        agree = len(dims) == values.ndim and all(
            lengths.setdefault(axis, size) == size for axis, size in zip(dims, values.shape, strict=True)
        )
        if not (agree and entry):
            entry, dims = UNKNOWN, tuple(f"{name}_{axis}" for axis in range(values.ndim))
        variables[name] = dims, values, entry.attributes(name, indenter)
    return xarray.Dataset(variables)
