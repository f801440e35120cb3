"""BEM at rest: points and tolerance, against closed forms and the same surface refined."""

from collections.abc import Sequence
from dataclasses import replace
from math import nan

import numpy as np

from bem3d import BEM
from scene import Indent, Plane, Scene, SelfAffine
from scene.scales import elastic_contact

from .convergence import Convergence, points_and_tolerances
from .reference import DEPTH, FORCE, Known, Quantity, closed_form, finer
from .scenes import CONE, KELVIN, QUICK, SPHERE, at, powers, pressed, rough

# So that what is seen of a ladder of points is discretisation alone.
TIGHT = BEM(tolerance=1e-9)
POINTS = {"quick": (32, 64, 128, 256), "full": powers(32, 1024)}
REFINED_POINTS = {"quick": (32, 64, 128, 256), "full": powers(32, 512)}  # against a finer grid
TOLERANCES = {"quick": (1e-2, 1e-4, 1e-6), "full": (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8)}
AT = {"quick": 128, "full": 512}  # points of the ladders of tolerances
REFERENCE = 1024  # points
PLANE = Scene(
    Plane(),
    KELVIN,
    Indent(pressure=5e4),
    SelfAffine(hurst=0.8, rms_height=5e-6, longest=1e-3, shortest=1.25e-4, seed=1),
)
FRACTION = Quantity(
    "contact_fraction", "contact fraction", lambda row, _: row.measures.get("contact_fraction", nan)
)
GAP = replace(DEPTH, label="mean gap")


def contacts(size: str) -> Sequence[Convergence]:
    """A sphere and a cone, a rough sphere, a rough plane."""
    found = [_sphere(size), _refined("rough-sphere", "rough sphere", rough(0.0), (DEPTH,), size)]
    if size != QUICK:
        found.insert(1, _cone(size))
        found.append(_refined("plane", "rough plane", PLANE, (GAP, FRACTION), size))
    return found


def hertzian(radius: float, peak: float) -> Quantity:
    """Deviation of the pressure from Hertz's: rms over the contact of a radius [m], over the peak [Pa]."""

    def deviation(_, fields):
        r = np.hypot(fields["x"], fields["y"][:, None])
        inside = r < radius
        known = peak * np.sqrt(1 - np.square(r[inside] / radius))
        return float(np.sqrt(np.mean(np.square(fields["pressure"][inside] - known)))) / peak

    return Quantity("pressure", "pressure", deviation)


def _sphere(size):
    scene = pressed(SPHERE)
    contact = elastic_contact(scene)
    pressure = hertzian(contact.radius, 1.5 * contact.load / (np.pi * contact.radius**2))
    truth = closed_form("Hertz", {FORCE.name: Known(contact.load), pressure.name: Known(0.0, scale=1.0)})
    # An edge of infinite slope in whole pixels leaves the pressure the first order.
    orders = {FORCE.name: 2.0, pressure.name: 1.0}
    ladders = _ladders(scene, size, keeps=("x", "y", "pressure"))
    return Convergence("sphere", "sphere", truth, (FORCE, pressure), ladders, orders)


def _cone(size):
    scene = pressed(CONE)
    truth = closed_form("Sneddon", {FORCE.name: Known(elastic_contact(scene).load)})
    return Convergence("cone", "cone", truth, (FORCE,), _ladders(scene, size))


def _refined(name, title, scene, quantities, size):
    truth = finer(scene, BEM(points=REFERENCE, tolerance=1e-8), "{} points on the same surface")
    return Convergence(name, title, truth, quantities, _ladders(scene, size, REFINED_POINTS))


def _ladders(scene, size, points=POINTS, keeps=()):
    settings = at(points, size), at(AT, size), at(TOLERANCES, size)
    return points_and_tolerances(scene, TIGHT, *settings, keeps)
