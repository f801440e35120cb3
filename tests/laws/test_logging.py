"""What a library chose goes to `logging`: nothing is printed, and nothing is heard unless asked for."""

import logging
import re
import subprocess
import sys

import pytest

import bem3d
import mdr1d
from scene import Elastic, Indent, Scene, Sphere

PRESSED = Scene(Sphere(radius=1e-2), Elastic(modulus=1e6), Indent(load=1.0))
SOLVERS = {"bem3d": bem3d.BEM(points=32), "mdr1d": mdr1d.MDR(points=100)}


@pytest.mark.parametrize("name", SOLVERS)
def test_a_solver_tells_what_it_chose_and_prints_nothing(name, caplog, capfd):
    with caplog.at_level(logging.INFO, name):
        result = SOLVERS[name].solve(PRESSED)
    (record,) = (each for each in caplog.records if each.name == f"{name}.solver")
    assert str(result.settings["extent"]) in record.getMessage()
    caplog.clear()
    SOLVERS[name].solve(PRESSED)
    assert not caplog.records
    assert capfd.readouterr() == ("", "")


def test_a_solver_that_chooses_its_grid_tells_every_grid(caplog):
    with caplog.at_level(logging.INFO, "bem3d"), pytest.warns(bem3d.Unconfirmed):
        bem3d.for_accuracy(PRESSED, depth=1e-7)
    messages = [each.getMessage() for each in caplog.records if each.name == "bem3d.accuracy"]
    assert messages[0].startswith("32 points a side")
    assert len(messages) > 1


def test_nothing_is_said_on_import():
    program = "import logging; logging.basicConfig(level=0); import scene, mdr1d, bem3d, compare; compare.run"
    heard = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert not heard.stdout
    assert not re.findall(r"^\w+:(?:scene|mdr1d|bem3d|compare)\b", heard.stderr, re.MULTILINE)
