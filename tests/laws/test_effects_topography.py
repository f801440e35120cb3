"""The chapter on measured topography: every way of every contact is asked, and numbers come from the answers."""

from math import sqrt

import numpy as np
import pytest
from effects_page import topography as study
from effects_page.asked import effects
from effects_page.figures import topography as drawing

from bem3d.surface import RoughSurface
from compare.solving.outcome import Outcome, Row
from compare.solving.store import key


def test_the_measured_surface_of_the_page_is_the_drawn_one():
    # costs of both are compared: the same surface, not one with a plane taken off its period
    asked = {each.title: each.scene.roughness for each in effects()}
    map_, drawn = asked["measured topography"], asked["roughness"]
    surface = RoughSurface.of(drawn, drawn.q_max(0.0))
    assert map_.rms_height == pytest.approx(surface.rms_height, rel=1e-9)
    assert map_.waves.rms_slope == pytest.approx(surface.rms_slope, rel=1e-9)


def outcomes(force=1.0, friction=0.1):
    """Answers as if solved: each way a little off the others, by the seed."""
    found = {}
    for task in study.tasks():
        slides = task.scenes[0].motion.speed > 0
        way = 1.0 if task.solver.name == "BEM" else 0.8
        found[task] = Outcome(
            tuple(
                Row(normal_force=way * force * (1 + 0.01 * k), friction_force=way * friction if slides else 0.0)
                for k, _ in enumerate(task.scenes)
            )
        )
    return found


def test_the_study_asks_every_way_of_every_contact():
    asked = study.tasks()
    contacts = len(study.DEPTHS) + len(study.SPEEDS)
    assert len(asked) == len({key(task) for task in asked}) == 4 * contacts
    assert {len(task.scenes) for task in asked} == {1, study.PLACES, study.LINES}
    for task in asked:
        assert not task.solver.refusals(task.scenes[0])


def test_the_chapter_is_computed_from_the_answers():
    chapter = study.chapter(outcomes())
    rows = chapter.data[drawing.NAME]
    one = next(row for row in rows if row["way"] == study.SURFACES and row["quantity"] == "force")
    values = 1 + 0.01 * np.arange(study.PLACES)
    assert one["mean"] == pytest.approx(values.mean())
    # Student's t of seven freedoms, 2.365
    assert one["high"] - one["mean"] == pytest.approx(2.3646 * values.std(ddof=1) / sqrt(study.PLACES), rel=1e-4)
    table = chapter.tables["Force at a depth, friction under a load"]
    assert len(table) == len(study.DEPTHS) + len(study.SPEEDS)
    other = study.chapter(outcomes(force=2.0)).tables["Force at a depth, friction under a load"]
    assert other[0][study.SURFACES] != table[0][study.SURFACES]
    assert len(chapter.figures[drawing.NAME].axes) == 2
