"""A rough plane in full contact with a viscoelastic half-space that flows past it: every wave by itself.

The surface follows the heights, w = -h, and a wave h_q exp(i q x) is seen at the frequency q_x v, so that its
pressure is -(|q|/2) E*(q_x v) h_q exp(i q x) about the mean, E* = 2 G / (1 - nu). Arrays are [y, x].
"""

from math import pi, sqrt

import numpy as np


def complex_stiffness(elastomer, omega):
    """E*(omega) [Pa] for any angular frequencies [rad/s], those below zero conjugate to those above."""
    omega = np.asarray(omega, float)
    modulus = elastomer.complex_modulus(np.abs(omega))
    return 2 / (1 - elastomer.poisson_ratio) * np.where(omega < 0, np.conj(modulus), modulus)


def wave_friction(amplitude, wavelength, elastomer, speed):
    """F_x/A = q^2 h0^2 Im E*(q v) / 4 [Pa] of h0 cos(q x), q = 2 pi / wavelength; lengths [m], speed [m/s]."""
    q = 2 * pi / wavelength
    return q**2 * amplitude**2 / 4 * float(complex_stiffness(elastomer, q * speed).imag)


def crossed_friction(amplitude, wavelength, elastomer, speed):
    """F_x/A = sqrt(2) q^2 h0^2 Im E*(q v) / 8 [Pa] of h0 cos(q x) cos(q y): four waves of |q| sqrt(2)."""
    return wave_friction(amplitude, wavelength, elastomer, speed) / sqrt(2)


def wave_closure(amplitude, wavelength, elastomer, speed):
    """Least mean pressure [Pa] that keeps a wave in full contact: |E*(q v)| q h0 / 2."""
    q = 2 * pi / wavelength
    return q * amplitude / 2 * float(abs(complex_stiffness(elastomer, q * speed)))


def crossed_closure(amplitude, wavelength, elastomer, speed):
    """Least mean pressure [Pa] that keeps crossed waves in full contact: sqrt(2) times wave_closure."""
    return sqrt(2) * wave_closure(amplitude, wavelength, elastomer, speed)


def wave_pressure(amplitude, wavelength, elastomer, speed, x):
    """Pressure about its mean [Pa] at x [m] under h0 cos(q x): -(q h0/2) |E*| cos(q x + arg E*)."""
    q = 2 * pi / wavelength
    stiffness = complex_stiffness(elastomer, q * speed)
    return -q * amplitude / 2 * np.real(stiffness * np.exp(1j * q * np.asarray(x, float)))


def pressure(heights, sides, elastomer, speed):
    """Pressure about its mean [Pa], (ny, nx), of periodic heights (ny, nx) [m].

    sides : of the period along y and x [m]

    The highest wave of an even number of points stands between its two directions and gets the real part.
    """
    _, total, stiffness, waves = _spectrum(heights, sides, elastomer, speed)
    return np.fft.ifft2(-total / 2 * stiffness * waves).real * np.size(heights)


def friction(heights, sides, elastomer, speed):
    """F_x/A [Pa] of periodic heights (ny, nx) [m]: sum_q (|q|/2) |q_x| |h_q|^2 Im E*(|q_x| v).

    Over both signs of q; that is -<p dh/dx>, the traction on the slopes.
    """
    along, total, stiffness, waves = _spectrum(heights, sides, elastomer, speed)
    return float(np.sum(total / 2 * np.abs(along) * np.abs(waves) ** 2 * np.abs(stiffness.imag)))


def _spectrum(heights, sides, elastomer, speed):
    heights = np.asarray(heights, float)
    if heights.ndim != 2 or not np.all(np.isfinite(heights)):
        raise ValueError(f"heights must be a finite array of two dimensions, not of shape {heights.shape}")
    if not (min(sides) > 0 and speed >= 0):
        raise ValueError(f"sides = {sides} must be positive, speed = {speed:g} not negative")
    q_y, q_x = (2 * pi * np.fft.fftfreq(n, side / n) for n, side in zip(heights.shape, sides, strict=True))
    stiffness = complex_stiffness(elastomer, q_x * speed)[None, :]
    return q_x[None, :], np.hypot(q_y[:, None], q_x), stiffness, np.fft.fft2(heights) / heights.size
