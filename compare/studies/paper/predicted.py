"""Eq. 22 for the friction of Figs. 5 to 7, with the loss at one frequency and with that of every wave."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from mdr1d import amplitudes, draw, equations
from scene import Regime
from scene.scales import elastic_contact

from . import parameters
from .conditions import regime_of
from .parameters import Loss

# |G(v/a)| / G_0, at the frequency of the contact as a whole, and up to where that counts as constant.
CONSTANT = 1.1
# Images of each wave on either side: those beyond would add 2e-3 to the friction at most.
IMAGES = 10
# Frequencies between which the loss of every wave is interpolated.
KNOTS = 4000
# Forms of Eq. 22, by what of the loss they know.
SHORTEST, EVERY, WITH_SMOOTH = "shortest wave", "every wave", "every wave and smooth body"


@dataclass(frozen=True)
class Predicted:
    """Friction of one rubber by the laws, arrays (speeds, loads).

    one_frequency, spectral : mu of Eq. 22 with the loss at the shortest wave, and with that of every wave at its
        own frequency; both leave out the macroscopic slope
    stiffness : |G(v/a)| / G_0, which Eq. 22 presupposes to be 1
    regime : ratios of the contacts
    """

    one_frequency: np.ndarray
    spectral: np.ndarray
    stiffness: np.ndarray
    regime: Regime

    def forms(self, smooth: np.ndarray) -> dict[str, np.ndarray]:
        """mu of each form of Eq. 22, by name; the last adds the friction of the smooth body."""
        one, every = self.one_frequency, self.spectral
        return {SHORTEST: one, EVERY: every, WITH_SMOOTH: every + smooth}


def predict(loss: Loss) -> Predicted:
    """Friction of a rubber by the laws."""
    speeds, loads = np.array(parameters.SPEEDS)[:, None], np.array(parameters.FORCES)
    scene = parameters.lossy(loss, 1.0, 1.0)
    solid, body, rough = scene.elastomer, scene.indenter, parameters.LOSS_ROUGH
    c, n = body.mdr_coefficient, body.exponent
    surface = draw(rough, parameters.POINTS)
    slope, highest = surface.rms_slope, np.pi / surface.pixel
    scenes = [replace(scene, motion=replace(scene.motion, load=load)) for load in loads.tolist()]
    radius = np.array([elastic_contact(each).radius for each in scenes])

    def loss_modulus(omega):
        return solid.complex_modulus(omega).imag

    one = equations.general_friction(loads, solid.modulus, loss_modulus, highest, speeds, slope, c, n)
    q, waves = _linear_between_nodes(rough, surface.pixel)
    # Losses of that many waves and speeds are interpolated: an error of 1e-12, and nearly all of the time saved.
    omega = np.geomspace(q.min() * speeds.min(), q.max() * speeds.max(), KNOTS)
    spline = CubicSpline(np.log(omega), np.log(loss_modulus(omega)))

    def of_many(omega):
        return np.exp(spline(np.log(omega)))

    slow = [equations.wave_force(of_many, q, waves, speed, 2 * radius) / loads for speed in parameters.SPEEDS]
    plateau = equations.plateau(slope)
    stiffness = np.abs(solid.complex_modulus(speeds / radius)) / solid.modulus
    ratios: dict[str, Any] = {
        name: np.broadcast_to(ratio, stiffness.shape) for name, ratio in vars(regime_of(scenes, slope)).items()
    }
    spectral = plateau * equations.interpolation(np.array(slow) / plateau)
    return Predicted(one, spectral, stiffness, Regime(**ratios))


def _linear_between_nodes(rough, pixel):
    """Wave numbers [rad/m] and amplitudes [m] of what is solved: lines between the nodes have images of each wave.

    The image at q + 2 pi m / pixel has sinc^2 of the amplitude there; together they have the slope of the steps.
    """
    waves = amplitudes(rough, np.pi / pixel / rough.q_min)
    images = 2 * np.pi / pixel * np.arange(-IMAGES, IMAGES + 1)
    q = np.add.outer(images, rough.q_min * np.arange(1, waves.size + 1))
    seen = waves * np.square(np.sinc(q * pixel / (2 * np.pi)))
    return np.abs(q).ravel(), seen.ravel()
