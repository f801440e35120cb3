"""Laws of the one-dimensional contact over scenes drawn at random: signs, work, symmetry, scale."""

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, reject
from hypothesis import strategies as st
from strategies import bodies, decades, evenly, examples, rescaled, solids, units

from mdr1d import MDR, Contact, modes_of, sweep, sweep_modes
from scene import (
    Elastic,
    EmptyContact,
)

# Sums of some thousand terms in double precision; in units of what is summed, before it cancels.
ROUNDING = 1e-11
# Relative misfit of a load that counts as met, and its effect on a depth.
MET = 1e-10
SOLVER = MDR(points=600)


class Line(NamedTuple):
    """A profile with walls that nothing touches at either end, above its lowest point at zero, and a depth."""

    heights: np.ndarray
    pixel: float
    depth: float

    @property
    def steepest(self):
        return np.abs(np.diff(self.heights)).max() / self.pixel


@st.composite
def lines(draw):
    """Rough bowls of 40 to 140 nodes and half-width 1, from full contact to a few peaks."""
    half = draw(st.integers(20, 70))
    x = np.arange(-half, half + 1) / half
    rng = np.random.default_rng(draw(st.integers(0, 100)))
    heights = np.abs(x) ** draw(evenly(1, 4)) + draw(evenly(0, 1)) * rng.standard_normal(x.size)
    heights -= heights.min()
    depth = float(heights.max()) * draw(evenly(0.01, 1.2))
    heights[[0, -1]] = 3 * depth
    return Line(heights, 1 / half, depth)


def flowed(line: Line, solid, speed) -> Contact:
    modes = modes_of(solid)
    if speed == 0 or modes.moduli.size + modes.compliances.size == 0:
        return sweep(line.heights, line.pixel, 0.0, line.depth)
    return sweep_modes(line.heights, line.pixel, modes, speed, line.depth)


SPEEDS = decades(-6, 6)


@examples(100)
@given(lines(), solids, SPEEDS)
def test_contact_neither_penetrates_nor_pulls_and_pushes_only_where_it_touches(line, solid, speed):
    """w >= 0, gap >= 0, p >= 0 and p * gap = 0, to rounding of the sums along the line."""
    contact = flowed(line, solid, speed)
    clearance = contact.displacement - (line.depth - line.heights)
    assert np.all(contact.displacement >= 0)
    assert np.all(clearance >= -ROUNDING * line.depth)
    assert np.all(np.abs(clearance[contact.touching]) <= ROUNDING * line.depth)
    length, push = contact.pushed.T
    assert np.all(push >= -ROUNDING * push.max())
    assert np.all(push[length == 0] == 0)
    assert abs(push.sum() - contact.force) <= ROUNDING * push.sum()
    assert abs(length.sum() - contact.length) <= ROUNDING * contact.length
    assert np.all(length <= line.pixel * (1 + ROUNDING))
    # Intervals between two nodes that touch are touched throughout.
    whole = contact.touching[:-1] & contact.touching[1:]
    assert np.allclose(length[whole], line.pixel, rtol=ROUNDING)
    ends = np.array([contact.first, contact.last])
    assert np.all(np.abs(ends / line.pixel - np.flatnonzero(length)[[0, -1]] - 0.5) <= 0.5 + 1e-9)
    assert contact.length <= np.diff(ends)[0] * (1 + ROUNDING) + ROUNDING * line.pixel


@examples(75)
@given(lines(), solids, SPEEDS, decades(-9, 0.2))
def test_a_deeper_contact_carries_more(line, solid, speed, more):
    """The force is convex in the depth and lies between its tangents at both, to rounding of the sums."""
    deeper = line._replace(depth=line.depth * (1 + more))
    shallow, deep = flowed(line, solid, speed), flowed(deeper, solid, speed)
    rounding = ROUNDING * deep.force
    assert deep.force >= shallow.force - rounding
    run, rise = deeper.depth - line.depth, deep.force - shallow.force
    assert shallow.stiffness * run <= rise * (1 + ROUNDING) + rounding
    assert rise <= deep.stiffness * run * (1 + ROUNDING) + rounding
    assert np.all(deep.displacement >= shallow.displacement - ROUNDING * deeper.depth)


