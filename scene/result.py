"""Result of a solver: the same fields from either dimension."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np

from .markup import table
from .scene import Scene
from .vocabulary import FIELDS, MEASURES, NUMBERS

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class Result:
    """One solved scene.

    scene : what was asked
    solver, settings : name of the solver and every setting it solved with, the derived ones included
    normal_force, friction_force : F_N, F_x [N]; F_x > 0 opposes the motion of the indenter. Per length of a
        Cylinder [N/m], of one cell of a Plane
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
        """Numbers, measures and fields as a Dataset, each with its unit and definition; settings as attributes."""
        kind, words = self.scene.indenter.type, {**NUMBERS, **MEASURES}
        found = labelled(self.fields, kind)
        named = {name: getattr(self, name) for name in (*NUMBERS, "friction_coefficient")} | dict(self.measures)
        for name, value in named.items():
            entry = words.get(name)
            told = {"units": entry.unit_under(kind), "comment": entry.text} if entry else {"units": "1"}
            label = f"{name}_at_end" if name in found else name  # a field is its history
            found[label] = (), float(value), {"long_name": name.replace("_", " ")} | told
        return found.assign_attrs(
            {"solver": self.solver} | {name: str(value) for name, value in self.settings.items()}
        )

    def _repr_html_(self) -> str:
        kind, words = self.scene.indenter.type, {**NUMBERS, **MEASURES}
        rows = [(name, getattr(self, name), words[name].unit_under(kind), words[name].text) for name in NUMBERS]
        rows.insert(
            3, ("friction_coefficient", self.friction_coefficient, "1", "Friction force over normal force.")
        )
        for name, value in self.measures.items():
            known = words.get(name)
            rows.append((name, float(value), known.unit_under(kind) if known else "", known.text if known else ""))
        for name, values in self.fields.items():
            known = FIELDS.get(name)
            shape = f"array {' x '.join(map(str, values.shape))}"
            rows.append((name, shape, known.unit_under(kind) if known else "", known.text if known else ""))
        settings = ", ".join(f"{name} = {value}" for name, value in self.settings.items())
        return table(rows, ("name", "value", "unit", "meaning"), f"{self.solver}, {settings}")


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
        values, plain = np.asarray(fields[name]), name.replace("_", " ")
        dims = entry.axes if entry else ()
        if len(dims) > values.ndim:
            dims = tuple(axis for axis in dims if axis != "y")
        agree = len(dims) == values.ndim and all(
            lengths.setdefault(axis, size) == size for axis, size in zip(dims, values.shape, strict=True)
        )
        told = {"long_name": plain}
        if agree and entry:
            told |= {"units": entry.unit_under(indenter), "comment": entry.text}
        else:
            dims = tuple(f"{name}_{axis}" for axis in range(values.ndim))
        variables[name] = dims, values, told
    return xarray.Dataset(variables)
