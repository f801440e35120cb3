"""Both bodies around a contact in 3D and 1D, the wake included, from the fields of answers; nothing is solved."""

from collections.abc import Mapping
from dataclasses import replace
from math import ceil

import numpy as np
import xarray

from bem3d import BEM
from bem3d.motion.steady import Flow
from bem3d.motion.wake import surroundings
from scene import Measured, Plane, Program, Scene, Slide
from scene.motion import pressed as pressed_in
from scene.scales import elastic_contact

from ..solving.vocabulary import attributes

Fields = Mapping[str, np.ndarray]
SURFACE, ROW = "surface", "row"

# Margins of the view, as fractions of the contact length, which is the greater of the contact's and the smooth
# relaxed contact's: before it, beside it, and behind it, there up to the most, so that as many memories fit in.
BEFORE, BESIDE, BEHIND, MOST_BEHIND, MEMORIES = 0.3, 0.15, 0.5, 2.0, 3.0


def view(scene: Scene, bem: BEM, fields: Mapping[str, Fields]) -> dict[str, xarray.Dataset]:
    """The part of a contact worth seeing, x from the axis of the indenter downstream.

    bem : the settings that the three-dimensional answer was solved with
    fields : of answers by the name of their solver, of a program at its end

    Returns "surface" (y, x) in three dimensions: displacement and gap [m], pressure [Pa]; and "row" (x) in one:
    heights of indenter and surface above the undeformed one [m], the first NaN where it is not known, whether they
    touch and, but of a program, line_force [N/m]. None of them where friction has heated the contact, since the
    fields do not say how warm it is.
    """
    found: dict[str, xarray.Dataset] = {}
    if not fields or (scene.heating is not None and scene.heating.feedback is not None):
        return found
    span, aside = _region(scene, fields)
    if "BEM" in fields:
        found[SURFACE] = _surface(scene, bem, fields["BEM"], span, aside)
    if "MDR" in fields:
        found[ROW] = _row(scene, fields["MDR"], span)
    return found


def smooth_radius(scene: Scene) -> float | None:
    """Radius of the smooth relaxed contact on a half-space [m], half the width of a line; None without one."""
    motion = scene.motion
    value = float(motion.prescribed(motion.duration)) if isinstance(motion, Program) else motion.greatest
    if isinstance(scene.indenter, Plane | Measured) or scene.layer is not None or not value > 0:
        return None
    held = pressed_in(motion.pressed_by, value)
    return elastic_contact(replace(scene, motion=held, roughness=None, interface=None)).radius


def _region(scene, fields):
    """(first, last) x and the farthest y worth seeing [m]: all where nothing touches or the surface repeats."""
    radius = smooth_radius(scene) or 0.0
    x, y = np.zeros(0), np.array([radius])
    if "BEM" in fields:
        rows, columns = np.nonzero(fields["BEM"]["pressure"] > 0)
        x, y = fields["BEM"]["x"][columns], np.append(y, np.abs(fields["BEM"]["y"][rows]))
    if "MDR" in fields:
        x = np.append(x, fields["MDR"]["x"][fields["MDR"]["contact"].astype(bool)])
    if not x.size or isinstance(scene.indenter, Plane):
        grid = next(iter(fields.values()))
        half = (grid["x"][1] - grid["x"][0]) / 2
        return (grid["x"][0] - half, grid["x"][-1] + half), np.max(np.abs(grid.get("y", 0.0))) + half
    length = max(np.ptp(x), 2 * radius)
    speed = scene.motion.speed if isinstance(scene.motion, Slide) else 0.0
    wake = np.clip(MEMORIES * Flow.of(scene.solid, speed).memory / length, BEHIND, MOST_BEHIND)
    start, end = min(x.min(), -radius), max(x.max(), radius)
    return (start - (BEFORE if speed else BEHIND) * length, end + wake * length), y.max() + BESIDE * length


def _surface(scene, bem, plane, span, aside):
    """The surface in 3D, with the parts that the grid of the answer leaves out."""
    x, y = plane["x"], plane["y"]
    reach = {"upstream": x[0] - span[0], "downstream": span[1] - x[-1], "aside": aside - min(-y[0], y[-1])}
    around = surroundings(bem, scene, plane, **{name: max(each, 0.0) for name, each in reach.items()})
    first, above = (int(np.argmin(np.abs(whole - own[0]))) for whole, own in ((around.x, x), (around.y, y)))
    pressure = np.zeros_like(around.displacement)
    pressure[above : above + len(y), first : first + len(x)] = plane["pressure"]
    # What is left of the gap in contact is the residual of the solver.
    gap = np.where(pressure > 0, 0.0, around.gap)
    fields = {"displacement": around.displacement, "gap": gap, "pressure": pressure}
    whole = _dataset(fields, y=around.y, x=around.x + around.lag)
    return whole.sel(x=slice(*span), y=slice(-aside, aside) if len(y) > 1 else slice(None))


def _row(scene, fields, span):
    """The row of elements in 1D.

    Beyond its grid, where no force is, the surface arrives undisturbed, and behind the contact each mode recovers
    on its own from the forces that it has felt.
    """
    x, touching = fields["x"], fields["contact"].astype(bool)
    profile, surface = fields["profile"], -fields["displacement"]
    depth = (profile - surface)[touching].mean() if touching.any() else np.nan
    program, pixel = isinstance(scene.motion, Program), x[1] - x[0]
    missing = (0.0, 0.0) if program else (x[0] - span[0], span[1] - x[-1])
    before, behind = beyond = [max(ceil(length / pixel), 0) for length in missing]
    places = x[0] + pixel * np.arange(-before, x.size + behind)
    columns = {
        "indenter": np.pad(profile - fields.get("depth", [depth])[-1], beyond, constant_values=np.nan),
        "surface": np.pad(surface, beyond),
        "touching": np.pad(touching, beyond),
    }
    if not program:
        columns["line_force"] = np.pad(fields["line_force"], beyond)
    if behind:
        flow, last = Flow.of(scene.solid, scene.motion.speed), x[-1]
        felt = fields["line_force"][:-1] @ np.diff(np.exp((x - last)[:, None] / flow.lengths), axis=0)
        left = np.exp((last - places[-behind:, None]) / flow.lengths)
        columns["surface"][-behind:] = -left @ (flow.shares * felt / flow.modulus)
    return _dataset(columns, x=places).sel(x=slice(*span))


def _dataset(fields, **places):
    """Fields over their places, with units and definitions."""
    found = xarray.Dataset({name: ([*places], values) for name, values in fields.items()}, places)
    for name in found.variables:
        found[name].attrs = attributes(name)
    return found
