"""Elastic contacts that are pressed, then drawn along the surface against Coulomb friction, and slip in part.

By Cattaneo and Mindlin tractions point along the pull, and so does the slip: exact at nu = 0 and for lines, good
otherwise. Then the superposition of Jaeger and Ciavarella holds for any shape, smooth or rough: tractions are mu
times the pressure, less mu times the pressure that the same body has at a smaller load F_c. With E* = 2G/(1-nu)
and G* = 4G/(2-nu)

    F_x = mu (F_N - F_c),   u = mu (E*/G*) (d - d_c).

Fractions are of F_x over mu F_N, and of u over that at which all slips; ValueError outside 0 to 1. Jaeger, Arch.
Appl. Mech. 65, 478 (1995); Ciavarella, J. Appl. Mech. 65, 998 (1998).
"""

from .waves import checked_fraction


def stiffness_ratio(poisson_ratio):
    """E*/G* = (2 - nu) / (2 (1 - nu)), of a contact's normal to its tangential stiffness; 3/2 at nu = 1/2.

    Mindlin, J. Appl. Mech. 16, 259 (1949).
    """
    return (2 - poisson_ratio) / (2 * (1 - poisson_ratio))


def full_slip_displacement(friction, depth, poisson_ratio):
    """u [m] at which a body pressed in by a depth [m] from first touch slips everywhere, mu (E*/G*) d."""
    return friction * stiffness_ratio(poisson_ratio) * depth


def force(displacement, exponent=2.0):
    """F_x/(mu F_N) by u/u_max, of a body z = c r^n: 1 - (1 - u/u_max)^((n+1)/n), as F ~ d^((n+1)/n).

    Sphere, n = 2: Cattaneo, Rend. Accad. Naz. Lincei 27, 342 (1938), and Mindlin (1949).

    >>> round(float(force(0.5)), 4)
    0.6464
    """
    return 1 - (1 - checked_fraction(displacement)) ** ((exponent + 1) / exponent)
