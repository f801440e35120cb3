"""Elastic contact of a flat half-space with a wavy surface, pressed by a mean pressure p [Pa].

One wave h = h0 cos(2 pi x / lambda), or two crossed ones h = h0 cos(2 pi x / lambda) cos(2 pi y / lambda).
p* is the mean pressure that closes the contact: the amplitude of that which flattens the wave, E* |q| h0 / 2.
Fractions of p* from 0 to 1, arrays allowed; ValueError outside.
"""

from math import pi, sqrt

import numpy as np

CROSSED_FRACTIONS = {0.1: 0.1912, 0.3: 0.5150, 0.5: 0.7051, 0.7: 0.8403, 0.85: 0.9249, 0.95: 0.9760}
"""Contact fraction of crossed waves by p/p*: pixels in contact of a numerical solution with 512 x 512 a period.

At 0.1 the edges of the pixels hold some 0.0006 of it, at 0.95 some 0.0002.
"""


def wave_closure(modulus, amplitude, wavelength):
    """Pressure p* = pi E* h0 / lambda [Pa] that closes a wave. modulus: E* [Pa]; amplitude, wavelength [m]."""
    return pi * modulus * amplitude / wavelength


def crossed_closure(modulus, amplitude, wavelength):
    """p* = sqrt(2) pi E* h0 / lambda [Pa] of crossed waves."""
    return sqrt(2) * wave_closure(modulus, amplitude, wavelength)


def wave_contact_fraction(fraction):
    """Share 2a/lambda of a period in contact, p/p* = sin^2(pi a / lambda).

    Westergaard, J. Appl. Mech. 6, 49 (1939).
    """
    return 2 / pi * np.arcsin(np.sqrt(checked_fraction(fraction)))


def wave_pressure(fraction, phase):
    """Pressure over its mean at phase = pi x / lambda from a crest: 2 cos t sqrt(sin^2 t_a - sin^2 t) / sin^2 t_a.

    Westergaard (1939), with t_a = pi a / lambda; zero outside the contact. At p/p* = 1 it is 1 + cos(2 t).
    """
    fraction = checked_fraction(fraction)
    if not np.all(fraction > 0):
        raise ValueError("without load there is no mean pressure to refer to")
    t = np.mod(np.asarray(phase, float) + pi / 2, pi) - pi / 2
    room = np.maximum(fraction - np.sin(t) ** 2, 0.0)
    return 2 * np.cos(t) * np.sqrt(room) / fraction


def wave_mean_gap(fraction):
    """Mean gap over h0: 1 - P + P ln P with P = p/p*, falling from 1 to 0.

    The mean gap is h0 less the rise of the crest over the mean surface. A little more load acts as a row of flat
    punches, of pressure cos t / sqrt(sin^2 t_a - sin^2 t), under which -(2/(pi E*)) int ln|2 sin t| dp dx is
    -(2 lambda/(pi E*)) ln(sin t_a) = -(h0/p*) ln P; its integral over P is P - P ln P.
    """
    fraction = checked_fraction(fraction)
    return 1 - fraction + fraction * np.log(np.where(fraction > 0, fraction, 1.0))


def checked_fraction(fraction):
    """An array of fractions, ValueError outside 0 to 1."""
    fraction = np.asarray(fraction, float)
    if not np.all((fraction >= 0) & (fraction <= 1)):
        raise ValueError(f"a fraction of {fraction} must lie from 0 to 1")
    return fraction[()]
