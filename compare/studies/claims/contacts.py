"""The rough contacts around which studies are made."""

from dataclasses import replace
from math import radians

from scene import Cone, Scene, SelfAffine, Slide, Sphere

from ..paper import parameters

# The waves that three dimensions resolve: the paper's own reach down to 4 micrometres.
SHORTEST = 5e-4
# Contacts within the regime of the paper, rms slope 0.28 and h0 at most 0.09 d, and the loads [N] between which.
STEEP = {
    "sphere": (
        Scene(
            Sphere(radius=30e-3),
            parameters.SOLID,
            Slide(speed=1.0, load=1.0),
            SelfAffine(hurst=0.2, rms_height=3.01e-6, longest=1e-2, rolloff=1.2e-4, shortest=3.2e-5),
        ),
        (0.18, 0.9),
    ),
    "cone": (
        Scene(
            Cone(angle=radians(2)),
            parameters.SOLID,
            Slide(speed=1.0, load=1.0),
            SelfAffine(hurst=0.2, rms_height=5.22e-6, longest=1e-2, rolloff=3.1e-4, shortest=4.6e-5),
        ),
        (0.25, 1.25),
    ),
}


def kelvin(shape: str, **roughness) -> Scene:
    """A contact of Fig. 1 of the paper with a shortest wave that both dimensionalities resolve."""
    return replace(parameters.contact(shape), roughness=resolved(shape, **roughness))


def resolved(shape: str, **changed) -> SelfAffine:
    """The roughness of that contact, with what is changed."""
    return replace(parameters.contact_rough(shape), shortest=SHORTEST, **changed)
