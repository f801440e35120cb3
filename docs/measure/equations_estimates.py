"""The side remarks of the paper, recalculated and checked: a part of docs/measure/equations.py."""

from itertools import pairwise
from math import log, sqrt

import numpy as np
from tables import table

from compare.models.exact.indentation import force_of_depth
from mdr1d import MDR, estimates
from mdr1d import equations as eq
from scene import Elastic, Indent, Kelvin, Scene, Slide, Sphere, StandardLinearSolid

# The paper's experiment: static, glassy modulus [Pa], mu, speed [m/s], conductivity [W/(m K)], rms height [m].
G0, GLASSY, MU, SPEED, CONDUCTIVITY, HEIGHT = 3e6, 1.5e9, 0.5, 1e-2, 20.0, 1e-7
# Sphere on a bonded incompressible layer: a over the thickness, a over sqrt(R d), load over Hertz's at that depth.
LAYER = ((0.2, 1.08065, 1.26977), (0.5, 1.19845, 1.85712), (1.0, 1.33700, 3.37110), (2.0, 1.4827, 8.4680))


def heating() -> str:
    """Depth and temperatures of the experiment."""

    def rows():
        for load in (1.0, 100.0):
            for radius in (25e-3, 50e-3):
                depth = eq.indentation_depth(load, G0, 1 / radius, 2)
                average = estimates.average_heating(MU, G0, depth, SPEED, CONDUCTIVITY)
                conducted = MU * load * SPEED / (4 * sqrt(radius * depth) * CONDUCTIVITY)
                yield (
                    f"{load:g}",
                    f"{radius * 1e3:g}",
                    f"{depth * 1e3:.4f}",
                    f"{average:.3f}",
                    f"{conducted:.3f}",
                    f"{estimates.flash_heating(MU, GLASSY, HEIGHT, SPEED, CONDUCTIVITY):.3f}",
                )

    header = "F_N, N|R, mm|d, mm|2 μ G₀ d v/λ, K|isothermal disc, K|2 μ G∞ h₀ v/λ, K"
    return table(header, rows())


def depth_argument() -> str:
    """Contact radius at a depth, in whichever motion, over that of the elastic solid."""
    shape = Sphere(1e-2)
    solid = StandardLinearSolid(1e6, 5e6, 1.0)
    times, depths = (0.0, 1.0, 1.2, 3.0), (0.0, 1e-4, 1e-4, 0.0)

    def rows():
        for motion, at in (("pressed in", (0.3, 1.0)), ("held", (1.2,)), ("withdrawn", (1.3, 1.5))):
            for t in at:
                _, radius = force_of_depth(shape, solid, times, depths, t)
                depth = np.interp(t, times, depths)
                elastic = estimates.radius_at_depth(depth, 1 / shape.radius, 2)
                yield motion, f"t = {t:g} τ", f"{depth * 1e3:.4f}", f"{radius[0] / elastic:.4f}"
        elastic = estimates.radius_at_depth(1e-4, 1 / shape.radius, 2)
        for memory in (0.01, 0.1, 1.0, 10.0):
            scene = Scene(shape, Kelvin(1e6, 1e-3), Slide(speed=memory * elastic / 1e-3, depth=1e-4))
            length = MDR().solve(scene).measures["contact_length"]
            yield "sliding, 1D", f"v τ/a = {memory:g}", "0.1000", f"{length / (2 * elastic):.4f}"

    return table("motion|at|depth, mm|contact over that of the elastic solid", rows())


