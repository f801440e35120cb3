"""Error of friction that the grid leaves: a bound of 95 %, from every second, third and fourth node."""

from math import inf

from .indentation import Sweep
from .profile import Profile
from .steady import Contact

# Nodes that are left: each k-th. An error of second order changes by k^2 - 1 times itself; where the edges of a
# contact lie between the nodes makes more or less of it, and the most is taken.
STEPS = 2, 3, 4
# Bound over that: as far as 95 % of random contacts asked for, see docs/results/accuracy.md.
SHARE = 2.0
# Nodes on the shortest wave below which it is more, and by which power of them.
RESOLVED, POWER = 6.0, 0.7
ROUNDING = 1e-9  # left where nothing changes: a load is met to a tenth of it


def friction_error(body: Profile, approach: float, contact: Contact, sweep: Sweep, load: bool) -> float | None:
    """Bound of 95 % on the relative error of friction by the grid; None without friction.

    approach : of the contact past its first touch [m]
    load : whether the load is prescribed, and so kept on fewer nodes, to first order in the depth

    The error is that against the same line on ever finer grids. No other contact is sought: a sweep along fewer
    nodes, or two of them, at a depth that is known.
    """
    if not contact.dissipation:
        return None
    found = contact.dissipation / contact.force
    change = max(
        abs(_on_fewer(body, approach, contact, sweep, load, step) / found - 1) / (step**2 - 1) for step in STEPS
    )
    waves = inf if body.surface is None else body.surface.shortest / body.pixel
    return SHARE * max(1.0, RESOLVED / waves) ** POWER * change + ROUNDING


def _on_fewer(body, approach, contact, sweep, load, step):
    """Friction coefficient on every `step`-th node, the tip among them; 0 where none of them touches."""
    middle = len(body.heights) // 2
    heights = body.heights[middle % step :: step] - body.lowest
    found = sweep(heights, step * body.pixel, approach)
    if load and found.force and found.stiffness:
        found = sweep(heights, step * body.pixel, approach + (contact.force - found.force) / found.stiffness)
    return found.dissipation / found.force if found.force else 0.0
