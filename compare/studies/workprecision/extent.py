"""A free surface against a cell that repeats: what is paid for extent, and what neighbours falsify.

Crossed waves pressed lightly are a lattice of tips of known curvature, two a cell. Two things part them from one
free sphere: their neighbours, and their own shape, which rises less than a paraboloid. Averaged over angles it is

    z = r^2/(2R) (1 - q^2 r^2/8),  1/R = q^2 h0,  q = 2 pi / lambda,

a body of revolution, of which F = (4 E*/3R) a^3 (1 - q^2 a^2/5) by Galin and Sneddon, and slow friction goes as
int_0^a g'^2 dx with g' = (2x/R) (1 - q^2 x^2/3). With these the shape is taken out, to the order q^2 a^2.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import nan, pi

import numpy as np
from scipy.optimize import brentq

from bem3d import BEM
from scene import CrossedWaves, Indent, Plane, Scene, Slide
from scene.scales import elastic_contact

from ...statistics.convergence import MeasuredLadder
from .convergence import Convergence, Ladder
from .diagram import reported
from .reference import FRICTION, Known, Quantity, closed_form, finer
from .scenes import CONTACT, KELVIN, SPHERE, TIME, at, pressed, some
from .timed_solve import TimedSolve

ACROSS = {"quick": 24, "full": 32}  # pixels across the contact at rest, the same in all
PERIODS = {"quick": (2, 4, 8), "full": (2, 4, 8, 16, 32)}  # of a cell, over the diameter of a contact
EXTENTS = {"quick": (1.25, 4), "full": (1.25, 2, 4, 8)}  # of a free window, over the same
FLOWS = {"quick": (0.1,), "full": (0.1, 1.0, 10.0)}
REFERENCE = {"quick": 256, "full": 1024}
LOAD = elastic_contact(pressed(SPHERE)).load
LESS_SHAPE = "less the wave's shape"


def contacts(size: str) -> Sequence[Convergence]:
    """At rest by the radius of contact, in sliding by friction."""
    return [_at_rest(size), *(_sliding(flow, size) for flow in some(FLOWS, size))]


def cell(period: float, motion) -> Scene:
    """Crossed waves with the curvature of the sphere at their tips; motion : under a load [N] on each tip."""
    wavelength = 2 * CONTACT * period
    waves = CrossedWaves(amplitude=wavelength**2 / (4 * pi**2 * SPHERE.radius), wavelength=wavelength)
    pressure = 2 * motion.load / wavelength**2
    return Scene(Plane(), KELVIN, replace(motion, load=None, pressure=pressure), waves)


def contact_radius(row, fields) -> float:
    """Contact radius from the second moment of the pressure about its tip, which of Hertz's is 2 a^2 / 5 [m]."""
    x, y, p = fields["x"], fields["y"][:, None], fields["pressure"]
    if _repeats(row):
        period = row.settings["extent"]
        x_to, y_to = (_wrapped(each - period / 2, period) for each in (x, y))
        x, y = _wrapped(x, period), _wrapped(y, period)
        square = np.minimum(np.square(x_to) + np.square(y), np.square(x) + np.square(y_to))
    else:
        square = np.square(x) + np.square(y)
    return float(np.sqrt(2.5 * np.sum(p * square) / p.sum()))


def wave_radius(wave_number: float) -> float:
    """Contact radius of one wave under LOAD [m], as a body of revolution; NaN where the series ends before it."""
    modulus, sphere = KELVIN.indentation_modulus, SPHERE.radius

    def excess(a):
        return 4 * modulus / (3 * sphere) * a**3 * (1 - np.square(wave_number * a) / 5) / LOAD - 1

    top = np.sqrt(3) / wave_number  # where the load of the series is greatest
    return brentq(excess, 0.5 * CONTACT, top) if excess(top) > 0 else nan


def wave_friction(wave_number: float) -> float:
    """Slow friction of one wave over that of the sphere, under LOAD."""
    a = wave_radius(wave_number)
    square = np.square(wave_number * a)
    return (a / CONTACT) ** 3 * (1 - 2 * square / 5 + square**2 / 21)