def tangential() -> str:
    """Partial slip of a sphere: springs of the MDR, released one by one, against the closed form."""
    shape, load, friction = Sphere(1e-2), 1.0, 0.5

    def rows():
        for poisson in (0.0, 0.3, 0.5):
            elastic = Elastic(modulus=1e6, poisson_ratio=poisson)
            result = MDR(points=20000).solve(Scene(shape, elastic, Indent(load=load)))
            largest = estimates.largest_displacement(friction, result.depth, poisson)
            pressed = elastic.indentation_modulus * np.where(
                result.fields["contact"], result.fields["displacement"], 0.0
            )
            stiffness = 4 * 1e6 / (2 - poisson)
            cells = []
            for share in (0.1, 0.5, 0.9, 1.5):
                springs = np.minimum(stiffness * share * largest, friction * pressed)
                found = springs.sum() * result.measures["pixel"]
                closed = estimates.partial_slip_force(share * largest, friction, load, result.depth, 2, poisson)
                cells.append(f"{found / closed - 1:+.1e}")
            yield f"{poisson:g}", f"{largest / (friction * result.depth):.4f}", *cells

    return table("ν|u_max/(μ d)|" + "|".join(f"u/u_max = {share:g}" for share in (0.1, 0.5, 0.9, 1.5)), rows())


def layer_forces() -> str:
    """F* of the pairs that the paper names."""

    def rows():
        for thickness in (5e-3, 10e-3):
            for radius in (25e-3, 50e-3):
                force = estimates.layer_force(G0, thickness, 1 / radius, 2)
                width = 2 * eq.contact_radius(force, G0, 1 / radius, 2)
                yield f"{thickness * 1e3:g}", f"{radius * 1e3:g}", f"{force:.4g}", f"{width / thickness:.6f}"

    return table("D, mm|R, mm|F*, N|2a/D of the half-space", rows())


def stiffness() -> str:
    """Exponent of the stiffness between the loads of the known solutions on a bonded incompressible layer."""

    def rows():
        # R d / D^2, and the load up to a factor.
        points = [(share, (share / s) ** 2, ratio * (share / s) ** 3) for share, s, ratio in LAYER]
        for (low, d_low, f_low), (high, d_high, f_high) in pairwise(points):
            growth = log(f_high / f_low) / log(d_high / d_low)
            yield f"{2 * low:g} to {2 * high:g}", f"{growth:.3f}", f"{1 - 1 / growth:.3f}"

    limits = ", ".join(
        f"{base} {estimates.stiffness_exponent(2, base):.3g}"
        for base in ("half-space", "compressible layer", "incompressible layer")
    )
    return table("2a/D|d ln F/d ln d|d ln k/d ln F", rows()) + f"\n\nLimits for a sphere: {limits}."


SECTIONS = {
    "Heating": (
        "G₀ = 3 MPa, G∞ = 1.5 GPa, μ = 0.5, v = 10 mm/s, λ = 20 W/(m K), h₀ = 0.1 µm. The paper states 0.04 mm "
        "and 0.06 K at 100 N: they belong to R = 50 mm at 1 N. The heat μ F_N v into an isothermal disc as large "
        "as the contact raises it by μ F_N v/(4 a λ), which is n/(n+1) of the estimate: 2/3 for a sphere.",
        heating,
    ),
    "The depth governs the contact": (
        "A sphere on a standard linear solid (glassy over rubbery modulus 5) that is pressed in within τ, held "
        "for 0.2 τ and withdrawn (Ting's solution), and a Kelvin sphere that slides at a held depth. Lee and "
        "Radok's statement holds while the contact grows or stays, not for withdrawal and not for sliding.",
        depth_argument,
    ),
    "Largest tangential displacement": (
        "Elements of tangential stiffness 4G/(2-ν) per length under the simulated contact at rest, each held by "
        "μ times its load: their sum over Cattaneo and Mindlin's closed form, less one.",
        tangential,
    ),
    "The force at which the layer is felt": ("G₀ = 3 MPa. The paper's 40 N are those of one pair.", layer_forces),
    "Stiffness of the layer": (
        "A sphere on a bonded incompressible layer, between four known solutions. Around 2a = D the exponent has "
        "left 1/3, and between D and 2D it passes 1/2 on its way to 2/3: an observed 1/2 does not say that the "
        "layer is compressible.",
        stiffness,
    ),
}
