"""The numbers of README and of the page of answers are the stored ones, and the page of limits tells the truth."""

import re
from pathlib import Path

import answers
import numpy as np
import pandas
import pytest
import trust
import verify

from bem3d import BEM
from compare.solving.words import interval
from mdr1d import MDR
from scene import (
    CrossedWaves,
    Cylinder,
    Kelvin,
    Layer,
    Measured,
    Plane,
    Profile,
    Scene,
    SelfAffine,
    Slide,
    Spectrum,
    Sphere,
    Topography,
    Wave,
)

ROOT = Path(__file__).parents[2]
ROUGH = SelfAffine(hurst=0.7, rms_height=2e-5, longest=1e-2, shortest=2e-3)
LINE = 1e-6 * np.random.default_rng(2).normal(size=300).cumsum()
HEIGHTS = [[1e-6 * (k * m % 5) for k in range(16)] for m in range(16)]
PRESSED, ON_LINE, SPREAD = (
    Slide(speed=0.1, load=1.0),
    Slide(speed=0.1, line_load=1.0),
    Slide(speed=0.1, pressure=1e4),
)
SOLID, BODY = Kelvin(1e6, 1e-3), Sphere(1e-2)
# Scenes of a row of the table of limits.
OF_ROW = {
    "sphere, cone, power law": [Scene(BODY, SOLID, PRESSED)],
    "plane, cylinder, measured body": [
        Scene(Plane(), SOLID, SPREAD, ROUGH),
        Scene(Cylinder(1e-2), SOLID, ON_LINE),
        Scene(Measured(heights=HEIGHTS, pixel=1e-4), SOLID, PRESSED),
    ],
    "roughness `self-affine`, `spectrum`, `topography`, `profile`": [
        Scene(BODY, SOLID, PRESSED, ROUGH),
        Scene(BODY, SOLID, PRESSED, Spectrum(q=(1e3, 1e4), C2D=(1e-18, 1e-21), convention="jacobs")),
        Scene(BODY, SOLID, PRESSED, Topography(heights=HEIGHTS, pixel=1e-4)),
        Scene(BODY, SOLID, PRESSED, Profile(heights=LINE, spacing=1e-5)),
    ],
    "roughness `wave`, `crossed-waves`": [
        Scene(BODY, SOLID, PRESSED, Wave(amplitude=1e-5, wavelength=2e-3)),
        Scene(BODY, SOLID, PRESSED, CrossedWaves(amplitude=1e-5, wavelength=2e-3)),
    ],
    "layer": [Scene(BODY, SOLID, PRESSED, layer=Layer(thickness=1e-2))],
}


@pytest.fixture(scope="module")
def parts():
    return answers.parts()


def test_every_number_of_the_readme_and_of_the_answers_is_the_stored_one(parts):
    for (page, name), text in parts.items():
        stands = re.search(rf"<!-- {name} -->\n(.*?)\n<!-- end -->", page.read_text(encoding="utf-8"), re.DOTALL)[
            1
        ]
        assert stands == text.strip(), f"{page.name}, {name}: run python docs/measure/answers.py"


def test_errors_are_told_as_measured():
    used = trust.used(trust.of_surfaces(trust.scores(), "spectrum")[trust.BEST])
    found = [float(each) for each in re.findall(r"([\d.]+) %", trust.corrected())]
    assert found == pytest.approx(100 * np.quantile(np.abs(used["off"]), (0.5, 0.9)), abs=0.05)


@pytest.mark.parametrize("row", OF_ROW)
def test_a_solver_refuses_exactly_the_scenes_that_the_page_of_limits_says(row):
    page = (ROOT / "docs" / "explanation" / "limits.md").read_text(encoding="utf-8")
    one, three = re.search(rf"^\| {re.escape(row)} \| (\w+)[^|]*\| (\w+)", page, re.MULTILINE).groups()
    for scene in OF_ROW[row]:
        for solver, cell in ((MDR(points=2000), one), (BEM(points=64), three)):
            assert {"yes": False, "refused": True}[cell] == bool(solver.refusals(scene)), (solver.name, scene)


def test_pages_without_a_command_have_the_numbers_of_stored_findings():
    results = ROOT / "docs" / "results"
    found = pandas.read_csv(results / "paper" / "findings.csv")
    shown = re.findall(r"[−\d.]+ \([−\d.]+ to [−\d.]+\)", (results / "paper.md").read_text(encoding="utf-8"))
    stored = {interval(row.value, row.low, row.high) for row in found.itertuples()}
    assert len(shown) == 9
    assert set(shown) <= stored
    assert verify.PAGE.read_text(encoding="utf-8").endswith(verify.hard())
