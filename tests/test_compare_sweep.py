"""Tasks are solved once, in parallel, and one that fails takes no other with it."""

import os
import signal
from dataclasses import replace

import numpy as np
import pytest
from pydantic.dataclasses import dataclass

from compare.store import Store
from compare.study import Task
from compare.sweep import ONE_THREAD, sweep
from scene import EmptyContact, Indent, Kelvin, Result, Scene, SolveError, Sphere

SCENE = Scene(Sphere(radius=1e-2), Kelvin(modulus=1e6, relaxation_time=1e-3), Indent(load=1.0))


@dataclass(frozen=True)
class Stand:
    """Answers at once; gives up above a load, and breaks above a higher one."""

    gives_up_above: float = 100.0
    breaks_above: float = 1000.0
    name: str = "stand"

    def refusals(self, scene):
        return []

    def solve(self, scene):
        load = scene.motion.load
        if load > self.breaks_above:
            raise ZeroDivisionError("a fault in the solver")
        if load > self.gives_up_above:
            raise SolveError(f"{load:g} N is too much; press less")
        threads = {name: float(os.environ.get(name, "nan")) for name in ONE_THREAD}
        measures = threads | {"process": float(os.getpid())}
        return Result(scene, self.name, {}, load, 1e-4 * load, 0.0, 0.0, 1.0, 0.25, measures, {"x": [load]})


def loads(*values, solver=None):
    return [Task(solver or Stand(), (replace(SCENE, motion=Indent(load=value)),), work=value) for value in values]


class Heard:
    def __init__(self):
        self.said = []

    def planned(self, tasks):
        self.said.append(("planned", [task.work for task in tasks]))

    def started(self, task):
        self.said.append(("started", task.work))

    def finished(self, task, outcome):
        self.said.append(("finished", task.work))

    def interrupted(self):
        self.said.append(("interrupted", None))


def test_what_the_store_has_is_not_solved_again(tmp_path):
    first = sweep(loads(1.0, 2.0), Store(tmp_path), workers=2)
    assert (first.solved, first.reused) == (2, 0)
    more = sweep(loads(1.0, 2.0, 3.0), Store(tmp_path), workers=1)
    assert (more.solved, more.reused) == (1, 2)
    assert [more.outcomes[task].rows[0].depth for task in loads(1.0, 2.0, 3.0)] == [1e-4, 2e-4, 1e-4 * 3.0]
    again = sweep(loads(1.0, 2.0, 3.0), Store(tmp_path), workers=1)
    assert (again.solved, again.reused) == (0, 3)
    other = sweep(loads(1.0, solver=Stand(gives_up_above=50.0)), Store(tmp_path), workers=1)
    assert (other.solved, other.reused) == (1, 0)


def test_a_task_that_stands_there_twice_is_solved_once(tmp_path):
    assert sweep(loads(1.0, 1.0), Store(tmp_path), workers=1).solved == 1


def test_a_failed_solve_is_a_row_of_nan_with_its_reason_and_the_rest_go_on(tmp_path):
    tasks = loads(200.0, 1.0, 2.0)
    swept = sweep(tasks, Store(tmp_path), workers=2)
    failed, *fine = (swept.outcomes[task].rows[0] for task in tasks)
    assert failed.reason == "200 N is too much; press less"
    assert failed.normal_force != failed.normal_force
    assert [row.normal_force for row in fine] == [1.0, 2.0]
    again = sweep(tasks, Store(tmp_path), workers=1)
    assert (again.solved, again.reused) == (0, 3)


def test_a_fault_is_raised_and_what_was_finished_stays(tmp_path):
    with pytest.raises(ZeroDivisionError, match="a fault in the solver"):
        sweep(loads(5.0, 4.0, 3.0, solver=Stand(breaks_above=3.5)), Store(tmp_path), workers=1)
    with pytest.raises(ZeroDivisionError):
        sweep([*loads(5.0), *loads(2000.0, 1.0)], Store(tmp_path), workers=1)
    assert Store(tmp_path).get(loads(5.0)[0]) is None
    sweep(loads(5.0), Store(tmp_path), workers=1)
    assert Store(tmp_path).get(loads(5.0)[0]) is not None


def test_workers_have_one_thread_each_and_the_caller_keeps_its_own(tmp_path, monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "5")
    monkeypatch.delenv("NUMBA_NUM_THREADS", raising=False)
    (task,) = loads(1.0)
    measures = sweep([task], Store(tmp_path), workers=1).outcomes[task].rows[0].measures
    assert [measures[name] for name in ONE_THREAD] == [1.0] * len(ONE_THREAD)
    assert measures["process"] != os.getpid()
    assert os.environ["OMP_NUM_THREADS"] == "5"
    assert "NUMBA_NUM_THREADS" not in os.environ


def test_the_longest_task_goes_first_and_every_step_is_told(tmp_path):
    heard = Heard()
    sweep(loads(1.0, 3.0, 2.0), Store(tmp_path), workers=1, progress=heard)
    steps = [(step, work) for work in (3.0, 2.0, 1.0) for step in ("started", "finished")]
    assert heard.said == [("planned", [3.0, 2.0, 1.0]), *steps]


def test_an_interrupt_stores_what_is_under_way_and_starts_nothing_more(tmp_path):
    class Impatient(Heard):
        def finished(self, task, outcome):
            super().finished(task, outcome)
            raise KeyboardInterrupt

    heard = Impatient()
    with pytest.raises(KeyboardInterrupt):
        sweep(loads(1.0, 3.0, 2.0), Store(tmp_path), workers=1, progress=heard)
    assert heard.said[1:] == [("started", 3.0), ("finished", 3.0)]
    again = sweep(loads(1.0, 3.0, 2.0), Store(tmp_path), workers=1)
    assert (again.solved, again.reused) == (2, 1)


def test_an_empty_contact_is_an_answer_with_forces_of_zero():
    class Floats:
        def solve(self, scene):
            raise EmptyContact("nothing touches")

    (row,) = Task(Floats(), (replace(SCENE, motion=Indent(depth=1e-4)),)).solve().rows
    assert (row.normal_force, row.friction_force, row.depth, row.reason) == (0.0, 0.0, 1e-4, None)
    assert np.isnan(row.friction_coefficient)


@pytest.fixture
def heeded():
    """SIGINT raises, also where the tests run in the background of a shell, which ignores it there."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("heeded")
@pytest.mark.parametrize(("presses", "stored"), [(1, 1), (2, 0)])
def test_one_interrupt_waits_for_what_is_under_way_and_two_do_not(tmp_path, presses, stored):
    class Impatient(Heard):
        def started(self, task):
            super().started(task)
            for _ in range(presses):
                signal.raise_signal(signal.SIGINT)

    heard = Impatient()
    with pytest.raises(KeyboardInterrupt):
        sweep(loads(1.0, 2.0), Store(tmp_path), workers=1, progress=heard)
    assert len(list(tmp_path.iterdir())) == stored
    assert [work for step, work in heard.said if step == "started"] == [2.0]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_task_keeps_the_fields_of_its_first_scene_only():
    scenes = tuple(replace(SCENE, motion=Indent(load=load)) for load in (3.0, 4.0))
    assert Task(Stand(), scenes, keeps_fields=True).solve().fields == {"x": [3.0]}
    assert Task(Stand(), scenes).solve().fields == {}
