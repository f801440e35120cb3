"""Contacts that are drawn along the surface, with friction of the interface."""

from scene import Coulomb, Elastic, Scene, SelfAffine, Shear, Sphere

G, MU, LOAD = 1e6, 0.4, 1.0
SPHERE = Sphere(radius=10e-3)
ROUGH = SelfAffine(hurst=0.8, rms_height=1e-5, longest=10e-3, shortest=0.5e-3, seed=1)


def body(indenter=SPHERE, nu=0.5, roughness=None, coefficient=MU, **drawn):
    """A body, a sphere if no other, under LOAD."""
    return Scene(indenter, Elastic(G, nu), Shear(load=LOAD, **drawn), roughness, interface=Coulomb(coefficient))
