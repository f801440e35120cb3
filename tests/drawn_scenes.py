"""Scenes that are drawn: every kind of motion, from a lift to full contact, on few points."""

from scene import (
    Cylinder,
    Elastic,
    Indent,
    Kelvin,
    Plane,
    Program,
    Scene,
    SelfAffine,
    Slide,
    Sphere,
    Stage,
    StandardLinearSolid,
)

R, G, TAU, LOAD = 1e-2, 1e6, 1e-3, 1.0
KELVIN, STANDARD = Kelvin(G, TAU), StandardLinearSolid(G, 10 * G, TAU)
# Radius of the smooth contact at rest.
A = (3 * LOAD * R / (16 * G)) ** (1 / 3)
ROUGH = SelfAffine(hurst=0.2, rms_height=5e-5, longest=1e-2, shortest=5e-4, seed=1)
PAPER = Scene(Sphere(R), KELVIN, Slide(speed=0.1, load=LOAD), ROUGH)
CELL = SelfAffine(hurst=0.8, rms_height=2e-6, longest=1e-3, shortest=1.25e-4, seed=1)
LIFT = Program(stages=(Stage(duration=TAU, load=LOAD), Stage(duration=TAU, load=0.0), Stage(duration=2 * TAU)))
DIP = Program(stages=(Stage(duration=TAU, depth=5e-5, speed=0.3), Stage(duration=TAU, depth=0.0, speed=-0.3)))
SCENES = {
    "lift": Scene(Sphere(R), KELVIN, LIFT, ROUGH),
    "dip": Scene(Sphere(R), STANDARD, DIP),
    "plane": Scene(Plane(), STANDARD, Slide(speed=0.1, pressure=5e4), CELL),
    "full": Scene(Plane(), STANDARD, Slide(speed=0.1, pressure=5e7), CELL),
    "line": Scene(Cylinder(R), KELVIN, Slide(speed=0.1, line_load=100.0)),
    "rest": Scene(Sphere(R), KELVIN, Indent(load=LOAD)),
    "elastic": Scene(Sphere(R), Elastic(G), Indent(depth=1e-4)),
}
