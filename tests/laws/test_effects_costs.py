"""What every effect costs: plans and the page have the measured costs, and failures are told."""

import csv
import re
from dataclasses import fields
from math import isnan, nan

import pytest
from effects import COUNTED, PAGE, cells, costs, effects, priced, sheet, tasks

import bem3d.plan
import mdr1d.plan
from bem3d import BEM
from bem3d.surface import RoughSurface
from compare.solving.outcome import Outcome, Row
from mdr1d import MDR
from scene import Layer, Program, Scene
from scene.plan import COSTS, expected, multiples
from scene.terms import Unsupported

TITLES = [effect.title for effect in effects()]


@pytest.fixture(scope="module")
def stored():
    """Rows of the measured costs."""
    with PAGE.with_suffix(".csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_the_page_has_the_measured_costs(stored):
    page = PAGE.read_text(encoding="utf-8")
    rows = re.search(r"<!-- effects -->\n.*\n.*\n((?:\|.*\n)*)<!-- end -->", page)[1].splitlines()
    assert rows == [f"| {' | '.join(row)} |" for row in cells(stored)]


def test_the_measured_surface_is_the_drawn_one():
    # costs of both are compared: the same surface, not one with a plane taken off its period
    asked = {each.title: each.scene.roughness for each in effects()}
    map_, drawn = asked["measured topography"], asked["roughness"]
    surface = RoughSurface.of(drawn, drawn.q_max(0.0))
    assert map_.rms_height == pytest.approx(surface.rms_height, rel=1e-9)
    assert map_.waves.rms_slope == pytest.approx(surface.rms_slope, rel=1e-9)


def test_every_part_that_a_scene_may_lack_is_asked_for():
    optional = {each.name for each in fields(Scene) if each.default is None}
    assert optional == {name for effect in effects() for name in effect.scene.parts} & optional
    assert Program in {type(effect.scene.motion) for effect in effects()}


def test_plans_know_the_costs_of_every_part_that_the_solver_has():
    known = {
        BEM: (bem3d.plan.PRICED, bem3d.plan.EFFECTS),
        MDR: (mdr1d.plan.COUNTED, mdr1d.plan.EFFECTS),
    }
    unmeasured = {"Measured", "Cylinder", "Plane", "Wave"}  # the ladder has none of them, or too few
    for solver, (counted, table) in known.items():
        for kind, line in solver.terms.items():
            if kind.__name__ in unmeasured or issubclass(kind, counted):
                continue
            if not isinstance(line, type) and isinstance(line("", None), Unsupported):
                continue
            measured = [multiples(table).get(each.__name__) for each in (kind, *kind.__subclasses__())]
            assert any(found and all(found[cost] > 0 for cost in COSTS) for found in measured), kind


@pytest.mark.parametrize(("dimension", "table"), [("3D", bem3d.plan.EFFECTS), ("1D", mdr1d.plan.EFFECTS)])
def test_what_plans_multiply_costs_with_was_measured_together_with_the_page(stored, dimension, table):
    rows = {row["effect"]: row for row in stored if row["dimension"] == dimension}
    for effect in effects():
        for part in effect.parts:
            row = rows[effect.title]
            if row["reason"] or part in COUNTED[dimension]:
                assert part not in multiples(table)
                continue
            steps = 1.0 if row["time_steps"] == "nan" else float(row["time_steps"])
            seconds = float(row["times"]) / steps
            applications = (
                float(row["operator_applications"]) / float(rows[effect.over]["operator_applications"]) / steps
            )
            # written to three digits
            assert multiples(table)[part] == pytest.approx(
                {"operator_applications": applications, "seconds": seconds}, rel=5.01e-3
            )


def outcomes(failed="layer", seconds=1.0):
    """Of all tasks, each effect by its place a second dearer; one fails."""
    solved = {}
    for (_, title), task in tasks().items():
        place = TITLES.index(title)
        measures = {"processor": seconds * (1 + place), "wall": 1.0, "repeats": 3.0}
        if isinstance(task.scenes[0].motion, Program):
            measures["time_steps"] = 100.0
        row = Row(1.0, 1.0, 1.0, 0.0, 10.0, 1.0, measures)
        if title == failed:
            row = Row(reason="did not converge")
        solved[task] = Outcome((row,))
    return solved


def test_times_are_those_of_the_effect_that_it_comes_on_top_of_and_a_solve_that_fails_is_no_cheap_one():
    found = costs(outcomes())
    three, one = ({each.effect.title: each for each in found[name]} for name in ("3D", "1D"))
    times = (TITLES.index("partial slip") + 1) / (TITLES.index("contact at rest") + 1)
    assert three["partial slip"].times == times
    assert one["steady sliding"].times == 1.0
    layer = three["layer"]
    assert isnan(layer.times)
    assert layer.row.reason == "did not converge"
    assert "Layer" not in {row["part"] for row in priced("3D", found["3D"])}
    reasons = {row["dimension"]: row["reason"] for row in sheet(found) if row["effect"] == "layer"}
    assert reasons["3D"] == "did not converge"
    assert reasons["1D"].startswith("refused")


def test_a_program_is_told_by_the_step_and_only_where_steps_are_not_counted():
    found = costs(outcomes())
    (program,) = (row for row in priced("3D", found["3D"]) if row["part"] == "Program")
    place, rest = TITLES.index("program") + 1, TITLES.index("contact at rest") + 1
    assert program["seconds"] == pytest.approx(place / rest / 100, rel=1e-2)
    assert "Program" not in {row["part"] for row in priced("1D", found["1D"])}


def test_multiples_of_parts_are_multiplied_and_unknown_ones_are_named(tmp_path):
    table = tmp_path / "table.csv"
    table.write_text("part,operator_applications,seconds\nLayer,2.0,3.0\n", encoding="utf-8")
    found = expected(
        lambda: {"operator_applications": 10.0, "seconds": 1.0}, "plain", [Layer(thickness=1.0)], table
    )
    assert (found["operator_applications"].value, found["seconds"].value) == (20.0, 3.0)
    assert found["seconds"].times(4, "four").value == 12.0
    found = expected(lambda: pytest.fail("asked for nothing"), "plain", [Layer(thickness=1.0), nan], table)
    assert found["seconds"].value is None
    assert "what float takes was not measured" in str(found["seconds"])
