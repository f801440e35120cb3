"""A sphere that slides on rubber: smooth, rough, and rough down to the pixels of the grid as in the paper."""

from dataclasses import replace

from scene import Kelvin, KelvinChain, Prony, Scene, SelfAffine, Slide, Sphere

KELVIN = Kelvin(modulus=1e6, relaxation_time=1e-3)
SERIES = Prony(equilibrium_modulus=1e6, moduli=(3e6, 5e5, 2e7), relaxation_times=(1e-3, 3e-2, 2e-5))
CHAIN = KelvinChain(instantaneous_compliance=0.0, compliances=(6e-7, 4e-7), retardation_times=(1e-3, 3e-5))
ORDINARY = Scene(Sphere(radius=1e-2), KELVIN, Slide(speed=0.1, load=1.0))
SMOOTH = replace(ORDINARY, motion=Slide(speed=0.3, load=1.0))
ROUGH = replace(SMOOTH, roughness=SelfAffine(hurst=0.8, rms_height=5e-6, longest=4e-3, shortest=1e-4, seed=3))
PAPER = replace(ROUGH, roughness=replace(ROUGH.roughness, shortest=None))
