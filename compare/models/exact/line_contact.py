"""Line contact: a rigid cylinder z = x^2 / (2R) at rest, or sliding steadily on a standard linear solid.

Hunter, J. Appl. Mech. 28, 611 (1961), rederived for a flow along +x. With the memory m = v tau_c and
the compliance J(t) = (1/E_g) [1 + f (1 - exp(-t/tau_c))], f = E_g/E_r - 1, the surface obeys

    w' + m w'' = (1/E_g) H[q],  q = (1 + f) p + m p',  H[q](x) = -(2/pi) PV int q(s) / (x - s) ds.

In contact w' = -x/R, so that q = (A_0 + A_1 u + A_2 u^2) / sqrt(1 - u^2) with x = centre + l u. Pressure
vanishes at both ends, where kap = l/m and k = (1 + f) kap give one condition in I(k); the surface arrives
undisturbed, one in K(kap).
"""

from dataclasses import dataclass
from math import inf, isinf, pi, sqrt

import numpy as np
from scipy.optimize import brentq
from scipy.special import i0e, i1e, ive, k0e, k1e

MANY = 40.0  # exp(-40): pressure has forgotten
NODES = np.polynomial.legendre.leggauss(64)


def hertz(radius, modulus, line_load):
    """Half-width a [m] and peak pressure p_0 [Pa] of an elastic line contact under a load per length [N/m].

    a^2 = 4 P R / (pi E*), p_0 = 2 P / (pi a); Hertz (1882). p(x) = p_0 sqrt(1 - x^2/a^2).
    """
    _positive(radius=radius, modulus=modulus, line_load=line_load)
    half_width = 2 * sqrt(line_load * radius / (pi * modulus))
    return half_width, 2 * line_load / (pi * half_width)


@dataclass(frozen=True)
class LineContact:
    """A cylinder that slides steadily.

    radius [m], relaxed_modulus [Pa]
    softening : E_r / E_g, 0 of a Kelvin body
    memory : speed times retardation time [m]
    half_width : l [m]
    """

    radius: float
    relaxed_modulus: float
    softening: float
    memory: float
    half_width: float

    @property
    def _ratios(self):
        """kap, k, I1(k)/I0(k), K1(kap)/K0(kap) without overflow; at rest the last three are their limits."""
        kap = self.half_width / self.memory if self.memory else inf
        k = kap / self.softening if self.softening else inf
        i = 1.0 if isinf(k) else float(i1e(k) / i0e(k))
        return kap, k, i, 1.0 if isinf(kap) else float(k1e(kap) / k0e(kap))

    @property
    def _lead(self):
        """I1/I0(k) over its sum with K1/K0(kap): from 1/2 at rest to 0 of the fastest."""
        _, _, i, ratio = self._ratios
        return i / (i + ratio)

    @property
    def _hardening(self):
        """P over pi E_r l^2 / (4R): from 1 at rest to E_g/E_r of the fastest."""
        kap, _, i, _ = self._ratios
        return 1 + (1 - self.softening) * 2 * i * (1 - self._lead) / kap

    @property
    def line_load(self) -> float:
        """P [N/m]."""
        return pi * self.relaxed_modulus * self.half_width**2 / (4 * self.radius) * self._hardening

    @property
    def centre(self) -> float:
        """Middle of the contact [m] from the cylinder's lowest point: upstream, negative."""
        return -self.memory * (1 - self.softening) * self._lead

    @property
    def edges(self) -> tuple[float, float]:
        """Leading and trailing edge of the contact [m] from the cylinder's lowest point."""
        return self.centre - self.half_width, self.centre + self.half_width

    @property
    def friction_coefficient(self) -> float:
        """mu = -int p x dx / (P R), as a sum of positive terms:

        mu R = m phi {I2/I0(k) + (2/kap) I1/I0(k) lead [s + phi (1 - lead)]} / hardening, s = E_r/E_g, phi = 1 - s.
        """
        if self.memory == 0:
            return 0.0
        kap, k, i, _ = self._ratios
        second = 1 - 2 * i / k if k > 1 else float(ive(2, k) / ive(0, k))
        s, lead = self.softening, self._lead
        braces = second + 2 * i / kap * lead * (s + (1 - s) * (1 - lead))
        return self.memory / self.radius * (1 - s) * braces / self._hardening

    def pressure(self, x):
        """p [Pa] at x [m] from the cylinder's lowest point, any shape; zero outside the contact."""
        u = (np.asarray(x, float) - self.centre) / self.half_width
        inside = np.abs(u) < 1
        return np.where(inside, self._pressure_at(np.arccos(-np.where(inside, u, 0.0))), 0.0)

    def _pressure_at(self, angle):
        """At x = centre - l cos(angle): (E_r l / 2R) k int_0^angle exp(-k (cos s - cos angle)) N(-cos s) ds,

        N(u) = 1 - u^2 + offset - tilt u. It forgets within a range of 1/k, to which the quadrature is confined.
        """
        kap, k, i, ratio = self._ratios
        scale = self.relaxed_modulus * self.half_width / (2 * self.radius)
        tilt = (i / k + ratio / kap) / (i + ratio)
        offset = tilt * i - i / k

        def numerator(s):
            return np.sin(s) ** 2 + offset + tilt * np.cos(s)

        if isinf(k):
            return scale * numerator(angle) / np.sin(angle)
        angle = np.asarray(angle)[..., None]
        start = 2 * np.arcsin(np.sqrt(np.maximum(np.sin(angle / 2) ** 2 - MANY / (2 * k), 0.0)))
        reach = 2 * np.arcsin(np.minimum(MANY / (2 * k * np.sin((angle + start) / 2)), 1.0))
        reach = np.where(start > 0, np.minimum(reach, angle), angle)
        nodes, weights = NODES
        back = reach * (1 - nodes) / 2
        age = 2 * np.sin(angle - back / 2) * np.sin(back / 2)
        return scale * k * np.sum(reach / 2 * weights * np.exp(-k * age) * numerator(angle - back), axis=-1)


