"""A program in time: the forces of both models, and a section of each at a few instants."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame, concat

from bem3d import BEM
from bem3d.wake import heights
from scene import Cylinder, Scene

from ...figures import style, touching
from ...figures.lettering import lettered
from ...figures.prefixes import prefixed
from ...report.page import Plot, Tables
from ...report.views import Fields
from ...solving.vocabulary import attributes

NAME = "program"
FORCES, SECTIONS = f"{NAME}-forces", f"{NAME}-sections"
INSTANTS = 4
HISTORIES = {"normal_force": "normal force", "friction_force": "friction"}
DIMENSION = {"BEM": "3D", "MDR": "1D"}
TALL, EACH = 1.9, 1.3  # height of the forces, and of a row of sections [inch]


def dataset(scene: Scene, bem: BEM, solver: str, fields: Fields) -> xarray.Dataset:
    """Forces in time (time), and the section y = 0 at instants (frame_time, x), from the fields of an answer."""
    depth = fields["frame_depth"][:, None]
    if solver == "BEM":
        row = int(np.argmin(np.abs(fields["y"])))
        x = fields["x"] + fields["frame_shift"][:, None]
        indenter = np.array([heights(bem, scene, each, fields["y"][row : row + 1])[0] for each in x]) - depth
        surface, touched = -fields["frame_displacement"][:, row], fields["frame_pressure"][:, row] > 0
    else:
        x, indenter = fields["frame_x"], fields["frame_profile"] - depth
        surface, touched = -fields["frame_displacement"], fields["frame_contact"].astype(bool)
    instants = {"frame_x": x, "indenter": indenter, "surface": surface, "touching": touched}
    variables: dict[str, Any] = {name: ("time", fields[name], attributes(name)) for name in HISTORIES}
    variables |= {name: (("frame_time", "x"), values, attributes(name)) for name, values in instants.items()}
    times = {name: (name, fields[name], attributes(name)) for name in ("time", "frame_time")}
    return xarray.Dataset(variables, times)


def plot(scene: Scene, answers: Mapping[str, xarray.Dataset]) -> Plot:
    """Plot of a program that each solver has marched through, by the name of the solver."""
    forces = {name: each[list(HISTORIES)].to_dataframe().reset_index() for name, each in answers.items()}
    sections = {
        name: each[["frame_x", "indenter", "surface", "touching"]]
        .to_dataframe()
        .reset_index()
        .drop(columns="x")
        .rename(columns={"frame_x": "x", "frame_time": "time"})
        for name, each in answers.items()
    }
    tables = {FORCES: _stacked(forces), SECTIONS: _stacked(sections)}
    x = answers["BEM"]["frame_x"].values
    options = {
        "span": [float(x.min()), float(x.max())],
        "unit": "N/m" if isinstance(scene.indenter, Cylinder) else "N",
    }
    caption = (
        "Forces in time; dotted, the instants of the sections below: rigid indenter and elastomer along y = 0, "
        "real contact in bold, heights exaggerated."
    )
    alternative = "Curves of both forces in time above, sections through the contact at a few instants below."
    return Plot(NAME, figure, tables, caption, alternative, options)


def figure(tables: Tables, span: Sequence[float], unit: str = "N") -> Figure:
    """Above: normal force and friction in time. Below: a row of sections for each model.

    span : first and last x [m]; unit : of a force
    """
    forces, sections = tables[FORCES], tables[SECTIONS]
    solvers = [solver for solver in DIMENSION if solver in set(forces["solver"])]
    drawing = style.canvas("double", TALL + EACH * len(solvers))
    above, below = drawing.subfigures(2, 1, squeeze=False, height_ratios=(TALL, EACH * len(solvers)))[:, 0]
    histories = above.subplots(1, len(HISTORIES))
    for axes, name in zip(histories, HISTORIES, strict=True):
        _history(axes, forces, name, unit)
        for instant in sections.loc[sections["solver"] == solvers[0], "time"].unique():
            axes.axvline(prefixed(forces["time"], "s")[0] * instant, **style.line(0.5, 0.5, linestyle=":"))
    histories[0].legend()
    of = {solver: dict(tuple(sections[sections["solver"] == solver].groupby("time"))) for solver in solvers}
    seen = {
        solver: {time: touching.section_of(each) for time, each in instants.items()}
        for solver, instants in of.items()
    }
    ends = (span[0], span[1])
    limits = touching.heights([each for instants in seen.values() for each in instants.values()], ends)
    scale, seconds = prefixed(forces["time"], "s")
    columns = max(len(instants) for instants in seen.values())
    panels = below.subplots(len(solvers), columns, sharex=True, sharey=True, squeeze=False)
    for row, solver in zip(panels, solvers, strict=True):
        for axes, (time, each) in zip(row, seen[solver].items(), strict=False):
            touching.section(axes, each, solver, ends, limits)
            axes.set_title(f"{DIMENSION[solver]}, {scale * time:.3g} {seconds}")
            axes.label_outer()
    lettered([*histories, *panels.ravel()])
    return drawing


def _history(axes: Axes, forces: DataFrame, name: str, unit: str) -> None:
    """Panel of a force in time, of each model."""
    (scale, seconds), (up, newton) = prefixed(forces["time"], "s"), prefixed(forces[name], unit)
    for solver, curve in forces.groupby("solver", sort=False):
        axes.plot(scale * curve["time"], up * curve[name], **style.look(str(solver), marker=""))
    axes.set(xlabel=f"time [{seconds}]", ylabel=f"{HISTORIES[name]} [{newton}]", title=HISTORIES[name])


def _stacked(tables: Mapping[str, DataFrame]) -> DataFrame:
    """One table of those of each solver, with the solver as its first column."""
    return concat([table.assign(solver=name) for name, table in tables.items()], ignore_index=True)