@examples(100)
@given(lines(), solids, SPEEDS)
def test_friction_by_traction_is_the_energy_lost_and_never_negative(line, solid, speed):
    """-int g' f dx = what is lost per length slid >= 0. Traction cancels to rounding of the steepest slope times
    the force."""
    contact = flowed(line, solid, speed)
    assert contact.dissipation >= 0
    assert contact.traction == pytest.approx(
        contact.dissipation, rel=1e-9, abs=ROUNDING * line.steepest * contact.force
    )


@examples(60)
@given(lines(), solids, SPEEDS, st.integers(1, 50), st.integers(0, 50))
def test_a_profile_moved_by_whole_pixels_has_the_same_contact(line, solid, speed, before, behind):
    """The elastomer comes undisturbed from wherever: what is not touched ahead or behind changes no bit."""
    wall = line.heights[0]
    moved = line._replace(heights=np.pad(line.heights, (before, behind), constant_values=wall))
    here, there = flowed(line, solid, speed), flowed(moved, solid, speed)
    for name in ("force", "dissipation", "traction", "length", "slope_square"):
        assert getattr(there, name) == getattr(here, name), name
    stop = before + len(line.heights)
    np.testing.assert_array_equal(there.displacement[before:stop], here.displacement)
    np.testing.assert_array_equal(there.pushed[before : stop - 1], here.pushed)


def against_the_flow(line: Line, memory):
    """u at the nodes of a Kelvin foundation that flows along -x: the least that decays no faster and lies above.

    u(x) = max over y >= x of (d - g(y)) exp(-(y - x)/l), the maximum over each interval in closed form.
    """
    approach = line.depth - line.heights
    u = np.maximum(approach, 0.0)
    for i in range(len(u) - 2, -1, -1):
        slope = (approach[i + 1] - approach[i]) / line.pixel
        # (c + s t) exp(-t/l) has its maximum at t = l - c/s.
        t = memory - approach[i] / slope if slope > 0 else -1.0
        inside = slope * memory * np.exp(-t / memory) if 0 < t < line.pixel else 0.0
        u[i] = max(u[i], u[i + 1] * np.exp(-line.pixel / memory), inside)
    return u


@examples(75)
@given(lines(), SPEEDS)
def test_the_mirrored_profile_slid_the_other_way_has_the_mirrored_answer(line, memory):
    """Against a solve of the other direction from the principle of the least displacement, to rounding."""
    mirrored = line._replace(heights=line.heights[::-1].copy())
    forth = sweep(mirrored.heights, line.pixel, memory, line.depth)
    back = against_the_flow(line, memory)
    np.testing.assert_allclose(forth.displacement[::-1], back, rtol=0, atol=ROUNDING * line.depth)


def solved(scene):
    """The answer; a depth that does not reach the peaks is no example."""
    try:
        return SOLVER.solve(scene)
    except EmptyContact:
        reject()


@examples(75)
@given(bodies(), units())
def test_every_answer_has_forces_of_the_right_sign_and_the_load_asked_for(scene, unit):
    """F_N > 0, F_x >= 0, zero for an elastic solid or at rest, by a line force >= 0; the load met to 1e-10."""
    result = solved(rescaled(scene, **unit))
    assert np.isfinite([result.normal_force, result.friction_force, result.depth]).all()
    assert not np.isnan(list(result.measures.values())).any()
    assert result.normal_force > 0
    assert result.friction_force >= 0
    force, pixel = result.fields["line_force"], result.measures["pixel"]
    slopes = np.diff(result.fields["profile"]) / pixel
    assert np.all(force >= -ROUNDING * force.max())
    assert force.sum() * pixel == pytest.approx(result.normal_force, rel=ROUNDING)
    steep = np.abs(slopes).max() * result.normal_force
    assert -(slopes @ force[:-1]) * pixel == pytest.approx(result.friction_force, rel=1e-9, abs=ROUNDING * steep)
    if isinstance(scene.elastomer, Elastic) or scene.motion.speed == 0:
        assert result.friction_force == 0
    assert result.residual <= MET