def sliding(radius, relaxed_modulus, glassy_modulus, retardation_time, speed, line_load) -> LineContact:
    """The contact under a load per length [N/m] at a speed [m/s] >= 0 on a standard linear solid.

    relaxed_modulus, glassy_modulus : E* [Pa]; the second may be infinite, which is a Kelvin body
    retardation_time : tau_c [s], (glassy/relaxed) times the relaxation time

    Raises ValueError for what is not positive, or a glassy modulus below the relaxed one.
    """
    _positive(radius=radius, relaxed_modulus=relaxed_modulus)
    _positive(retardation_time=retardation_time, line_load=line_load)
    if not (glassy_modulus >= relaxed_modulus and 0 <= speed < inf):
        raise ValueError(
            f"glassy_modulus = {glassy_modulus:g} must reach relaxed_modulus = {relaxed_modulus:g}, "
            f"speed = {speed:g} must be finite and not negative"
        )
    memory, softening = speed * retardation_time, relaxed_modulus / glassy_modulus

    def contact(half_width):
        return LineContact(radius, relaxed_modulus, softening, memory, half_width)

    slow, _ = hertz(radius, relaxed_modulus, line_load)
    # Between the relaxed and the glassy half width, and at least the half width on a Kelvin body.
    fast = max(slow * sqrt(softening), slow**2 / (sqrt(memory**2 + slow**2) + memory))
    low, high = fast * (1 - 1e-9), slow * (1 + 1e-9)

    def excess(half_width):
        return contact(half_width).line_load / line_load - 1

    return contact(brentq(excess, low, high, xtol=1e-15 * low, rtol=1e-14))


def _positive(**amounts):
    for name, amount in amounts.items():
        if not 0 < amount < inf:
            raise ValueError(f"{name} = {amount:g} must be positive and finite")
