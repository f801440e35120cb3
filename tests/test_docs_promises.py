"""The ladder behind settings for a wanted accuracy, and the count of promises promises."""

from math import inf, nan

import numpy as np
import pytest
from promises_page import ladder, promises

from bem3d import accuracy
from bem3d.accuracy import BANDS, band
from compare.outcome import Outcome, Row
from scene.protocol import refuse


def row(friction, contact=1e4, pixel=1e-3, **changed):
    measures = {"contact_points": contact, "points_across_contact": 100.0, "pixel": pixel}
    estimates = {f"friction_by_{name}": friction for name in ("traction", "loss", "curvature")}
    return Row(1.0, 0.01, friction, 0.0, 1.0, 0.5, measures | estimates, **changed)


def smooth_probe():
    return next(each for each in ladder.probes() if each.quantities == ("friction", "depth"))


def test_every_probe_and_every_scene_asked_is_one_that_is_not_refused():
    asked = [(task.solver, each.scene) for each in ladder.probes() for task in each.tasks[-1:]]
    asked += [(promises.truth(scene).solver, scene) for scene in promises.scenes()]
    for solver, scene in asked:
        refuse(solver, scene)
    bands = {(each.body, band(each.scene)) for each in ladder.probes()}
    assert bands == {(body, each) for body in ("smooth", "rough") for each in BANDS}
    assert {kind[:2] for kind in accuracy.ladder()} == bands


def test_no_scene_asked_is_one_of_the_ladder():
    assert not {each.scene for each in ladder.probes()} & set(promises.scenes())


def test_the_ladder_keeps_the_largest_error_of_all_that_is_resolved_as_finely_or_more():
    probe = smooth_probe()
    counts = np.array(probe.points, float)
    # A contact that fills its grid, friction off by one over the points, but for one grid on which it is far off.
    frictions = 1 + 1 / counts
    frictions[2], frictions[-1] = 1.5, 1.0
    rows = [row(mu, n * n) for n, mu in zip(counts, frictions, strict=True)]
    outcomes = {task: Outcome((each,)) for task, each in zip(probe.tasks, rows, strict=True)}
    found = [each for each in ladder.rows([probe] * 3, outcomes) if each["quantity"] == "friction"]
    errors = {each["resolution"]: each["value"] for each in found}
    missing = {n: ladder.missing(n, probe.points[-1]) for n in probe.points[:-1]}
    worst = 0.5 * missing[probe.points[2]]
    for resolution, error in errors.items():
        finer = [n for n in probe.points[:-1] if 2 * n / np.sqrt(np.pi) >= resolution]
        expected = max([missing[n] / n for n in finer] + [worst] * (probe.points[2] in finer))
        assert error == pytest.approx(expected, rel=5e-3)  # of three digits
    assert list(errors.values()) == sorted(errors.values(), reverse=True)


def test_a_failed_answer_is_no_rung_and_a_failed_truth_none_at_all():
    probe = smooth_probe()
    rows = [row(1.1, n * n) for n in probe.points]
    failed = Row(reason="does not converge")
    for place, left in ((0, len(rows) - 2), (-1, 0)):
        answers = [failed if k == place % len(rows) else each for k, each in enumerate(rows)]
        outcomes = {task: Outcome((each,)) for task, each in zip(probe.tasks, answers, strict=True)}
        found = ladder.rows([probe] * 3, outcomes)
        assert sum(each["quantity"] == "friction" for each in found) <= left
        assert all(np.isfinite(each["value"]) for each in found)


def test_what_is_missing_of_an_error_of_first_order_is_made_up():
    exact, slope = 2.0, 0.3
    value = {n: exact + slope / n for n in (64, 256, 512)}
    for n in (64, 256):
        error = abs(value[n] - value[512]) * ladder.missing(n, 512)
        assert error == pytest.approx(abs(value[n] - exact))


def entry(**changed):
    whole = {"quantity": "friction", "wanted": 0.01, "points": 64.0, "error": 0.005, "change": 0.008, "reason": ""}
    return whole | changed


def test_promises_are_counted_by_what_became_of_them():
    entries = [
        entry(),
        entry(error=0.02),  # broken, and confirmed
        entry(change=0.05),  # kept, and not confirmed
        entry(error=nan, change=inf, reason="no converged contact"),  # made, without an answer
        entry(error=nan),  # made, and too fine to be checked
        entry(points=nan, error=nan, change=nan, reason="less than was measured"),  # not made
    ]
    (found,) = (each for each in promises.kept(entries) if each["wanted"] == 0.01)
    counts = {
        name: found[name] for name in ("asked", "made", "checked", "kept", "confirmed", "confirmed_and_kept")
    }
    assert counts == {"asked": 6, "made": 5, "checked": 4, "kept": 2, "confirmed": 2, "confirmed_and_kept": 1}
    assert found["worst_error"] == pytest.approx(0.02)


def test_a_truth_less_than_twice_as_fine_checks_nothing():
    task = promises.asked()[0]
    truth = Outcome((row(1.0),))
    for points, checked in ((promises.FINEST / 2, True), (promises.FINEST / 2 + 2, False)):
        answer = row(1.01)
        answer.measures.update(points=points, expected=0.02, change=0.01, promised_seconds=1.0)
        (found,) = promises.rows([task], {task: Outcome((answer,)), promises.truth(task.scene): truth})
        assert np.isfinite(found["error"]) == checked


def test_a_promise_made_with_another_ladder_is_another_task(tmp_path, monkeypatch):
    task = promises.asked()[0]
    before = task.question
    other = tmp_path / "ladder.csv"
    other.write_text("body,band,quantity,resolution,value,answers\n", encoding="utf-8")
    monkeypatch.setattr(promises, "LADDER", other)
    assert task.question != before
