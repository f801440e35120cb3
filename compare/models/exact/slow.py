"""Friction of contacts that slide slowly, to first order in the speed, and the numbers it is made of.

Shapes enter as the MDR image of a body of revolution, g(x) = coefficient * |x|**exponent.
"""

import numpy as np


def mean_lag(elastomer):
    """Lag [s] by which a slowly driven elastomer trails its relaxed answer: sum_k J_k lambda_k / J(infinity).

    The relaxation time of a Kelvin body; retardation less relaxation time of a standard linear solid.

    >>> from scene import StandardLinearSolid
    >>> mean_lag(StandardLinearSolid(rubbery_modulus=1.0, glassy_modulus=4.0, relaxation_time=2.0))
    6.0
    """
    instantaneous, compliances, times = elastomer.retardation()
    return float(compliances @ times / (instantaneous + compliances.sum()))


def slow_friction_3d(speed, radius, lag, indentation_modulus, coefficient, exponent):
    """Friction force [N] of a smooth body of revolution sliding slowly on a viscoelastic half-space.

    F_x -> v tau E* int_0^a g'^2 dx, to first order in v tau / a, with tau the mean lag [s] and the contact radius
    a [m]: mu = v tau / R for a sphere, (pi/2) tan(theta) v tau / a for a cone.
    """
    n = exponent
    # The slope first: of a blunt body neither factor alone is within the range of numbers.
    slope_squared = (n * coefficient * radius ** (n - 1)) ** 2 * radius / (2 * n - 1)
    return speed * lag * indentation_modulus * slope_squared


def slow_friction_1d(speed, radius, lag, indentation_modulus, coefficient, exponent):
    """Friction force [N] of a smooth body sliding slowly in the MDR, Eq. 10.

    F_x -> 4 G tau v int_{-a}^{a} g'^2 dx with 4G = E*. Exactly twice slow_friction_3d.
    """
    return 2 * slow_friction_3d(speed, radius, lag, indentation_modulus, coefficient, exponent)


def slow_friction_by_curvature(speed, lag, load, curvature):
    """Friction force [N] of any contact that slides slowly on a viscoelastic half-space, smooth or rough.

    F_x -> v tau int p d2z/dx2 dA, to first order in the speed v, with the mean lag tau [s] and the pressure p at
    rest: the displacement w = A p trails by tau, so that F_x = -v tau int p d2w/dx2 dA, and in contact w + z is
    constant. Of a body of revolution it is slow_friction_3d.

    load : normal force [N]; curvature : mean of d2z/dx2 weighted with p [1/m], `curvature_by_pressure` of BEM
    """
    return speed * lag * load * curvature


def slow_friction_by_slope(speed, lag, indentation_modulus, rms_slope, length):
    """Friction force [N] of any slowly sliding contact in the MDR, smooth or rough.

    F_x -> E* tau v int g'^2 dx over the real contact, Eq. 10 with 4G = E*.

    rms_slope, length : of the profile over the contact at rest [1], and its length [m];
    `rms_slope_contact` and `contact_length` of MDR at rest
    """
    return speed * lag * indentation_modulus * rms_slope**2 * length


def loss_exponent(elastomer, wave_number, speeds):
    """beta of G'' ~ omega^beta, from the lowest to the highest of some speeds [m/s] at a wave number [rad/m]."""
    slow, fast = min(speeds), max(speeds)
    loss = elastomer.complex_modulus(wave_number * np.array([slow, fast])).imag
    # Rounding may lead beyond the powers that a solid can have.
    return float(np.clip(np.log(loss[1] / loss[0]) / np.log(fast / slow), -1, 1))


def edge_slope(indenter, radius):
    """Slope dz/dr [1] of the body of revolution at a radius [m]: the natural unit of its friction coefficient."""
    return indenter.coefficient * indenter.exponent * radius ** (indenter.exponent - 1)
