"""Solids that tests share: one of each type, some of E* = 4G = 1 at rest; and tables with scatter."""

import numpy as np

from scene import (
    Elastic,
    Fractional,
    Kelvin,
    KelvinChain,
    Prony,
    SelfAffine,
    Sphere,
    StandardLinearSolid,
    Table,
    Tabulated,
)

MEASURED = Table((1.0, 10.0, 100.0, 1e3, 1e4), (1e6, 1.1e6, 1.9e6, 3.3e6, 4.1e6), (5e4, 3.5e5, 9e5, 7.5e5, 2e5))
OF_EACH_TYPE = {
    "elastic": Elastic(1e6, 0.3),
    "kelvin": Kelvin(1e6, 1e-3, 0.3),
    "standard linear": StandardLinearSolid(1e6, 1e9, 1e-3),
    "prony": Prony(1e6, (1e3, 3e9, 2e6), (1e-6, 1e2, 1e-4)),
    "chain": KelvinChain(1e-9, (1e-6, 1e-8, 1e-7), (1e-2, 1e3, 1e-5)),
    "chain without a spring": KelvinChain(0.0, (1e-6, 1e-8), (1e-2, 1e3)),
    "fractional": Fractional(
        modulus=1e6, relaxation_time=1e-3, exponent=0.3, lowest_frequency=1e-4, highest_frequency=1e6
    ),
    "tabulated": Tabulated(table=MEASURED, frequency_unit="Hz", kind="shear"),
}

ELASTIC = Elastic(0.25)
KELVIN = Kelvin(modulus=0.25, relaxation_time=1.0)
SOLID = StandardLinearSolid(rubbery_modulus=0.25, glassy_modulus=1.25, relaxation_time=1.0)
SERIES = Prony(equilibrium_modulus=0.25, moduli=(1.0, 0.5, 20.0), relaxation_times=(1.0, 10.0, 0.02))
CHAIN = KelvinChain(instantaneous_compliance=0.0, compliances=(3.0, 1.0), retardation_times=(1.0, 0.03))
SOLIDS = {"elastic": ELASTIC, "kelvin": KELVIN, "standard": SOLID, "series": SERIES, "chain with a dashpot": CHAIN}
BALL = Sphere(1.0)
ROUGH = SelfAffine(hurst=0.7, rms_height=1e-3, longest=1.0, shortest=0.02, seed=3)
# Depths, or loads, in turn: lift-off to separation, recovery, touch again, lift-off within one step, all at once.
CYCLES = {
    "depth": ((1.0, 0.2), (0.2, 0.02), (0.5, 0.02), (0.3, 0.1), (0.1, 0.0), (1.0, 0.15), (1e-6, 0.16)),
    "load": ((1.0, 0.1), (0.2, 0.0), (0.5, 0.0), (0.3, 0.05), (0.1, 0.01), (1.0, 0.12)),
}
# Sums of some thousand terms over some hundred steps.
ROUNDING = 1e-11


def gel(lowest, exponent=0.2, **stated):
    """A table of two decades from a lowest frequency [rad/s] on, of a power law of the frequency."""
    omega = lowest * np.geomspace(1.0, 100.0, 13)
    modulus = 1e6 * (1j * omega) ** exponent
    table = Table(omega, modulus.real, modulus.imag)
    return Tabulated(table=table, frequency_unit="rad/s", kind="shear", **stated)


def scattered(law, omega, noise=0.0, seed=0):
    """Table of a complex modulus over angular frequency, with independent scatter on storage and loss."""
    modulus = law(omega)
    scatter = np.exp(noise * np.random.default_rng(seed).standard_normal((2, len(omega))))
    return Table(omega, modulus.real * scatter[0], modulus.imag * scatter[1])
