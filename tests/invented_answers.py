"""Answers of a series that obey a law of friction, with gaps and scatter as they are asked for."""

from dataclasses import replace

import numpy as np
import xarray

from bem3d import BEM
from compare.solving.parameter_grid import COARSE, FAILED, FINE, SOLVED
from compare.studies.claims.series import ROUGH, SMOOTH, Contacts, Series
from compare.studies.paper import parameters
from mdr1d import MDR, equations

SURFACES = 8
SERIES = Series(
    name="sphere",
    title="Rough sphere",
    scene=parameters.resolved("sphere"),
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


def obeying(law, series=SERIES, scatter=0.02, grid=0.0, seed=1, level=1.0, slope=SLOPE):
    """Answers with a friction law(load, speed) on every surface but for scatter common to all points of a surface.

    grid : relative error of the coarse grid; level : of three dimensions over one
    """
    random, parts = np.random.default_rng(seed), {}
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
                "curvature_by_pressure": slow,
                "rms_slope_contact": np.sqrt(slow * loads / 4e6 / length),
                "residual": 0.0,
                "seconds": 1.0,
            }
            dims = ["level", "speed", series.prescribed, "surface"]
            columns |= {"status": np.array(SOLVED, object), "reason": np.array("", object)}
            variables = {name: (dims, np.broadcast_to(each, mu.shape).copy()) for name, each in columns.items()}
            places = {"level": [FINE, COARSE], "speed": [0.0, *series.speeds], "points": ("level", [64, 32])}
            dataset = xarray.Dataset(variables, places | {series.prescribed: list(series.values)})
            dataset = dataset if body == ROUGH else dataset.isel(surface=0, drop=True)
            parts[f"/{series.name}/{body}/{solver}"] = dataset
    return Contacts(series, xarray.DataTree.from_dict(parts))


def eq_19(load, speed, alpha=equations.ALPHA, slope=SLOPE):
    """The law of the paper for SERIES."""
    body = SERIES.scene.indenter
    xi = equations.similarity_variable(load, 1e6, 1e-3, speed, slope, body.mdr_coefficient, body.exponent)
    return equations.plateau(slope) * equations.interpolation(xi, alpha)


def spoiled(contacts, place, solver="BEM", body=ROUGH, reason="no"):
    """Answers of which some solves of the fine grid failed; place : of (speeds, values, draws) that slide."""
    answers = contacts.answers.copy(deep=True)
    dataset = answers[f"{contacts.series.name}/{body}/{solver}"].to_dataset()
    for name, each in dataset.data_vars.items():
        value = {"status": FAILED, "reason": reason}.get(name, np.nan)
        each.values[0, 1:][place] = value
    answers[f"{contacts.series.name}/{body}/{solver}"] = xarray.DataTree(dataset)
    return Contacts(contacts.series, answers)


def cut(contacts, speeds=None, values=None, surfaces=None):
    """Answers at fewer speeds, loads or surfaces, the first ones."""
    series, parts = contacts.series, {}
    kept = {"speed": slice(None if speeds is None else speeds + 1), series.prescribed: slice(values)}
    for (solver, body), dataset in contacts.datasets.items():
        draws = {"surface": slice(surfaces)} if body == ROUGH else {}
        parts[f"/{series.name}/{body}/{solver}"] = dataset.isel(kept | draws)
    count = surfaces or series.surfaces
    few = {"speeds": series.speeds[:speeds], "values": series.values[:values]}
    few |= {"surfaces": count, "profiles": count}
    return Contacts(replace(series, **few), xarray.DataTree.from_dict(parts))


def other(contacts, name, **roughness):
    """The same answers as those of another series, of another roughness."""
    series = contacts.series
    rough = replace(series.scene.roughness, **roughness)
    answers = xarray.DataTree.from_dict({f"/{name}": contacts.answers[series.name]})
    return Contacts(replace(series, name=name, scene=replace(series.scene, roughness=rough)), answers)
