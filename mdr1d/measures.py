"""Measures of a solved profile, in addition to its forces and its depth."""

from math import sqrt

import numpy as np

from scene import Regime, Scene
from scene.scales import elastic_contact

from .profile import Profile
from .steady import Contact
from .surface import Surface


def measures(scene: Scene, body: Profile, contact: Contact) -> dict[str, float]:
    """Numbers of a contact, name -> value in SI units, as the docstring of MDR lists them.

    scene : of the body whose mapped profile was pressed in
    """
    modulus = scene.solid.indentation_modulus
    # Rounding of the two ends may leave nothing of a minute contact.
    span = max(contact.last - contact.first, contact.length)
    leading_length, leading_force = (np.diff(body.heights) < 0) @ contact.pushed
    found = {
        "pixel": body.pixel,
        "contact_length": contact.length,
        "contact_fraction": contact.length / span,
        "points_across_contact": span / body.pixel,
        "rms_slope_contact": sqrt(contact.slope_square / contact.length),
        "one_sidedness": float(leading_length) / contact.length,
        "load_on_leading_flanks": float(leading_force) / contact.force,
        "friction_by_traction": modulus * contact.traction,
        "stiffness": modulus * contact.stiffness,
    }
    if body.surface is not None:
        found |= _of_roughness(scene, body.surface)
    return found


def _of_roughness(scene: Scene, surface: Surface) -> dict[str, float]:
    smooth, shape = elastic_contact(scene), scene.indenter
    height, slope = surface.rms_height, surface.rms_slope
    line, contact = (shape.mdr_coefficient, shape.exponent), (smooth.radius, smooth.depth)
    regime = Regime.of(line, contact, height, surface.period, slope)
    return {
        "rms_height": height,
        "rms_slope": slope,
        "rms_slope_spectral": surface.rms_slope_spectral,
        "points_per_shortest_wave": surface.shortest / surface.pixel,
        "height_over_depth": float(regime.height_over_depth),
        "contact_over_period": float(regime.contact_over_period),
        "macro_over_rough": float(regime.macro_over_rough),
    }
