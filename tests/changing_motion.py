"""Programs of motion from their stages, and contacts under some in closed form: either way, at an angle, swung."""

from dataclasses import replace
from itertools import pairwise
from math import pi, sqrt

import numpy as np

from compare.models.exact.full_contact import complex_stiffness
from scene import Program, Stage

# A sphere, the radius A of its contact at rest at DEPTH, a shear modulus and a time.
R, G, A, TAU = 1e-2, 1e6, 1e-3, 1e-3
DEPTH = A**2 / R


def program(*stages):
    return Program(stages=tuple(Stage(**stage) for stage in stages))


def slid(path, speed, **given):
    """A stage that slides so far, backwards where the path is negative."""
    return {"duration": abs(path / speed), "speed": np.copysign(speed, path), **given}


def mirrored(motion):
    return replace(motion, stages=tuple(replace(stage, speed=-stage.speed) for stage in motion.stages))


def wave_friction(amplitude, wavelength, elastomer, program, times, begin):
    """F_x/A [Pa] of h0 cos(q x) in full contact at times [s], through speeds that change and change their sign.

    begin : when all has relaxed at rest, in full contact [s]

    The surface follows the heights, so that in the frame of the material a wave has the phase q X(t) on the path
    X, and its pressure is (q/2) int E*(t - s) dw. The relaxed part of E* cancels; of each of the others

        F_x/A = (q^2 h0^2/4) sum_k E_k int_begin^t exp(-(t - s)/tau_k) cos(q X(t) - q X(s)) q v(s) ds,

    a sum of exponentials where the speed is constant, and (q^2 h0^2/4) E*'' of the steady speed in the end.
    """
    q, (_, moduli, branches) = 2 * pi / wavelength, elastomer.relaxation()
    starts = np.cumsum([0.0, *(stage.duration for stage in program.stages)])
    now, found = np.asarray(times, float), np.zeros(np.shape(times))
    for stage, (first, last) in zip(program.stages, pairwise(starts), strict=True):
        if stage.speed == 0:
            continue
        low, high = np.minimum(max(first, begin), now), np.minimum(last, now)
        for modulus, branch in zip(moduli, branches, strict=True):
            rate = 1 / branch + 1j * q * stage.speed
            ends = [
                np.exp(-(now - at) / branch - 1j * q * (program.path(now) - program.path(at)))
                for at in (low, np.maximum(low, high))
            ]
            found += modulus * q * stage.speed * ((ends[1] - ends[0]) / rate).real
        found += np.where((now > first) & (now <= last), elastomer.viscosity * q * stage.speed, 0.0)
    return 2 / (1 - elastomer.poisson_ratio) * q**2 * amplitude**2 / 4 * found


def oblique(radius, kelvin, speed, approach, time):
    """Normal force and friction [N] of a sphere that comes down on a foundation at an angle, on a Kelvin solid.

    radius [m]; speed along and approach towards the surface [m/s], both constant from the first touch, at `time`
    [s] after it

    With c = d - x^2/R an element carries f = c + tau c' as long as that is positive and it has landed, c >= 0:
    in front up to x = -sqrt(R d), behind up to there or to where f falls to zero. That is the foundation itself: a
    solver of it is off by its pixel alone.
    """
    tau, depth = kelvin.relaxation_time, approach * time
    front = sqrt(radius * depth)
    back = min(front, sqrt((speed * tau) ** 2 + radius * (depth + tau * approach)) - speed * tau)
    f = np.polynomial.Polynomial([depth + tau * approach, -2 * speed * tau / radius, -1 / radius])
    slope = np.polynomial.Polynomial([0.0, 2 / radius])
    force, friction = f.integ(), -(slope * f).integ()
    scale = kelvin.indentation_modulus
    return scale * (force(back) - force(-front)), scale * (friction(back) - friction(-front))


def stiffness(radius, elastomer, omega):
    """dF/dd = 2 a E*(omega) [N/m], complex, of a contact of the radius a [m] under a small oscillation of depth.

    To first order the radius stays constant, as the edge carries nothing: this is the stiffness of a flat punch.
    omega [rad/s] has any shape; the force leads the depth by the argument.
    """
    return 2 * radius * complex_stiffness(elastomer, omega)


def harmonic(time: np.ndarray, values: np.ndarray, omega: float) -> complex:
    """Of values = Im(harmonic * exp(i omega time)) about their mean, with a second harmonic aside."""
    waves = np.exp(1j * omega * np.outer(time, [0, 1, 2]))
    fit = np.linalg.lstsq(np.hstack([waves.real, waves.imag[:, 1:]]), values, rcond=None)[0]
    return complex(fit[3], fit[1])
