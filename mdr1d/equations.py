"""Eqs. 10 to 25 of Popov et al., Sci. Rep. 4, 3750 (2014), recalculated.

Of a rough profile g = c |x|^n + h(x) on an incompressible solid, E* = 4 G_0. Numbers in SI, quantities with
units, or arrays of either that broadcast:

load : F_N [N]; modulus : G_0, the static shear modulus [Pa]; relaxation_time : tau of a Kelvin solid [s]
speed : v [m/s]; rms_slope : s, of the roughness h; c : [m^(1-n)], n : 1 to 100, as mapped: 1/R and 2 for a sphere
loss_modulus : the function G''(omega) [Pa] of angular frequencies [rad/s]; wave_number : q_max [rad/m]
form : "corrected", or "as_printed" where the printed formula differs

A number out of its range raises ValueError, which names it.
"""

from collections.abc import Callable
from typing import Literal, get_args

import numpy as np

from .domain import between, in_si, not_negative, one_of, positive

Form = Literal["corrected", "as_printed"]
# Exponent of Eq. 19, the paper's best fit.
ALPHA = 1.5
_QUADRATURE = 1e-12


@in_si
def contact_radius(load, modulus, c, n):
    """a [m] of the smooth relaxed contact, a^(n+1) = F_N (n+1) / (8 G_0 c n), Eq. 16.

    A sphere of R = 10 mm, c = 1/R and n = 2, under 1 N on G_0 = 1 MPa:

    >>> round(contact_radius(load=1.0, modulus=1e6, c=100.0, n=2), 6)
    0.001233
    """
    positive(load=load, modulus=modulus, c=c)
    between(1, 100, n=n)
    return (load * (n + 1) / (8 * modulus * c * n)) ** (1 / (n + 1))


@in_si
def indentation_depth(load, modulus, c, n):
    """d [m] of the smooth relaxed contact, d = c a^n, Eq. 16."""
    return c * contact_radius(load, modulus, c, n) ** n


@in_si
def macroscopic_slope(load, modulus, c, n):
    """rms of c n |x|^(n-1) over the smooth relaxed contact, c n a^(n-1) / (2n-1)^(1/2)."""
    return c * n * contact_radius(load, modulus, c, n) ** (n - 1) / np.sqrt(2 * n - 1)


@in_si
def low_speed_friction(load, modulus, relaxation_time, speed, rms_slope, c, n):
    """mu = 4 G_0 L v tau s^2 / F_N in full contact of the length L = 2a, Eq. 12.

    Eqs. 11 and 12 leave out the macroscopic slope. Eq. 10, which keeps it, is this formula of the rms slope of
    both, hypot(rms_slope, macroscopic_slope(load, modulus, c, n)).
    """
    not_negative(relaxation_time=relaxation_time, speed=speed, rms_slope=rms_slope)
    length = 2 * contact_radius(load, modulus, c, n)
    return 4 * modulus * length * speed * relaxation_time * np.square(rms_slope) / load


@in_si
def one_sided_speed(depth, relaxation_time, rms_slope):
    """v [m/s] at which contact becomes one-sided, d / (tau s), Eq. 13; depth d [m].

    It is lost where g' > 0, on the trailing flanks, not at "negative surface gradient" as the text has it.
    """
    positive(depth=depth, relaxation_time=relaxation_time, rms_slope=rms_slope)
    return depth / (relaxation_time * rms_slope)


@in_si
def plateau(rms_slope):
    """mu = sqrt(2) s at high speed, Eq. 14."""
    not_negative(rms_slope=rms_slope)
    return np.sqrt(2) * rms_slope


@in_si
def plateau_of_slopes(slopes, lengths=1.0, form: Form = "corrected"):
    """mu = <z'^2> / <|z'|> at high speed over the real contact, Eq. 15: sum of its pieces along the last axis.

    slopes : z' of the pieces, of either sign; lengths : of the pieces [m], equal by default

    Exponential slopes give sqrt(2), Gaussian ones sqrt(pi/2) times the rms over the contact. The printed last form
    lacks the root of the length of real contact: it has the dimension m^(-1/2).
    """
    positive(lengths=lengths)
    one_of(get_args(Form), form=form)
    sizes, lengths = np.broadcast_arrays(np.abs(np.asarray(slopes, float)), lengths)
    if not (sizes.size and np.all(np.isfinite(sizes)) and np.all(np.any(sizes > 0, axis=-1))):
        raise ValueError("slopes must be finite, and not all of them zero")
    mean = np.sum(sizes**2 * lengths, axis=-1) / np.sum(sizes * lengths, axis=-1)
    return mean if form == "corrected" else mean / np.sqrt(np.sum(lengths, axis=-1))


