"""The experiment of the paper in three dimensions: its numbers have to come out of curves that have them."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from bem3d import BEM
from compare.solving.outcome import Outcome, Row
from compare.solving.task import draws_of
from compare.studies.experiment import check
from compare.studies.experiment.contact import RoughBall
from compare.studies.experiment.curves import measured, two_lines
from compare.studies.experiment.setup import HALF_SPACE as HALF
from compare.studies.experiment.setup import LOADS, LOSSY, MAIN, POWER, RELAXED, SIZES, SOLIDS, SPEEDS, STIFF, THIN
from compare.studies.experiment.study import ExperimentStudy, _finding
from scene import SolveError

SMALL = SIZES["quick"].spectra[:2]


def ball(pair, load=10.0, speed=0.01, solid=SOLIDS["power law, 0.03 at contact"], spectra=SMALL):
    return RoughBall(pair.scene(solid, speed, load), spectra, 64)


def solved(*args, **kwargs):
    return ball(*args, **kwargs).solve().rows[0]


def test_hertz_has_the_contact_as_wide_as_the_layer_at_the_force_of_the_paper():
    """F = (16/3) G a^3/R of an incompressible solid at a = D/2; the paper rounds to 40 N."""
    assert MAIN.crossover == pytest.approx(16 / 3 * RELAXED * (MAIN.thickness / 2) ** 3 / MAIN.radius)
    assert MAIN.crossover == pytest.approx(40.0)
    assert THIN.crossover == pytest.approx(MAIN.crossover / 8)
    assert HALF.crossover == MAIN.crossover


def test_a_thick_layer_is_a_half_space_and_a_thin_one_is_not():
    """The thin one is felt at 100 N, 20 times its force of the paper."""
    half = solved(HALF, 100.0)
    for name in ("friction_of_shape", "friction_of_roughness", "contact_area"):
        assert solved(replace(MAIN, thickness=1.0), 100.0).measures[name] == pytest.approx(
            half.measures[name], rel=0.01
        )
    assert solved(THIN, 100.0).measures["contact_area"] < 0.9 * half.measures["contact_area"]


def test_friction_of_the_smooth_ball_goes_with_the_speed_as_the_loss():
    """Where the modulus at contact is that at rest; 3 % are in the rise of that modulus."""
    slow, fast = (solved(MAIN, speed=speed).measures["friction_of_shape"] for speed in (0.005, 0.02))
    assert np.log(fast / slow) / np.log(4) == pytest.approx(POWER, rel=0.05)


def test_roughness_adds_friction_that_the_smooth_ball_lacks():
    row = solved(MAIN)
    parts = row.measures["friction_of_shape"], row.measures["friction_of_roughness"]
    assert row.friction_force == pytest.approx(sum(parts))
    assert min(parts) > 0
    half = replace(SMALL[0], rms_height=SMALL[0].rms_height / 2)
    assert solved(MAIN, spectra=(half,)).measures["friction_of_roughness"] < 0.9 * parts[1]


def test_a_broken_line_has_its_break_and_its_slopes():
    x = np.log(LOADS)
    y = np.where(x < np.log(20.0), -0.1, -0.6) * (x - np.log(20.0))
    place, light, heavy, left = two_lines(x, y)
    assert np.exp(place) == pytest.approx(20.0, rel=0.02)
    assert (light, heavy) == pytest.approx((-0.1, -0.6), abs=0.01)
    assert left < 0.01


def test_a_broken_curve_is_told_from_a_parabola():
    x = np.log(LOADS * (SPEEDS / SPEEDS[2])[:, None] ** 0.3)
    broken, bent = np.exp(np.where(x < 3, -0.1, -0.6) * (x - 3)), np.exp(-0.1 * x**2)
    found, other = (measured(LOADS, SPEEDS, mu / 2, mu / 2) for mu in (broken, bent))
    assert found["two-lines"] < 0.01 < 0.1 < found["one-line"]
    assert found["over-cubic"] < 0.2 < 5 < other["over-cubic"]


def test_power_laws_collapse_along_force_and_friction_alike():
    mu = LOADS**-0.5 * (SPEEDS**0.15)[:, None]
    found = measured(LOADS, SPEEDS, 0.2 * mu, 0.8 * mu)
    assert found["unshifted"] > 0.03
    assert found["collapse"] == pytest.approx(found["along-friction"], abs=1e-6)
    assert found["same"] == pytest.approx(0.0, abs=1e-6)
    assert found["exponent"] == pytest.approx(-0.3, rel=0.01)
    assert np.isnan(found["break"])
    assert found["one-line"] < 1e-9
    assert found["predicted"] == pytest.approx(found["unshifted"] / 2, rel=0.05)
    assert found["ball-light"] == pytest.approx(0.2)


def test_a_curve_shifted_along_force_alone_is_told_from_one_shifted_along_friction():
    """Eq. 22 with its exponent of the shift, which the numbers give back."""
    xi = 0.1 * LOADS * (SPEEDS / SPEEDS[0])[:, None] ** -1.5
    mu = (1 + xi**1.5) ** (-1 / 1.5)
    found = measured(LOADS, SPEEDS, mu / 2, mu / 2)
    assert found["collapse"] < 0.01 < 0.05 < found["along-friction"]
    assert found["exponent"] == pytest.approx(-1.5, rel=0.02)


def test_a_claim_is_decided_only_where_all_that_is_open_agrees():
    study = ExperimentStudy.of("quick")
    answers = study.answers(
        {each: Outcome((Row(measures=curve(each)),) * len(each.spectra)) for each in study.batches()[0].tasks}
    )
    members = study.members(answers)
    assert _finding("slope-light", members, "here").verdict == "holds"
    members.loc[3, "slope-light"] = 0.2
    split = _finding("slope-light", members, "here")
    assert (split.verdict, split.interval[1]) == ("undecided", 0.2)


def curve(task):
    """Numbers of a task whose friction is a power law."""
    load = task.scene.motion.load
    part = load ** (2 / 3) * task.scene.motion.speed**0.1
    return {
        "friction_of_shape": 0.1 * part,
        "friction_of_roughness": 0.4 * part,
        "pressure_ratio": 0.1,
        "contact_area": pi * 1e-6 * load ** (2 / 3),
    }


def test_a_failed_solve_is_no_number_and_keeps_its_reason(monkeypatch):
    def fails(self, scene):
        raise SolveError("the contact left the grid")

    monkeypatch.setattr(BEM, "solve", fails)
    outcome = ball(MAIN).solve()
    assert [row.reason for row in outcome.rows] == ["the contact left the grid"] * len(SMALL)
    assert np.isnan([row.friction_force for row in outcome.rows]).all()
    mu = np.ones((len(SPEEDS), len(LOADS))) * LOADS**-0.2
    mu[2, 4] = np.nan
    assert measured(LOADS, SPEEDS, mu, mu)["slope-light"] == pytest.approx(-0.2)


@pytest.mark.slow
@pytest.mark.parametrize(("solid", "height"), [(LOSSY, 0.01), (STIFF, 0.01), (LOSSY, 0.04)])
def test_the_law_holds_on_the_layer(solid, height):
    """To 5 %, as it does on a half-space; four surfaces of height 0.04 scatter by as much again."""
    smooth, rough = check.contact(solid, height, THIN)
    draws = draws_of(replace(smooth, roughness=rough), 4)
    friction = np.mean([BEM(points=check.POINTS).solve(each).friction_force for each in draws])
    law = RoughBall(smooth, (rough,), 128).solve().rows[0]
    assert law.friction_force == pytest.approx(friction, rel=0.05 if height < 0.02 else 0.1)
    assert law.measures["friction_of_shape"] < 0.9 * friction
