"""Laws of the three-dimensional contact over heights drawn at random: symmetry, energy, reciprocity."""

from functools import partial
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from maps import noise
from strategies import (
    decades,
    elastic,
    evenly,
    examples,
    solids,
    speeds,
    viscoelastic,
)

from bem3d.contact import activeset as contact
from bem3d.grid import Grid
from bem3d.motion.steady import Flow
from bem3d.response.engine import Engine
from bem3d.response.halfspace import Cell, HalfSpace

POINTS = 32
# Conditions of contact are solved to this, over the depth of the lowest point.
TOLERANCE = 1e-9
ROUNDING = 1e-12


class Pressed(NamedTuple):
    """Heights [pixel] (N, N), a medium on a grid of unit pixels, and a load, as `contact.solve` takes them."""

    heights: np.ndarray
    medium: Cell | HalfSpace
    load: float

    @property
    def grid(self):
        return Grid(len(self.heights), float(len(self.heights)))

    def solved(self):
        start = contact.first_guess(self.heights, self.heights.size // 4)
        return contact.solve(
            self.medium.operator(self.grid),
            self.heights,
            start / np.sqrt(np.count_nonzero(start)),
            TOLERANCE,
            load=self.load,
            precondition=self.medium.preconditioner(self.grid),
            foundation=self.medium.foundation(self.grid),
            symmetric=self.medium.flow.at_rest,
        )


def waves(seed):
    """A random surface (POINTS, POINTS) that repeats, of rms slope about 1 and waves of 4 pixels and more."""
    k = np.hypot(*np.meshgrid(*2 * [np.fft.fftfreq(POINTS, 1 / POINTS)], indexing="ij"))
    amplitude = np.where((k > 0) & (k <= POINTS / 4), 1 / np.maximum(k, 1) ** 1.8, 0.0)
    heights = np.fft.ifft2(amplitude * np.fft.fft2(noise((POINTS, POINTS), seed))).real
    return heights / np.std(np.diff(heights, axis=1))


@st.composite
def presses(draw, elastomers=solids, media=(Cell, HalfSpace)):
    """Rough cells, or rough bowls on a half-space, from a few peaks to full contact. Memories over all decades."""
    flow = Flow.of(draw(elastomers), draw(speeds) * POINTS)
    heights = draw(evenly(0, 1)) * waves(draw(st.integers(0, 100)))
    if draw(st.sampled_from(media)) is Cell:
        heights = heights + 1e-3 * waves(0)
        return Pressed(heights, Cell(flow, Engine()), POINTS**2 * draw(decades(-2.5, 0.5)) * np.ptp(heights) / 8)
    along = np.arange(POINTS) - (POINTS - 1) / 2
    heights = heights / 4 + (along[:, None] ** 2 + along**2) / (2 * POINTS)
    return Pressed(heights, HalfSpace(flow, Engine()), POINTS * draw(decades(-1, 1)))


# Pressures follow gaps by the stiffest wave of the grid, pi/2 a pixel: they are known to the tolerance of the gap
# times the depth in pixels, and as far as that leaves the set of contact open.
ALIKE = 1e-6


def moved(pressed, *moves):
    """A surface that is moved has the pressure moved as far, but for what the tolerance of a solve leaves open."""
    here = pressed.solved()
    for move in moves:
        there = pressed._replace(heights=np.ascontiguousarray(move(pressed.heights))).solved()
        assert there.depth == pytest.approx(here.depth, abs=ALIKE * np.ptp(pressed.heights))
        np.testing.assert_allclose(there.pressure, move(here.pressure), rtol=0, atol=ALIKE * here.pressure.max())


@examples(12)
@given(presses(media=(Cell,)), st.tuples(st.integers(0, POINTS), st.integers(0, POINTS)))
def test_a_repeated_surface_moved_by_whole_pixels_has_the_pressure_moved_as_far(pressed, by):
    """At rest and in any flow: a cell has no origin."""
    moved(pressed, partial(np.roll, shift=by, axis=(0, 1)))


@examples(12)
@given(presses(elastomers=elastic()))
def test_at_rest_no_direction_is_special(pressed):
    """Turned by 90 degrees and mirrored, the surface has its pressure turned and mirrored."""
    moved(pressed, np.transpose, np.rot90, np.fliplr, np.flipud)


@examples(12)
@given(presses(elastomers=viscoelastic()))
def test_a_pressure_never_gains_energy_from_the_flow(pressed):
    """sum p dw/dx, the energy lost per length slid, of the pressure of a contact and of any other.

    It is the sum of the loss compliance over the spectrum: >= 0, but for rounding of the sum of its terms.
    """
    for p in (pressed.solved().pressure, noise(pressed.heights.shape)):
        (loss, _), (scale, _) = (pressed.medium.lost(pressed.grid, of) for of in (p, np.abs(p)))
        assert loss >= -ROUNDING * scale


@examples(12)
@given(presses(elastomers=viscoelastic()))
def test_of_a_flow_and_its_reverse_each_is_the_adjoint_of_the_other(pressed):
    """Reciprocity, to rounding: <q, A p> in a flow equals <p, A q> in the reverse flow."""
    operator = pressed.medium.operator(pressed.grid)
    p, q = noise((2, *pressed.heights.shape), 1)
    there = operator(np.ascontiguousarray(q[:, ::-1]))[:, ::-1]
    scale = np.linalg.norm(q) * np.linalg.norm(operator(p))
    assert np.sum(q * operator(p)) == pytest.approx(np.sum(p * there), abs=ROUNDING * scale)
