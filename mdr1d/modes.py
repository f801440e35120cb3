"""Relaxation and retardation modes of a solid, and the matrix from the states of the first to those of the second.

In units of the relaxed modulus the modulus is E(s) = 1 + drag s + sum_k K_k s m_k/(1 + s m_k), and the compliance
1/E(s) = J_0 + sum_j J_j/(1 + s l_j). The l_j are the zeros of E at s = -1/l, 1 = drag/l + sum_k K_k m_k/(l - m_k):
one between each two m_k, one above the last, and with a dashpot one below the first.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from scene.solids.modes import distances
from scene.solids.viscoelastic import Linear


@dataclass(frozen=True, eq=False)
class Modes:
    """Both sets of modes, relaxation k and retardation j, each from the shortest time to the longest.

    moduli : K_k over the relaxed modulus (K,)
    relaxation_times : m_k (K,) [s]
    drag : viscosity of a lone dashpot over the relaxed modulus [s]; 0 where the solid has a glassy modulus
    compliances : J_j times the relaxed modulus (K,), or (K + 1,) with a dashpot
    retardation_times : l_j, as many [s]
    exchange : m_k/(l_j - m_k), row k and column j; never from a difference of computed times
    """

    moduli: np.ndarray
    relaxation_times: np.ndarray
    drag: float
    compliances: np.ndarray
    retardation_times: np.ndarray
    exchange: np.ndarray


@lru_cache(maxsize=256)
def modes_of(elastomer: Linear) -> Modes:
    """The modes of a solid that has any.

    The compliances are those of the rational function with just these poles and zeros, in the manner of Gu and
    Eisenstat, SIAM J. Matrix Anal. Appl. 15, 1266 (1994): where close times make single zeros uncertain, together
    they still describe the solid, and no energy is lost in an exchange.
    """
    equilibrium, moduli, times = elastomer.relaxation()
    drag = elastomer.viscosity / equilibrium
    moduli, times = moduli / equilibrium, times.copy()
    poles, weights = times, moduli * times
    if drag:
        poles, weights = np.append(0.0, poles), np.append(drag, weights)
    apart_from_poles = distances(poles, weights, 1.0)
    nearest = np.diag(apart_from_poles)
    retardation_times = poles + nearest
    # |x_i - x_j| as a sum, by way of a pole between.
    i, j = np.indices(apart_from_poles.shape)
    upper, lower = np.maximum(i, j), np.minimum(i, j)
    apart = np.where(i == j, nearest, nearest[upper] - apart_from_poles[lower, upper])
    compliances = nearest / retardation_times * np.prod(np.abs(apart_from_poles) / apart, axis=1)
    exchange = np.ascontiguousarray((times / apart_from_poles[:, poles.size - times.size :]).T)
    return Modes(moduli, times, drag, compliances, retardation_times, exchange)
