"""Solvers of the hard cases: functions of a size, with settings of a case's own."""

from bem3d import BEM
from mdr1d import MDR

from .hardcase import Size
from .ordinary import RADIUS

TOLERANCE = 1e-7  # of contact in three dimensions, where a law is finer than its default


def line(size: Size, **settings) -> MDR:
    """The one-dimensional solver."""
    return MDR(**{"points": size.line} | settings)


def space(size: Size, **settings) -> BEM:
    """The three-dimensional solver, around the ordinary contact."""
    return BEM(**{"points": size.square, "extent": 3.2 * RADIUS, "tolerance": TOLERANCE} | settings)


def dense(size: Size, **settings) -> BEM:
    """The three-dimensional solver on a grid whose conditions can be computed anew."""
    return space(size, **{"points": size.dense} | settings)


def row(size: Size, **settings) -> BEM:
    """The three-dimensional solver along a single row of pixels."""
    return BEM(**{"points": size.row} | settings)


def square(size: Size, **settings) -> BEM:
    """The three-dimensional solver with its own extent and tolerance."""
    return BEM(**{"points": size.square} | settings)
