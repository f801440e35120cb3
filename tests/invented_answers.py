"""Answers of a series that obey a law of friction, with gaps and scatter as they are asked for."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import isnan

import numpy as np
import xarray

from bem3d import BEM
from compare.solving.curve import COARSE, FAILED, FINE, NOT_ASKED, SOLVED
from compare.studies.comparison.answers import Answers
from compare.studies.comparison.rough import ROUGH, SMOOTH, RoughSeries
from compare.studies.comparison.series import Judged
from compare.studies.paper import parameters
from mdr1d import MDR, equations

SURFACES = 8


def resolved(shape):
    """A contact of Fig. 1 of the paper with a shortest wave that both dimensionalities resolve."""
    scene = parameters.contact(shape)
    return replace(scene, roughness=replace(scene.roughness, shortest=5e-4))


SERIES = RoughSeries(
    name="sphere",
    title="Rough sphere",
    scene=resolved("sphere"),
    speeds=tuple(float(v) for v in np.geomspace(2e-3, 4.0, 10)),
    values=tuple(float(f) for f in np.geomspace(0.05, 50, 8)),
    surfaces=SURFACES,
    profiles=SURFACES,
    bem=BEM(points=64),
    mdr=MDR(points=500),
)
# Ends and middle of the speeds and loads: enough for families and powers.
FEW = replace(SERIES, speeds=SERIES.speeds[::3], values=SERIES.values[::3])
SLOPE = 0.2


@dataclass(frozen=True)
class Invented:
    """A series with a Dataset of each of its curves."""

    series: RoughSeries
    curves: Mapping[str, xarray.Dataset]

    @property
    def tree(self) -> xarray.DataTree:
        return xarray.DataTree.from_dict(
            {f"/{self.series.folder}/{name}": each for name, each in self.curves.items()}
        )

    @property
    def answers(self) -> Answers:
        return self.series.answers(self.tree)

    def __call__(self, model: str, body: str = ROUGH, level: str = FINE) -> xarray.Dataset:
        return self.answers(body, model, level)

    def judge(self) -> Judged:
        return self.series.judge(self.answers)


def obeying(law, series=SERIES, scatter=0.02, grid=0.0, seed=1, level=1.0, slope=SLOPE):
    """Answers with a friction law(load, speed) on every surface but for scatter common to all points of a surface.

    grid : relative error of the coarse grid; level : of three dimensions over one
    """
    random, parts = np.random.default_rng(seed), {ROUGH: [], SMOOTH: []}
    loads = np.array(series.values)[:, None]
    speeds = np.array((1e-300, *series.speeds))[:, None, None]
    logs = np.log10(np.maximum(speeds, 1e-3)) / 2
    length = 1e-4 * loads ** (1 / (series.scene.indenter.exponent + 1))  # as the nominal contact
    for solver, contact in (("MDR", "contact_length"), ("BEM", "contact_area")):
        draws = series.draws[solver]
        tilts = scatter * random.standard_normal((3, draws))
        alone = scatter / 4 * random.standard_normal((speeds.size, loads.size, draws))
        drawn = np.exp(tilts[0] + tilts[1] * logs + tilts[2] * np.log10(loads) / 2 + alone)
        drawn = drawn * (level if solver == "BEM" else 1.0)
        for body, factor in ((ROUGH, drawn), (SMOOTH, np.ones((speeds.size, loads.size, 1)))):
            off = np.array([1.0, 1 + grid])[:, None, None, None]
            mu = law(loads, speeds) * factor * off
            force = np.broadcast_to(loads, mu.shape)
            slow = law(loads, 1e-9) / 1e-9 * factor[:1] / 1e-3
            columns = {
                "normal_force": force,
                "friction_force": mu * force,
                "depth_reached": loads ** (2 / 3) * 1e-4 * factor,
                "rms_slope": slope,
                "pixel": 1e-5,
                contact: length if solver == "MDR" else length**2,
                "residual": 0.0,
                "seconds": 1.0,
            }
            if solver == "BEM":
                columns["curvature_by_pressure"] = slow
            columns["rms_slope_contact"] = np.sqrt(slow * loads / 4e6 / length)
            dims = ["level", "speed", series.prescribed, "surface"]
            columns |= {"status": np.array(SOLVED, object), "reason": np.array("", object)}
            variables = {name: (dims, np.broadcast_to(each, mu.shape).copy()) for name, each in columns.items()}
            places = {
                "level": [FINE, COARSE],
                "speed": [0.0, *series.speeds],
                series.prescribed: list(series.values),
            }
            dataset = xarray.Dataset(variables, places | {"surface": np.arange(mu.shape[-1])})
            dataset = dataset.assign_coords(points=("level", [64, 32]), draws=series.models[solver].draws)
            dataset = dataset if body == ROUGH else dataset.isel(surface=0, drop=True)
            parts[body].append(dataset.expand_dims(model=[solver]))
    return Invented(series, {body: joined(each) for body, each in parts.items()})


def joined(parts):
    """Answers of both models in one Dataset."""
    whole = xarray.concat(parts, "model", data_vars="all", coords="different", compat="equals", join="outer")
    return whole.assign(
        {
            name: whole[name].where(whole[name].notnull(), gap)
            for name, gap in (("status", NOT_ASKED), ("reason", ""))
        }
    )


def eq_19(load, speed, alpha=equations.ALPHA, slope=SLOPE):
    """The law of the paper for SERIES."""
    body = SERIES.scene.indenter
    xi = equations.similarity_variable(load, 1e6, 1e-3, speed, slope, body.mdr_coefficient, body.exponent)
    return equations.plateau(slope) * equations.interpolation(xi, alpha)


def changed(invented, body=ROUGH, model="BEM", level=FINE, place=..., **numbers):
    """Answers with other numbers at some speeds, values and surfaces, rest among them."""
    dataset = invented.curves[body].copy(deep=True)
    for name, change in numbers.items():
        own = (
            dataset[name].loc[{"model": model, "level": level}].transpose("speed", invented.series.prescribed, ...)
        )
        values = own.values.copy()
        values[place] = change(values[place]) if callable(change) else change
        dataset[name].loc[{"model": model, "level": level}] = xarray.DataArray(values, dims=own.dims)
    return replace(invented, curves={**invented.curves, body: dataset})


def spoiled(invented, place, model="BEM", body=ROUGH, reason="no"):
    """Answers where some solves of the fine grid failed; place : of (speeds, values, draws) that slide."""
    first, *others = place if isinstance(place, tuple) else (place,)
    moved = slice(1, None) if first == slice(None) else first + 1
    numbers = [name for name, each in invented.curves[body].data_vars.items() if each.dtype.kind == "f"]
    gaps = dict.fromkeys(numbers, np.nan) | {"status": FAILED, "reason": reason}
    return changed(invented, body, model, place=(moved, *others), **gaps)


def cut(invented, speeds=None, values=None, surfaces=None):
    """Answers at fewer speeds, loads or surfaces, the first ones."""
    series = invented.series
    kept = {"speed": slice(None if speeds is None else speeds + 1), series.prescribed: slice(values)}
    parts = {
        body: each.isel(kept | ({"surface": slice(surfaces)} if body == ROUGH else {}))
        for body, each in invented.curves.items()
    }
    count = surfaces or series.surfaces
    few = {"speeds": series.speeds[:speeds], "values": series.values[:values]}
    few |= {"surfaces": count, "profiles": count}
    return Invented(replace(series, **few), parts)


def other(invented, name, **roughness):
    """The same answers as those of another series, of another roughness."""
    rough = replace(invented.series.scene.roughness, **roughness)
    return replace(
        invented, series=replace(invented.series, name=name, scene=replace(invented.series.scene, roughness=rough))
    )


def outside(findings):
    """Findings whose number is not in its interval."""
    return [
        each
        for each in findings
        for low, high in [each.interval]
        if not (isnan(each.value + low + high) or low <= each.value <= high)
    ]
