"""Scenes, cases and grids of parameters small enough to be solved in a test."""

from dataclasses import replace

import pytest

from bem3d import BEM
from compare.library.case import Variations
from compare.library.lookup import case_of
from compare.solving.curve import Curve, on_two_levels
from mdr1d import MDR
from scene import Kelvin, Scene, SelfAffine, Slide, Sphere


def seldom(names, often):
    """Names to parametrise a test by, of which those that are not asked often are slow."""
    return [pytest.param(each, marks=() if each in often else pytest.mark.slow) for each in names]


SLIDING = Scene(
    indenter=Sphere(radius=1e-2),
    elastomer=Kelvin(modulus=1e6, relaxation_time=1e-3),
    motion=Slide(speed=0.1, load=1.0),
    roughness=SelfAffine(hurst=0.2, rms_height=1e-6, longest=1e-2, shortest=1e-3, seed=5),
)
TINY = replace(
    case_of(SLIDING),
    title="A <rough> sphere & more",
    study=Variations(
        speeds=(0.1, 1.0), pressing=(0.5, 2.0), load_speeds=(0.1,), depths=(1.0,), surfaces=2, profiles=2
    ),
    bem=BEM(points=32),
    mdr=MDR(points=500),
)

WAVY = SelfAffine(hurst=0.5, rms_height=1e-5, longest=2e-3, shortest=5e-4, seed=3)
CURVE = Curve(
    scene=Scene(Sphere(radius=1e-2), Kelvin(1e6, 1e-3), Slide(speed=0.1, load=0.5), WAVY),
    speeds=(0.1, 0.0, 0.2),
    values=(0.5, 1.0),
    levels=on_two_levels(MDR(points=200), BEM(points=64)),
    draws={"MDR": 3, "BEM": 2},
)

HEAD = """
title = "Mine"
about = "What I ask."
"""
SHARED = """
speeds = ["50 mm/s", 0.1, 0.2]
loads = { least = "0.5 N", greatest = 2, count = 4 }
surfaces = 2
profiles = 3
"""
TABLES = """
[indenter]
type = "sphere"
radius = "10 mm"
[elastomer]
type = "kelvin"
modulus = "1 MPa"
relaxation_time = "1 ms"
[roughness]
type = "self-affine"
hurst = 0.2
rms_height = "50 um"
longest = "10 mm"
shortest = "2 mm"
seed = 1
[bem]
points = 32
[mdr]
points = 400
"""

SCENE = """
[indenter]
type = "sphere"
radius = 1e-2
[elastomer]
type = "kelvin"
modulus = 1e6
relaxation_time = 1e-3
[motion]
type = "slide"
speed = 0.1
load = 1.0
[roughness]
type = "self-affine"
hurst = 0.2
rms_height = 1e-6
longest = 1e-2
shortest = 1e-3
seed = 5
"""
# Few contacts, each on few points.
SMALL = """
[study]
speeds = [0.1, 1.0]
pressing = [0.5, 2.0]
load_speeds = [0.1]
depths = [1.0]
surfaces = 2
profiles = 2
[bem]
points = 32
[mdr]
points = 1000
"""
