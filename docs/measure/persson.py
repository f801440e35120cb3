"""Area and friction of rough planes by Persson's theory over those solved in three dimensions.

python docs/measure/persson.py prints the table of docs/explanation/theory.md
"""

from dataclasses import replace
from math import pi

import numpy as np
from pandas import DataFrame

from bem3d import BEM
from compare import Persson
from compare.models.law.bands import Bands, FullContact
from scene import Kelvin, Plane, Scene, SelfAffine, Slide

ROUGH = SelfAffine(hurst=0.8, rms_height=1e-7, longest=16e-3, shortest=1e-3)
SOLID, WAVE = Kelvin(modulus=1e6, relaxation_time=1e-3), 2 * pi / 1e-3
LOSSES, RATIOS = (0.06, 20.0), (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)  # v tau q_s; p over p_rms
COARSE, FINE = 16, 32  # points on the shortest wave
SURFACES, FINER = 16, 4


def plane(loss: float, ratio: float) -> Scene:
    """The plane at v tau q_s under a pressure over the rms pressure of all waves in full contact."""
    speed = loss / (SOLID.relaxation_time * WAVE)
    full = FullContact.of(Bands.of(ROUGH), SOLID, speed)
    return Scene(Plane(), SOLID, Slide(speed=speed, pressure=ratio * float(full.pressure[-1])), ROUGH)


def errors(scene: Scene, surfaces: int = SURFACES, finer: int = FINER) -> dict[str, float]:
    """Theory over the mean of surfaces, extrapolated from both grids at first order in the pixel.

    The means are of the coarse grid; what the finer changes is that of a few surfaces.
    """
    few = [_solved(scene, seed, FINE) for seed in range(finer)]
    all_of = [_solved(scene, seed, COARSE) for seed in range(surfaces)]
    coarse = np.mean(all_of[:finer], axis=0)
    area, friction = np.mean(all_of, axis=0) * (2 * np.mean(few, axis=0) / coarse - 1)
    found = {name: Persson(gamma).solve(scene) for name, gamma in (("alone", None), ("with gamma", 0.5))}
    return {
        "area": found["alone"].measures["contact_fraction"] / area,
        **{f"friction, P {name}": each.friction_coefficient / friction for name, each in found.items()},
        "scatter": float(np.std(all_of, axis=0, ddof=1)[1] / np.mean(all_of, axis=0)[1] / surfaces**0.5),
    }


def _solved(scene, seed, points):
    side = round(points * ROUGH.longest / ROUGH.shortest)
    found = BEM(points=side).solve(replace(scene, roughness=replace(ROUGH, seed=seed)))
    return found.measures["contact_fraction"], found.friction_coefficient


if __name__ == "__main__":
    rows = [{"v tau q_s": loss, "x": x, **errors(plane(loss, x))} for loss in LOSSES for x in RATIOS]
    print(DataFrame(rows).round(3).to_string(index=False))
