"""The example of the paper's experiment: laws that it keeps, and its numbers on the page."""

from math import log
from pathlib import Path

import experiment
import numpy as np
import pytest
from experiment import CROSSOVER, LOADS, MODULUS, POWER, RADIUS, ROUGH, SPEEDS, THICKNESS, ball, friction

PAGE = Path(__file__).parents[2] / "docs" / "results" / "paper.md"


def test_hertz_has_the_contact_as_wide_as_the_layer_at_the_force_of_the_paper():
    """F = (16/3) G a^3/R of an incompressible solid at a = D/2; the paper rounds to 40 N."""
    assert pytest.approx(16 / 3 * MODULUS * (THICKNESS / 2) ** 3 / RADIUS) == CROSSOVER
    assert pytest.approx(40.0) == CROSSOVER


def test_a_thick_layer_is_a_half_space_and_a_thin_one_is_not():
    thick, half, thin = (friction(ball(100.0, 0.01, at), [*ROUGH.values()]) for at in (1.0, None, 0.005))
    assert thick == pytest.approx(half, rel=0.01)
    assert thin[0] < 0.9 * half[0]


def test_curves_of_eq_22_shift_along_the_force_alone_by_their_exponent():
    xi = 0.1 * LOADS * (SPEEDS / SPEEDS[0])[:, None] ** (-1.5 * POWER)
    found = experiment.numbers((1 + xi**1.5) ** (-1 / 1.5))
    shifted = "misfit, shifted along the force"
    # The interpolation between five curves that hardly differ.
    assert found[f"{shifted} at best [%]"] < 0.1
    assert found[f"{shifted} by the paper's power [%]"] < 0.1
    assert found["misfit before any shift [%]"] > 1


def test_a_broken_line_has_its_break_and_its_slopes():
    x = np.log(LOADS)
    y = np.where(x < log(20.0), -0.1, -0.6) * (x - log(20.0))
    place, light, heavy, left = experiment.two_lines(x, y)
    assert np.exp(place) == pytest.approx(20.0, rel=0.02)
    assert (light, heavy) == pytest.approx((-0.1, -0.6), abs=0.01)
    assert left < 0.01


@pytest.mark.slow
def test_the_page_has_the_numbers_of_the_example(monkeypatch, tmp_path, capsys):
    monkeypatch.chdir(tmp_path)
    experiment.main()
    assert (tmp_path / "experiment.png").is_file()
    printed = capsys.readouterr().out.splitlines()
    section = PAGE.read_text(encoding="utf-8").split("## The experiment")[1]
    rows = [row.strip("| ").split(" | ") for row in section.splitlines() if row[:1] == "|"]
    (titles, _, *rows), found = rows, {}
    for line in printed:
        if not line.startswith(" "):
            title = line
        else:
            name, value = line.strip().rsplit(": ", 1)
            found[title, name] = float(value)
    shown = {(title, row[0]): float(cell) for row in rows for title, cell in zip(titles, row[1:], strict=True)}
    assert len(shown) == 8
    for place, value in shown.items():  # two digits are printed
        assert value == pytest.approx(found[place], rel=0.05, abs=0.005), place