@in_si
def normalised_friction(friction, rms_slope, form: Form = "corrected"):
    """mu over sqrt(2) s, Eq. 18. As printed the root covers s too."""
    positive(rms_slope=rms_slope)
    return friction / _unit(rms_slope, form)


@in_si
def similarity_variable(load, modulus, relaxation_time, speed, rms_slope, c, n):
    """xi = (v tau s / sqrt 2) (8 G_0 / F_N)^(n/(n+1)) ((n+1) / (c n))^(1/(n+1)), Eq. 18.

    It is the friction at low speed over the plateau, Eq. 17.
    """
    positive(load=load, modulus=modulus, c=c)
    not_negative(relaxation_time=relaxation_time, speed=speed, rms_slope=rms_slope)
    between(1, 100, n=n)
    shape = ((n + 1) / (c * n)) ** (1 / (n + 1))
    return speed * relaxation_time * rms_slope / np.sqrt(2) * (8 * modulus / load) ** (n / (n + 1)) * shape


@in_si
def interpolation(xi, alpha=ALPHA):
    """mu over the plateau, (1 + xi^-alpha)^(-1/alpha) for xi from zero to infinity, Eq. 19."""
    between(0, np.inf, xi=xi)
    positive(alpha=alpha)
    least = np.minimum(xi, 1.0)
    return least * (1 + (least / np.maximum(xi, 1.0)) ** alpha) ** (-1 / alpha)


@in_si
def high_frequency_force(loss_modulus: Callable, wave_number, speed, rms_slope, contact_length):
    """F_x [N] = 4 G''(q v) s^2 L / q, Eq. 20: every wave of the roughness taken for the shortest; L [m]."""
    positive(wave_number=wave_number)
    not_negative(speed=speed, rms_slope=rms_slope, contact_length=contact_length)
    return 4 * loss_modulus(wave_number * speed) * np.square(rms_slope) * contact_length / wave_number


@in_si
def spectral_force(loss_modulus: Callable, spectrum: Callable, band, speed, contact_length):
    """F_x [N] = 8 L int q C_1D(q) G''(q v) dq, what Eq. 20 stands for: each wave in full contact by itself.

    spectrum : the function C_1D(q) [m^3], two-sided; band : lowest and highest wave number [rad/m]; L [m]
    """
    from scipy.integrate import quad_vec  # slow, and no other equation needs it

    low, high = band
    positive(band=band)
    not_negative(speed=speed, contact_length=contact_length)
    if not low < high:
        raise ValueError(f"band = ({low:g}, {high:g}) must rise")

    def of_octaves(logarithm):
        q = np.exp(logarithm)
        return q**2 * spectrum(q) * loss_modulus(q * np.asarray(speed, float))

    integral, _ = quad_vec(of_octaves, np.log(low), np.log(high), epsabs=0, epsrel=_QUADRATURE)
    return 8 * contact_length * integral


@in_si
def wave_force(loss_modulus: Callable, wave_numbers, amplitudes, speed, contact_length):
    """F_x [N] = 2 L sum_k q_k A_k^2 G''(q_k v), the same of waves A_k cos(q_k x + phase).

    Exact in full contact and without ends. A profile that is linear between nodes has other waves than these.

    wave_numbers [rad/m], amplitudes [m] : (..., K), along the last axis; speed, L [m] : of the other axes
    """
    positive(wave_numbers=wave_numbers)
    not_negative(amplitudes=amplitudes, speed=speed, contact_length=contact_length)
    loss = loss_modulus(wave_numbers * np.asarray(speed, float)[..., None])
    return 2 * contact_length * np.sum(wave_numbers * np.square(amplitudes) * loss, axis=-1)


@in_si
def one_frequency_friction(
    load, modulus, loss_modulus: Callable, wave_number, speed, rms_slope, c, n, form: Form = "corrected"
):
    """mu = 8 G''(q v) a s^2 / (q F_N), Eqs. 20 and 16; Eq. 21 has half of it, 4 G'' a, as if a were the length."""
    one_of(get_args(Form), form=form)
    radius = contact_radius(load, modulus, c, n)
    length = 2 * radius if form == "corrected" else radius
    return high_frequency_force(loss_modulus, wave_number, speed, rms_slope, length) / load


