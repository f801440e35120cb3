"""Contacts known without a numerical solver: closed forms and quadratures, each with its equation and source.

solver : `Exact`, the smooth contact at rest behind the protocol of a solver
slow : friction in the limit of low speed
foundation : steady sliding on a one-dimensional foundation
indentation : a body of revolution pressed into a viscoelastic solid and withdrawn
line_contact : steady sliding of a cylinder on a standard linear solid
layer : a body of revolution pressed into an elastic layer on a rigid base
tangential : a contact pressed, then drawn along the surface against friction
waves : elastic contact of a single wave and of two crossed waves
full_contact : pressure and friction of a rough plane that touches everywhere

Units are SI. Moduli are E* = E/(1 - nu^2) unless a solid is passed. The elastomer flows along +x, pressure is
positive, friction opposes the motion.
"""

from .slow import (
    edge_slope,
    loss_exponent,
    mean_lag,
    slow_friction_1d,
    slow_friction_3d,
    slow_friction_by_curvature,
    slow_friction_by_slope,
)
from .solver import Exact

__all__ = [
    "Exact",
    "edge_slope",
    "loss_exponent",
    "mean_lag",
    "slow_friction_1d",
    "slow_friction_3d",
    "slow_friction_by_curvature",
    "slow_friction_by_slope",
]
