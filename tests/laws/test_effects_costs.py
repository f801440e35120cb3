"""What every effect costs: plans and the page have the measured costs, and failures are reported."""

import csv
from dataclasses import fields
from math import nan

import pytest
from effects import COUNTED, MEASURED, effects

import bem3d.plan
import mdr1d.plan
from bem3d import BEM
from mdr1d import MDR
from scene import Layer, Program, Scene
from scene.plan import expected, multiples
from scene.terms import Unsupported


@pytest.fixture(scope="module")
def stored():
    """Rows of the measured costs."""
    with MEASURED.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


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
            assert any(found and found > 0 for found in measured), kind


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
            applications = (
                float(row["operator_applications"]) / float(rows[effect.over]["operator_applications"]) / steps
            )
            # written to three digits
            assert multiples(table)[part] == pytest.approx(applications, rel=5.01e-3)


def test_multiples_of_parts_are_multiplied_and_unknown_ones_are_named(tmp_path):
    table = tmp_path / "table.csv"
    table.write_text("part,operator_applications\nLayer,2.0\n", encoding="utf-8")
    found = expected(lambda: 10.0, "plain", [Layer(thickness=1.0)], table)
    assert found.value == 20.0
    assert found.times(4, "four").value == 80.0
    found = expected(lambda: pytest.fail("asked for nothing"), "plain", [Layer(thickness=1.0), nan], table)
    assert found.value is None
    assert "what float takes was not measured" in str(found)
