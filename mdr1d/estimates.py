"""Side remarks of Popov et al., Sci. Rep. 4, 3750 (2014): heating, the depth that governs a contact, the layer.

Arguments are numbers in SI, quantities with units, or arrays of either that broadcast. Indenters are g = c |x|^n
as mapped, c [m^(1-n)] and n from 1 to 100: 1/R and 2 for a sphere. A number out of its range raises ValueError,
which names it.
"""

from typing import Literal

import numpy as np

from scene.scene import temperature_rise

from .domain import between, in_si, not_negative, one_of, positive

Base = Literal["half-space", "compressible layer", "incompressible layer"]
# Exponent of the stiffness in the contact radius, k ~ a^m.
STIFFENING = {"half-space": 1, "compressible layer": 2, "incompressible layer": 4}


@in_si
def average_heating(friction, modulus, depth, speed, conductivity):
    """Mean temperature rise [K] of the contact, 2 mu G_0 d v / lambda (Methods).

    modulus : static, in shear [Pa]; depth d [m]; conductivity : of the indenter, which takes the heat [W/(m K)]

    The paper's 4e-5 m and 0.06 K "at 100 N" are those of R = 50 mm at 1 N. At 100 N they are 0.92 mm and 1.4 K,
    and 1.16 mm and 1.7 K for R = 25 mm.

    An isothermal disc conducts 4 a lambda, and F_N = 8 G_0 a d n/(n+1): the rise is 2 mu G_0 d v / lambda times
    n/(n+1). The estimate holds for a flat punch; a sphere has 2/3 of it.
    """
    not_negative(friction=friction, depth=depth, speed=speed)
    positive(modulus=modulus, conductivity=conductivity)
    return temperature_rise(friction, modulus, depth, speed, conductivity)


@in_si
def flash_heating(friction, glassy_modulus, rms_height, speed, conductivity):
    """Largest temperature rise [K] in a micro-contact, 2 mu G_inf h_0 v / lambda (Methods).

    The glassy modulus [Pa] and the rms height [m] in place of G_0 and d of `average_heating`.
    """
    positive(glassy_modulus=glassy_modulus)
    not_negative(rms_height=rms_height)
    return average_heating(friction, glassy_modulus, rms_height, speed, conductivity)


@in_si
def radius_at_depth(depth, c, n):
    """a [m] of any linear solid at a depth [m], d = c a^n, as long as no contact radius was ever larger.

    Lee and Radok, J. Appl. Mech. 27, 438 (1960). Not for withdrawal, where a contact is smaller, nor for sliding,
    where it is no longer symmetric: the paper says "any" motion.
    """
    positive(c=c)
    not_negative(depth=depth)
    between(1, 100, n=n)
    return (depth / c) ** (1 / n)


@in_si
def largest_displacement(friction, depth, poisson_ratio=0.5):
    """Tangential displacement [m] at which all of a contact slips, mu d (2-nu) / (2(1-nu)); 1.5 mu d at nu = 1/2.

    Cattaneo and Mindlin's ratio of normal and tangential stiffness, the same for every contact radius.
    """
    not_negative(friction=friction, depth=depth)
    between(-1, 0.5, poisson_ratio=poisson_ratio)
    return friction * depth * (2 - poisson_ratio) / (2 * (1 - poisson_ratio))


@in_si
def partial_slip_force(displacement, friction, load, depth, n, poisson_ratio=0.5):
    """Tangential force [N] at a displacement u [m] under a held load [N], mu (F_a - F_c), c the stick disc.

    F ~ d^((n+1)/n), and the stick disc is the contact at the depth d_c = d (1 - u/u_max): for a sphere
    mu F_N [1 - (1 - u/u_max)^(3/2)], Mindlin, J. Appl. Mech. 16, 259 (1949). Beyond u_max all slips, mu F_N.
    """
    not_negative(displacement=displacement)
    positive(friction=friction, load=load, depth=depth)
    between(1, 100, n=n)
    stuck = np.maximum(1 - displacement / largest_displacement(friction, depth, poisson_ratio), 0.0)
    return friction * load * (1 - stuck ** ((n + 1) / n))


@in_si
def layer_force(modulus, thickness, c, n):
    """F* [N] at which 2a of a half-space is the thickness D [m] of the layer, [8 n/(n+1)] G_0 c (D/2)^(n+1).

    (2/3) G_0 D^3 / R for a sphere. With G_0 = 3 MPa it is 40 N for D = 10 mm and R = 50 mm alone; the
    paper's other values, 5 mm and 25 mm, give 10 N together.
    """
    positive(modulus=modulus, thickness=thickness, c=c)
    between(1, 100, n=n)
    return 8 * n / (n + 1) * modulus * c * (thickness / 2) ** (n + 1)


@in_si
def stiffness_exponent(n, base: Base):
    """d ln k / d ln F, k = dF/dd, far below F* ("half-space") and far above it (a layer bonded to a rigid base).

    k ~ a^m and d ~ a^n make it m/(n+m), with m = 1, 2 and 4: a thin layer is a bed of springs, p ~ d - f, or if
    incompressible a film that is squeezed out, div grad p ~ f - d. For a sphere 1/3, 1/2 and 2/3; the paper's 1/2
    holds for a compressible layer; an incompressible one passes it on the way from 1/3 to 2/3.
    """
    between(1, 100, n=n)
    one_of(STIFFENING, base=base)
    return STIFFENING[base] / (n + STIFFENING[base])
