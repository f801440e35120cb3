"""What is stored comes back as it was, under a name that changes with everything the answer depends on."""

import os
from dataclasses import replace

import numpy as np
import pytest

from compare.exact import Exact
from compare.outcome import Outcome, Row
from compare.store import Store, code_digest, key, write
from compare.study import Task
from mdr1d import MDR
from scene import Indent, Kelvin, Prony, Scene, SelfAffine, Slide, Sphere

SCENE = Scene(
    Sphere(radius=1e-2),
    Kelvin(modulus=1e6, relaxation_time=1e-3),
    Slide(speed=0.1, load=1.0),
    SelfAffine(hurst=0.5, rms_height=1e-6, longest=1e-2, seed=3),
)
TASK = Task(MDR(points=100), (SCENE,))
ROW = Row(1.0, 1e-4, 0.1, 1e-9, 12.0, 0.5, {"pixel": 1e-6, "odd": np.nan}, {"points": 100, "cutoff": None})


def test_rows_come_back_digit_for_digit(tmp_path):
    awkward = replace(ROW, normal_force=1 / 3, friction_force=np.nextafter(0.1, 1))
    Store(tmp_path).put(TASK, Outcome((awkward,)))
    (found,) = Store(tmp_path).get(TASK).rows
    assert replace(found, measures={}) == replace(awkward, measures={})
    assert found.measures["pixel"] == 1e-6
    assert np.isnan(found.measures["odd"])


def test_failures_come_back_as_nan_with_their_reason(tmp_path):
    Store(tmp_path).put(TASK, Outcome((Row(reason="did not converge"),)))
    (found,) = Store(tmp_path).get(TASK).rows
    assert np.isnan(found.normal_force)
    assert found.reason == "did not converge"


def test_fields_come_back_and_are_missed_where_they_are_wanted(tmp_path):
    store, picture = Store(tmp_path), replace(TASK, keeps_fields=True)
    store.put(TASK, Outcome((ROW,)))
    assert store.get(TASK) is not None
    assert store.get(picture) is None
    store.put(picture, Outcome((ROW,), {"x": np.arange(3.0)}))
    assert np.array_equal(store.get(picture).fields["x"], np.arange(3.0))


@pytest.mark.parametrize("cut", [0, 1, 40, -3])
def test_a_half_written_file_counts_as_absent(tmp_path, cut):
    store = Store(tmp_path)
    store.put(TASK, Outcome((ROW,)))
    (path,) = tmp_path.glob("*.json")
    path.write_bytes(path.read_bytes()[:cut])
    assert store.get(TASK) is None


def test_a_file_of_something_else_counts_as_absent(tmp_path):
    store = Store(tmp_path)
    for text in ("[]", "{}", '{"rows": []}', '{"rows": [{"normal_force": 1}]}', "\xff"):
        (tmp_path / f"{key(TASK)}.json").write_text(text, encoding="latin-1")
        assert store.get(TASK) is None


@pytest.mark.parametrize("text", ["NaN", "Infinity", '"NaN"', "true and more", "[]"])
def test_what_is_no_number_counts_as_absent(tmp_path, text):
    store = Store(tmp_path)
    store.put(TASK, Outcome((ROW,)))
    (path,) = tmp_path.glob("*.json")
    whole = path.read_text()
    for old in ('"depth": 0.0001', '"pixel": 1e-06'):
        assert old in whole
        path.write_text(whole.replace(old, f"{old.split()[0]} {text}"))
        assert store.get(TASK) is None


def test_damaged_fields_count_as_absent_whichever_byte_it_is(tmp_path):
    store, picture = Store(tmp_path), replace(TASK, keeps_fields=True)
    store.put(picture, Outcome((ROW,), {"x": np.arange(300.0)}))
    (path,) = tmp_path.glob("*.npz")
    whole = path.read_bytes()
    for cut in (0, 1, len(whole) // 2, len(whole) - 3):
        path.write_bytes(whole[:cut])
        assert store.get(picture) is None
    for place in range(0, len(whole), 7):
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 0xFF]) + whole[place + 1 :])
        found = store.get(picture)
        # A date may change; a number may not.
        assert found is None or np.array_equal(found.fields["x"], np.arange(300.0))


def test_a_task_whose_fields_are_empty_is_done(tmp_path):
    store, picture = Store(tmp_path), replace(TASK, keeps_fields=True)
    store.put(picture, Outcome((ROW,)))
    assert store.get(picture).fields == {}


def test_a_write_that_breaks_off_leaves_the_old_file_and_no_other(tmp_path):
    path = tmp_path / "numbers.json"
    path.write_text("old")

    def broken(file):
        file.write(b"ne")
        raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        write(path, broken)
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["numbers.json"]
    write(path, lambda file: file.write(b"new"))
    assert path.read_text() == "new"
    assert os.listdir(tmp_path) == ["numbers.json"]


def test_the_name_changes_with_everything_that_the_answer_depends_on():
    prony = Prony(equilibrium_modulus=1e6, moduli=(1e6,), relaxation_times=(1e-3,))
    rough = SCENE.roughness
    others = [
        replace(TASK, scenes=(replace(SCENE, indenter=Sphere(radius=1.0000000000000002e-2)),)),
        replace(TASK, scenes=(replace(SCENE, elastomer=prony),)),
        replace(TASK, scenes=(replace(SCENE, motion=Slide(speed=0.1, depth=1.0)),)),
        replace(TASK, scenes=(replace(SCENE, motion=Indent(load=1.0)),)),
        replace(TASK, scenes=(replace(SCENE, roughness=None),)),
        replace(TASK, scenes=(replace(SCENE, roughness=replace(rough, seed=4)),)),
        replace(TASK, scenes=(SCENE, SCENE)),
        replace(TASK, solver=MDR(points=101)),
        replace(TASK, solver=MDR(points=100, extent=1e-2)),
        replace(TASK, solver=Exact()),
    ]
    assert len({key(task) for task in [TASK, *others]}) == 1 + len(others)
    assert key(replace(TASK, work=7.0)) == key(Task(MDR(points=100), (replace(SCENE),)))


def test_the_digest_of_code_changes_with_content_and_name(tmp_path):
    (tmp_path / "a.py").write_text("x = 1\n")
    first = code_digest(tmp_path)
    (tmp_path / "notes.txt").write_text("no code")
    assert code_digest(tmp_path) == first
    (tmp_path / "a.py").write_text("x = 2\n")
    second = code_digest(tmp_path)
    (tmp_path / "a.py").rename(tmp_path / "b.py")
    assert len({first, second, code_digest(tmp_path)}) == 3
