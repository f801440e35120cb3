"""Pressing a profile into the foundation, by a depth or with a load."""

from collections.abc import Callable
from math import ceil, inf, isfinite

import numpy as np

from scene import EmptyContact, Scene, SolveError
from scene.scales import elastic_contact

from .element import compiled
from .profile import Profile, contact_extent, greatest_depth
from .steady import Contact

# Heights [m] at the nodes, pixel [m] and depth [m] to the contact.
Sweep = Callable[[np.ndarray, float, float], Contact]

# Relative misfit of the load: where Newton stops, and what is still an answer.
AIM, ACCEPTED = 1e-13, 1e-10
_MOST_SWEEPS = 200


def at_depth(scene: Scene, body: Profile, sweep: Sweep) -> tuple[float, Contact, int]:
    """Press the profile in to the scene's depth.

    sweep : of the foundation that flows past

    Returns the approach past the first touch [m], the contact and the number of sweeps. Raises SolveError if the
    contact leaves the grid or there is none.
    """
    depth = scene.motion.greatest
    if depth > body.rim:
        raise _too_short(scene, body)
    # Heights from the first touch on: a light contact keeps its digits.
    if not depth > body.lowest:
        raise EmptyContact(
            f"motion.depth = {depth:g} does not press the indenter in: its lowest point lies at {body.lowest:g} m "
            "above the macroscopic tip; a greater depth is needed, or a load"
        )
    contact = sweep(body.heights - body.lowest, body.pixel, depth - body.lowest)
    _check_range(contact)
    return depth - body.lowest, contact, 1


def under_load(scene: Scene, body: Profile, sweep: Sweep) -> tuple[float, Contact, int]:
    """Press the profile in with the scene's load; arguments and returns as in at_depth.

    The force is a convex, increasing function of the approach while contact stays off the ends of the grid, and
    zero at the first touch. The search is Newton's for its logarithm, exact for a power, between the approaches
    known to carry less and more than the load, and halves that bracket where a step leaves it. Raises SolveError
    if the contact leaves the grid or the load is not met to a relative 1e-10.
    """
    load = scene.motion.greatest / scene.solid.indentation_modulus
    heights = body.heights - body.lowest
    most = body.rim - body.lowest
    if most <= 0:
        raise _too_short(scene, body)
    # A depth far below the heights of roughness may be lost to rounding.
    surely = max(greatest_depth(scene, body.surface) - body.lowest, elastic_contact(scene).depth)
    approach = min(surely, most)
    lower, upper = 0.0, inf
    best: tuple[float, float, Contact | None] = inf, approach, None
    sweeps = 0
    while sweeps < _MOST_SWEEPS and lower < approach < upper:
        contact = sweep(heights, body.pixel, approach)
        sweeps += 1
        if approach >= most and contact.force < load:
            raise _too_short(scene, body)
        misfit = abs(contact.force / load - 1)
        stalled = misfit >= best[0]
        if not stalled:
            best = misfit, approach, contact
        if misfit <= AIM or (stalled and best[0] <= ACCEPTED):
            break
        approach, lower, upper = nearer(approach, contact.force, contact.stiffness, load, lower, upper, most)
    misfit, approach, found = best
    if found is None or not misfit <= ACCEPTED:
        raise SolveError(
            f"motion.load = {scene.motion.greatest:g} is met only to a relative {misfit:.1e} after {sweeps} "
            "sweeps: the lengths of the scene differ by more than rounding allows; prescribe the depth"
        )
    _check_range(found)
    return approach, found, sweeps


@compiled
def nearer(approach, force, stiffness, load, lower, upper, most):
    """Next trial of the approach that carries a load, and its bracket, from the force at the last trial.

    As if the force went on as the power of the approach that it is here: Newton's step for their logarithms. Where
    that leaves the bracket, its middle. most : an approach that is surely enough
    """
    if force < load:
        lower = approach
    else:
        upper = approach
    step = approach * (load / force) ** (force / (approach * stiffness)) if force > 0.0 else inf
    step = min(step, most)
    if not lower < step < upper:
        step = 0.5 * (lower + upper)
    return step, lower, upper


def _check_range(contact: Contact) -> None:
    """Raise ArithmeticError where the squares of slopes, or their forces, have left the range of numbers."""
    if not (contact.force > 0 and isfinite(contact.force + contact.dissipation + contact.traction)):
        raise ArithmeticError("forces beyond the range of numbers")


def _too_short(scene: Scene, body: Profile) -> SolveError:
    extent = contact_extent(scene, body.surface)
    return SolveError(
        f"the contact leaves the grid, whose extent is {body.x[-1] - body.x[0]:g} m: "
        f"extent = {extent:.6g} holds it, with points = {ceil(extent / body.pixel)} on the same pixel"
        + ("" if body.surface is None else f"; the roughness repeats after {body.surface.period:g} m")
    )