@in_si
def general_friction(
    load,
    modulus,
    loss_modulus: Callable,
    wave_number,
    speed,
    rms_slope,
    c,
    n,
    alpha=ALPHA,
    form: Form = "corrected",
):
    """mu = sqrt(2) s (1 + [q F_N / (4 sqrt(2) G''(q v) s a)]^alpha)^(-1/alpha), Eq. 22: Eqs. 21 and 14 joined.

    As printed 2 sqrt(2) stands in the bracket, and mu has the unit of `normalised_friction`.
    """
    positive(rms_slope=rms_slope)
    slow = one_frequency_friction(load, modulus, loss_modulus, wave_number, speed, rms_slope, c, n, form)
    return _unit(rms_slope, form) * interpolation(slow / plateau(rms_slope), alpha)


@in_si
def force_shift(speed, modulus, loss_modulus: Callable, wave_number, rms_slope, c, n):
    """p(v) [1/N] of Eq. 23, mu = Q(F_N p(v)), from Eq. 22; the paper does not give it. Speeds > 0.

    p = [q / (4 sqrt(2) G''(q v) s)]^((n+1)/n) (8 G_0 c n / (n+1))^(1/n)
    """
    positive(speed=speed, modulus=modulus, wave_number=wave_number, rms_slope=rms_slope, c=c)
    between(1, 100, n=n)
    roughness = wave_number / (4 * np.sqrt(2) * loss_modulus(wave_number * speed) * rms_slope)
    return roughness ** ((n + 1) / n) * (8 * modulus * c * n / (n + 1)) ** (1 / n)


@in_si
def master_curve(shifted_load, rms_slope, n, alpha=ALPHA):
    """Q(s) = sqrt(2) rms_slope (1 + s^(alpha n/(n+1)))^(-1/alpha), s = F_N p(v) from zero to infinity, Eq. 23."""
    between(0, np.inf, shifted_load=shifted_load)
    between(1, 100, n=n)
    positive(alpha=alpha)
    with np.errstate(divide="ignore"):
        xi = np.asarray(shifted_load, float) ** (-n / (n + 1))
    return plateau(rms_slope) * interpolation(xi, alpha)


@in_si
def force_shift_exponent(beta, n):
    """d ln p / d ln v = -beta (n+1)/n of G'' ~ omega^beta, -1 to 1; the paper's -3 beta/2 holds for a sphere."""
    between(-1, 1, beta=beta)
    between(1, 100, n=n)
    return -beta * (n + 1) / n


@in_si
def power_law_loss(omega, loss, reference_frequency, beta):
    """G''(omega) [Pa] = loss (omega / reference_frequency)^beta, Eq. 24; loss [Pa], frequencies [rad/s]."""
    not_negative(omega=omega)
    positive(loss=loss, reference_frequency=reference_frequency)
    between(0, 1, beta=beta)
    return loss * (omega / reference_frequency) ** beta


@in_si
def power_law_friction(
    load,
    modulus,
    loss,
    reference_frequency,
    beta,
    wave_number,
    speed,
    rms_slope,
    radius,
    alpha=ALPHA,
    form: Form = "corrected",
):
    """mu of a rough sphere of radius R [m] with the loss modulus of `power_law_loss`, Eq. 25.

    mu = sqrt(2) s (1 + y^alpha)^(-1/alpha)
    y = q^(1-b) w_0^b / (4 sqrt(2) G~ s) (16 G_0 / (3R))^(1/3) (F_N^2 / v^(3b))^(1/3)

    As printed y has 2 sqrt(2) and lacks w_0^b, which is right at w_0 = 1 rad/s alone; mu has the unit of
    `normalised_friction`.
    """
    positive(load=load, modulus=modulus, loss=loss, reference_frequency=reference_frequency)
    positive(wave_number=wave_number, rms_slope=rms_slope, radius=radius)
    not_negative(speed=speed)
    between(0, 1, beta=beta)
    unit = _unit(rms_slope, form)
    number, frequency = (4, reference_frequency) if form == "corrected" else (2, 1.0)
    waves = wave_number ** (1 - beta) * frequency**beta / (number * np.sqrt(2) * loss * rms_slope)
    pressed = (16 * modulus / (3 * radius)) ** (1 / 3) * load ** (2 / 3)
    return unit * interpolation(speed**beta / (waves * pressed), alpha)


def _unit(rms_slope, form):
    """sqrt(2) s; Eqs. 17 to 25 are printed with the root over both factors."""
    one_of(get_args(Form), form=form)
    return np.sqrt(2) * rms_slope if form == "corrected" else np.sqrt(2 * rms_slope)