def _moment(wave_number):
    """Contact radius from the second moment of one wave's pressure over that of the sphere, under LOAD.

    From p = (E*/pi) int_r^a g'/sqrt(x^2 - r^2) dx the moment is (2 E*/3) int_0^a 2 x^3 g' dx.
    """
    a = wave_radius(wave_number)
    square = np.square(wave_number * a)
    return a / CONTACT * np.sqrt((1 - 5 * square / 21) / (1 - square / 5))


def _repeats(row):
    return "contact_fraction" in row.measures


def _less(of, factor):
    """A number over what the shape of the wave makes of it in a cell."""

    def less(row, fields):
        return of(row, fields) / (factor(2 * pi / row.settings["extent"]) if _repeats(row) else 1.0)

    return less


RADIUS = Quantity("radius", "contact radius", contact_radius, "as it is")
SHAPED_RADIUS = Quantity("radius_less_shape", RADIUS.label, _less(contact_radius, _moment), LESS_SHAPE)
SLOW = replace(FRICTION, by="as it is")
SHAPED_SLOW = Quantity("friction_less_shape", FRICTION.label, _less(FRICTION.of, wave_friction), LESS_SHAPE)


def _wrapped(offset, period):
    return offset - period * np.round(offset / period)


def _at_rest(size):
    known = Known(CONTACT)
    truth = closed_form("Hertz", {RADIUS.name: known, SHAPED_RADIUS.name: known})
    ladders = _ladders(Indent(load=LOAD), size, ("x", "y", "pressure"))
    return Convergence("rest", "tip at rest", truth, (RADIUS, SHAPED_RADIUS), ladders)


def _sliding(flow, size):
    motion = Slide(speed=flow * CONTACT / TIME, load=LOAD)
    reference = BEM(points=at(REFERENCE, size), tolerance=1e-7)
    truth = finer(Scene(SPHERE, KELVIN, motion), reference, "the free sphere, {} points")
    quantities = (SLOW, SHAPED_SLOW) if flow <= FLOWS["quick"][0] else (FRICTION,)
    name, title = f"sliding-{flow:g}", f"tip, Kelvin, v τ = {flow:g} a"
    return Convergence(name, title, truth, quantities, _ladders(motion, size, ()))


def _ladders(motion, size, keeps):
    periods, extents, across = at(PERIODS, size), at(EXTENTS, size), at(ACROSS, size)
    free = Scene(SPHERE, KELVIN, motion)

    def repeating(period):
        return TimedSolve.of(BEM(points=across * period), cell(period, motion), keeps)

    def window(over):
        return TimedSolve.of(BEM(points=round(across * over), extent=2 * CONTACT * over), free, keeps)

    return (
        Ladder.over("cell that repeats, by period over 2 a", "period over 2 a", periods, repeating),
        Ladder.over("free, by extent over 2 a", "extent over 2 a", extents, window),
        Ladder.of(
            "free, extent fitted, by points", free, BEM(), "points", (across, 2 * across, 4 * across), keeps=keeps
        ),
    )


def shape(found: Mapping[str, list[MeasuredLadder]]) -> Iterator:
    """Errors of free windows, and the share of those of a cell that is left without the wave's shape."""
    for own in found.values():
        first = own[0].quantity
        for each in own:
            if each.ladder.startswith("free, by extent") and each.quantity == first:
                spread = float(np.nanmax(each.errors)) if np.isfinite(each.errors).any() else nan
                sentence = "Largest error of a free window of any extent that holds the contact"
                yield reported("extent.free", sentence, spread, each.title, missing=each.unsolved)
        cells = [each for each in own if each.ladder.startswith("cell")]
        for less in cells[1:]:
            left = less.errors / cells[0].errors
            value = float(np.nanmax(left)) if np.isfinite(left).any() else nan
            sentence = "Share of the error of a cell that is left without the wave's shape, largest"
            yield reported("extent.shape", sentence, value, less.title, missing=cells[0].unsolved)
