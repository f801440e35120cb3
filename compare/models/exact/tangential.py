"""Elastic contacts that are pressed, then drawn along the surface against Coulomb friction, and slip in part.

By Cattaneo and Mindlin tractions point along the pull, and so does the slip: exact at nu = 0 and for lines, good
otherwise. Then the superposition of Jaeger and Ciavarella holds for any shape, smooth or rough: tractions are mu
times the pressure, less mu times the pressure that the same body has at a smaller load F_c. With E* = 2G/(1-nu)
and G* = 4G/(2-nu)

    F_x = mu (F_N - F_c),   u = mu (E*/G*) (d - d_c).

Fractions are of F_x over mu F_N, and of u over that at which all slips; ValueError outside 0 to 1. Jaeger, Arch.
Appl. Mech. 65, 478 (1995); Ciavarella, J. Appl. Mech. 65, 998 (1998).
"""

import numpy as np

from .waves import wave_mean_gap


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
    return 1 - (1 - _checked(displacement)) ** ((exponent + 1) / exponent)


def displacement(force, exponent=2.0):
    """u/u_max by F_x/(mu F_N): the inverse of `force`."""
    return 1 - (1 - _checked(force)) ** (exponent / (exponent + 1))


def stick_radius(force, exponent=2.0):
    """c/a, radius of what sticks over that of the contact, (1 - F_x/(mu F_N))^(1/(n+1)), as F ~ a^(n+1)."""
    return (1 - _checked(force)) ** (1 / (exponent + 1))


def line_stick_width(force):
    """c/a of a cylinder, (1 - F_x/(mu P))^(1/2), as P ~ a^2. Cattaneo (1938)."""
    return np.sqrt(1 - _checked(force))


def hertz_traction(at, stick):
    """q over mu times the greatest pressure, at r/a of a sphere or x/a of a cylinder: sqrt(1-r^2) - sqrt(c^2-r^2).

    stick : c/a. Zero outside the contact.
    """
    square = np.square(np.asarray(at, float))
    return np.sqrt(np.maximum(1 - square, 0.0)) - np.sqrt(np.maximum(_checked(stick) ** 2 - square, 0.0))


def no_slip_stiffness(modulus, poisson_ratio, radius):
    """dF_x/du = 8 G a / (2 - nu) [N/m] of a disc that sticks everywhere: exact at any nu.

    modulus : shear modulus [Pa]; radius [m]. Mindlin (1949).
    """
    return 8 * modulus * radius / (2 - poisson_ratio)


def no_slip_traction(force, radius, at):
    """q [Pa] = F_x / (2 pi a sqrt(a^2 - r^2)) along x under a disc that sticks everywhere.

    radius : a [m]; at : r < a [m]
    """
    return force / (2 * np.pi * radius * np.sqrt(np.square(radius) - np.square(at)))


def wave_displacement(friction, force, closed, amplitude):
    """u [m] of one wave of amplitude h0 [m] by F_x/(mu F). closed : P, mean pressure over that which closes it.

    In plane strain a traction displaces along x as a pressure does along z, so that u = mu (d - d_c): the mean gap
    at P (1 - F_x/(mu F)) less that at P; counted from the mean of the surface. Ciavarella, Int. J. Solids Struct.
    35, 2363 (1998), with the contact of Westergaard.
    """
    closed = _checked(closed)
    return friction * amplitude * (wave_mean_gap(closed * (1 - _checked(force))) - wave_mean_gap(closed))


def _checked(fraction):
    fraction = np.asarray(fraction, float)
    if not np.all((fraction >= 0) & (fraction <= 1)):
        raise ValueError(f"a fraction of {fraction} must lie from 0 to 1")
    return fraction[()]
