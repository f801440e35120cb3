"""Solids of a unit modulus of indentation at rest, E* = 4G, and a body and roughness to press into them."""

from scene import Elastic, Kelvin, KelvinChain, Prony, SelfAffine, Sphere, StandardLinearSolid

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
# Of sums of some thousand terms over some hundred steps.
ROUNDING = 1e-11
