"""Every effect as it is asked for, and what it costs: what a page says is computed, and failures are told."""

import csv
import tomllib
from dataclasses import fields
from math import isnan, nan
from pathlib import Path

import numpy as np
import pytest
from effects_page import costs
from effects_page.asked import PLAIN, SCENES, effects, measured

import bem3d.plan
import mdr1d.plan
from bem3d import BEM
from compare.solving.outcome import Outcome, Row
from mdr1d import MDR
from scene import Layer, Program, Scene
from scene.costs import COSTS, expected, multiples
from scene.terms import Lacking

PAGE = Path(__file__).parents[2] / "docs" / "results" / "effects" / "effect-costs.csv"
TITLES = [effect.title for effect in effects()]


@pytest.mark.parametrize("title", TITLES)
def test_the_lines_of_a_file_ask_for_the_scene_that_is_solved(title, tmp_path, monkeypatch):
    effect = effects()[TITLES.index(title)]
    np.save(tmp_path / "heights.npy", measured())
    monkeypatch.chdir(tmp_path)
    assert SCENES.validate_python({**PLAIN, **tomllib.loads(effect.file)}) == effect.scene


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
            if not isinstance(line, type) and isinstance(line("", None), Lacking):
                continue
            found = multiples(table)[kind.__name__]
            assert all(found[cost] > 0 for cost in COSTS), kind


@pytest.mark.parametrize(("dimension", "table"), [("3D", bem3d.plan.EFFECTS), ("1D", mdr1d.plan.EFFECTS)])
def test_what_plans_multiply_costs_with_was_measured_together_with_the_page(dimension, table):
    with PAGE.open(encoding="utf-8", newline="") as file:
        rows = {row["effect"]: row for row in csv.DictReader(file) if row["dimension"] == dimension}
    for effect in effects():
        for part in effect.parts:
            row = rows[effect.title]
            if row["reason"] or part in costs.COUNTED[dimension]:
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
    for rung in costs.tasks():
        place = next(k for k, effect in enumerate(effects()) if effect.scene == rung.scene)
        measures = {"processor": seconds * (1 + place), "wall": 1.0, "memory": 1e6, "repeats": 3.0}
        if isinstance(rung.scene.motion, Program):
            measures["time_steps"] = 100.0
        row = Row(1.0, 1.0, 1.0, 0.0, 10.0, 1.0, measures)
        if TITLES[place] == failed:
            row = Row(reason="did not converge")
        solved[rung] = Outcome((row,))
    return solved


def test_times_are_those_of_the_effect_that_it_comes_on_top_of_and_a_solve_that_fails_is_no_cheap_one():
    found = costs.costs(outcomes())
    three, one = ({each.effect.title: each for each in found[name]} for name in ("3D", "1D"))
    times = (TITLES.index("partial slip") + 1) / (TITLES.index("contact at rest") + 1)
    assert three["partial slip"].times == times
    assert one["steady sliding"].times == 1.0
    layer = three["layer"]
    assert isnan(layer.times)
    assert layer.row.reason == "did not converge"
    assert "Layer" not in {row["part"] for row in costs.tables(found)["3D"]}
    rows = costs.chapter(outcomes()).data[costs.DATA]
    reasons = {row["dimension"]: row["reason"] for row in rows if row["effect"] == "layer"}
    assert reasons["3D"] == "did not converge"
    assert reasons["1D"].startswith("refused")


def test_a_program_is_told_by_the_step_and_only_where_steps_are_not_counted():
    found = costs.tables(costs.costs(outcomes()))
    (program,) = (row for row in found["3D"] if row["part"] == "Program")
    place, rest = TITLES.index("program") + 1, TITLES.index("contact at rest") + 1
    assert program["seconds"] == pytest.approx(place / rest / 100, rel=1e-2)
    assert "Program" not in {row["part"] for row in found["1D"]}


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
