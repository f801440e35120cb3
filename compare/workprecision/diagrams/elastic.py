"""BEM at rest: points and tolerance, against closed forms and the same surface refined."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from math import nan

import numpy as np

from bem3d import BEM
from scene import Indent, Plane, Scene, SelfAffine
from scene.scales import elastic_contact

from .. import wording
from ..contest import DEPTH, FORCE, ClosedForm, Contest, Finer, Judged, Known, Ladder, Quantity
from ..diagram import Diagram
from .scenes import CONE, KELVIN, SPHERE, powers, pressed, rough

# So that what is seen of a ladder of points is discretisation alone.
TIGHT = BEM(tolerance=1e-9)
POINTS = {"quick": (32, 64, 128, 256), "full": powers(32, 1024)}
REFINED_POINTS = {"quick": (32, 64, 128, 256), "full": powers(32, 512)}  # against a finer grid
TOLERANCES = {"quick": (1e-2, 1e-4, 1e-6), "full": (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8)}
AT = {"quick": 128, "full": 512}  # points of the ladders of tolerances
REFERENCE = {"quick": 1024, "full": 1024}
PLANE = Scene(
    Plane(),
    KELVIN,
    Indent(pressure=5e4),
    SelfAffine(hurst=0.8, rms_height=5e-6, longest=1e-3, shortest=1.25e-4, seed=1),
)
LEVELS = (1e-2, 1e-3, 1e-4)

FRACTION = Quantity(
    "contact_fraction", "contact fraction", lambda row, _: row.measures.get("contact_fraction", nan)
)
GAP = replace(DEPTH, label="mean gap")


def contests(size: str) -> Sequence[Contest]:
    """A sphere and a cone, a rough sphere, a rough plane."""
    sphere, body = _sphere(size), _refined("rough-sphere", "rough sphere", rough(0.0), (DEPTH,), size)
    if size == "quick":
        return [sphere, body]
    return [sphere, _cone(size), body, _refined("plane", "rough plane", PLANE, (GAP, FRACTION), size)]


def hertzian(radius: float, peak: float) -> Quantity:
    """What the pressure misses Hertz's by: rms over the contact of a radius [m], over the peak [Pa]."""
    return Quantity("pressure", "pressure", partial(_off_hertz, radius=radius, peak=peak))


def _off_hertz(row, fields, radius, peak):
    if row.reason is not None:
        return nan
    r = np.hypot(fields["x"], fields["y"][:, None])
    inside = r < radius
    known = peak * np.sqrt(1 - np.square(r[inside] / radius))
    return float(np.sqrt(np.mean(np.square(fields["pressure"][inside] - known)))) / peak


def _sphere(size):
    scene = pressed(SPHERE)
    contact = elastic_contact(scene)
    pressure = hertzian(contact.radius, 1.5 * contact.load / (np.pi * contact.radius**2))
    values = {FORCE.name: Known(contact.load), pressure.name: Known(0.0, scale=1.0)}
    ladders = _ladders(scene, size, keeps=("x", "y", "pressure"))
    return Contest("sphere", "sphere", ClosedForm("Hertz", values), (FORCE, pressure), ladders)


def _cone(size):
    scene = pressed(CONE)
    truth = ClosedForm("Sneddon", {FORCE.name: Known(elastic_contact(scene).load)})
    return Contest("cone", "cone", truth, (FORCE,), _ladders(scene, size))


def _refined(name, title, scene, quantities, size):
    solver = replace(TIGHT, points=REFERENCE[size], tolerance=1e-8)
    truth = Finer.of(scene, solver, f"{solver.points} points on the same surface")
    return Contest(name, title, truth, quantities, _ladders(scene, size, REFINED_POINTS))


def _ladders(scene, size, points=POINTS, **others):
    at = AT[size]
    return (
        Ladder.of("BEM, by points", scene, TIGHT, "points", points[size], **others),
        Ladder.of(f"BEM, by tolerance at {at}²", scene, BEM(points=at), "tolerance", TOLERANCES[size], **others),
    )


def advice(found: Sequence[Judged]) -> str:
    """Points for a level, and the tolerance that is enough."""
    said = []
    for judged in found:
        points, tolerances = judged.climbed
        for each in judged.contest.quantities:
            levels, order = (
                wording.levels(judged, points, each.name, LEVELS),
                wording.order(judged, points, each.name),
            )
            enough = wording.enough(tolerances, each.name)
            said.append(f"For the {each.label} of the {judged.contest.title}, {levels}; {order}; {enough}.")
    return (
        f"At rest: {' '.join(said)} Tighter than the tolerance named nothing is gained on that grid, as what is "
        f"left is discretisation.{wording.failures(found)}"
    )


DIAGRAM = Diagram(
    "elastic",
    "Three dimensions at rest: error against points and tolerance",
    "BEM at rest, by points at a tight tolerance and by tolerance at fixed points: smooth bodies against Hertz "
    "and Sneddon, rough ones against the same surface on a finer grid.",
    contests,
    advice,
)
