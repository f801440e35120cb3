"""Tasks are solved once, in parallel, and one that fails takes no other with it."""

import multiprocessing
import os
import re
import signal
import sys
from concurrent.futures import BrokenExecutor, Future, ThreadPoolExecutor
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from processes import finish, start, wait_for
from pydantic.dataclasses import dataclass
from stand_in_solver import SCENE, Heard, Here, Stand, exactly, forces, loads, marks

from compare.solving import runner
from compare.solving import task as solving
from compare.solving.digest import code_of
from compare.solving.executors import MOST_FAILED_STARTS, ONE_THREAD, Processes, Workers
from compare.solving.folders import lock
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.solving.task import Outcome, Row
from compare.solving.task import SceneTask as Task
from mdr1d import MDR
from scene import Indent, Refused, SelfAffine, Slide
from scene.files.reading import InvalidInput


@pytest.fixture
def here(monkeypatch, tmp_path):
    """Sweeps in this process, with a store in the folder of the test."""
    monkeypatch.setattr(runner, "_workers", lambda *_: Workers(Here(), 1))
    return partial(sweep, store=Store(tmp_path), workers=1)


@pytest.mark.parametrize(
    ("tasks", "counts"),
    [
        (loads(1.0, 2.0), (0, 2)),
        (loads(1.0, 2.0, 3.0), (1, 2)),
        (loads(1.0, solver=Stand(gives_up_above=50.0)), (1, 0)),
        (loads(4.0, 4.0), (1, 0)),
    ],
    ids=["all of it", "part of it", "another solver", "twice in the list"],
)
def test_what_the_store_has_is_not_solved_again(here, tasks, counts):
    here(loads(1.0, 2.0))
    swept = here(tasks)
    assert (swept.solved, swept.reused) == counts
    assert forces(swept, tasks) == [task.work for task in tasks]


def test_a_fault_is_a_row_with_its_reason_the_rest_go_on_and_a_later_run_solves_it_again(
    here, tmp_path, monkeypatch
):
    """A solve that fails is a row with its reason too, which is stored as an answer."""
    tasks = loads(2000.0, 200.0, 5.0, 1.0)
    heard = Heard()
    swept = here(tasks, progress=heard)
    broken, failed = (swept.outcomes[task].rows[0] for task in tasks[:2])
    assert broken.reason == "ZeroDivisionError: a fault in the solver"
    assert failed.reason == "200 N is too much; press less"
    assert np.isnan([broken.normal_force, failed.normal_force]).all()
    assert swept.faults == {tasks[0]: broken.reason}
    assert forces(swept, tasks[2:]) == [5.0, 1.0]
    assert len(heard.heard) == 1 + 2 * len(tasks)
    (note,) = tmp_path.glob("*.fault.txt")
    text = note.read_text()
    assert tasks[0].label in text
    assert "Traceback" in text
    assert text.endswith("\nZeroDivisionError: a fault in the solver\n")
    again = here(tasks)
    assert (again.solved, again.reused, list(again.faults)) == (1, 3, tasks[:1])
    monkeypatch.setattr(Task, "solve", lambda self: Outcome((Row(1.0),)))  # the fault is mended
    mended = here(tasks)
    assert (mended.solved, mended.faults, note.exists()) == (1, {}, False)


@dataclass(frozen=True)
class Odd(solving.Task):
    """A task with a single load that goes wrong in its own way."""

    way: str
    work: float = 1.0
    label: str = "odd"
    keeps_fields: bool = False
    packages: tuple[str, ...] = ("scene",)

    @property
    def question(self):
        return {"odd": self.way}

    def __reduce__(self):
        if self.way == "cannot be sent":
            raise TypeError("cannot pickle it")
        return type(self), (self.way,)

    def solve(self):
        if self.way == "memory":
            raise MemoryError
        if self.way == "leaves":
            sys.exit(3)
        if self.way == "cannot come back":
            return Outcome((Row(settings={"what": lambda: None}),))
        return Outcome(() if self.way == "not whole" else (Row(1.0),))


def test_a_task_may_fail_in_any_way(here, tmp_path):
    ways = {
        "memory": "MemoryError",
        "leaves": "SystemExit: 3",
        "cannot come back": "Can't pickle",
        "not whole": "ValueError: its answer is not whole: 0 rows, fields []",
    }
    tasks = [Odd(way) for way in (*ways, "none")]
    swept = here(tasks)
    for task, reason in zip(tasks, ways.values(), strict=False):
        assert reason in swept.faults[task]
        assert swept.outcomes[task].rows[0].reason == swept.faults[task]
    assert swept.outcomes[tasks[-1]].rows[0].reason is None
    assert (len(swept.faults), Store(tmp_path).get(tasks[-1]) is not None) == (len(ways), True)


def test_any_executor_gives_the_same_digits_whatever_its_size(tmp_path):
    rough = SelfAffine(hurst=0.5, rms_height=1e-5, longest=1e-2, shortest=1e-3, seed=3)
    scene = replace(SCENE, motion=Slide(speed=0.1, load=1.0), roughness=rough)
    tasks = [Task(MDR(points=n), (scene,)) for n in (400, 500, 600, 700)]
    numbers = set()
    with ThreadPoolExecutor(3) as threads:
        for name, options in {
            "processes": {"workers": 2},
            "threads": {"executor": threads},
            "one": {"executor": Here(), "workers": 1},
        }.items():
            outcomes = sweep(tasks, Store(tmp_path / name), **options).outcomes
            numbers.add(str([exactly(outcomes[task]) for task in tasks]))
    assert len(numbers) == 1


def test_an_executor_that_is_broken_is_an_error_and_one_with_other_code_is_refused(tmp_path, monkeypatch):
    class Broken:
        def submit(self, *given):
            future = Future()
            future.set_exception(BrokenExecutor("a worker died"))
            return future

    with pytest.raises(ChildProcessError, match="has lost a worker and solves nothing more"):
        sweep(loads(1.0), Store(tmp_path), executor=Broken())
    here = code_of(("scene", "stand_in_solver"))
    other = {"code": here["code"] | {"scene": "x"}, "versions": here["versions"] | {"numpy": "1.0"}}
    monkeypatch.setattr("compare.solving.executors.code_of", lambda names: other)
    differs = f"its code of scene is another; its numpy is 1.0, here {np.__version__}"
    with pytest.raises(Refused, match=f"a worker on .* cannot be used: {differs}"):
        sweep(loads(1.0), Store(tmp_path), executor=Here())
    assert len(Store(tmp_path)) == 0


@pytest.mark.parametrize("deaths", [1, pytest.param(Processes.tries, marks=pytest.mark.slow)])
def test_a_worker_that_dies_takes_no_other_with_it_and_its_task_is_tried_again_alone(tmp_path, deaths):
    solver = Stand(marks=str(tmp_path), dies=deaths, seconds=0.1)
    tasks = loads(20000.0, 4.0, 3.0, 2.0, 1.0, solver=solver)
    heard = Heard()
    swept = sweep(tasks, Store(tmp_path / "solved"), workers=2, progress=heard)
    assert forces(swept, tasks[1:]) == [4.0, 3.0, 2.0, 1.0]
    assert all(marks(tmp_path, load) == 1 for load in (3, 2, 1))
    assert 1 <= marks(tmp_path, 4) <= 2  # it was running as the other died
    assert marks(tmp_path, 20000) == min(deaths + 1, Processes.tries)
    assert sum(step == "started" for step, *_ in heard.heard) == len(tasks)
    again = [line for line in heard.said_lines if line.startswith(tasks[0].label)]
    assert len(again) == min(deaths, Processes.tries - 1)
    assert again[0].endswith("its worker process died; the task is tried again alone")
    (row,) = swept.outcomes[tasks[0]].rows
    if deaths < Processes.tries:
        assert row.normal_force == 100.0
    else:
        assert row.reason == "its worker died 3 times, the last time alone, as when memory runs out"
        assert swept.faults == {tasks[0]: row.reason}


def test_workers_that_end_as_they_start_are_an_error_at_once(tmp_path, monkeypatch):
    monkeypatch.setattr("compare.solving.executors._begin", float)  # what a worker begins with fails
    died = []
    renew = Processes.renew
    monkeypatch.setattr(Processes, "renew", lambda self: died.append(0) or renew(self))
    with pytest.raises(ChildProcessError, match="worker processes ended as they started, 3 times"):
        sweep(loads(1.0, 2.0), Store(tmp_path), workers=1)
    assert len(died) == MOST_FAILED_STARTS


def test_a_worker_that_runs_the_script_which_asked_for_it_ends_before_it_has_a_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(multiprocessing.current_process(), "_inheriting", True, raising=False)
    with pytest.raises(SystemExit), lock([tmp_path / "output"], str):
        pass
    assert not (tmp_path / "output").exists()


def test_a_fresh_process_solves_each_task_where_that_is_asked_for(tmp_path):
    tasks = loads(1.0, 2.0)
    swept = sweep(tasks, Store(tmp_path), fresh=True)
    assert len({swept.outcomes[task].rows[0].measures["process"] for task in tasks}) == 2


TWIN = """
import sys
from pathlib import Path
from stand_in_solver import Here, Stand, loads
from compare.solving.digest import code_of
from compare.solving.executors import ONE_THREAD, MOST_FAILED_STARTS, Processes, Workers
from compare.solving.folders import lock
from compare.solving.store import Store
from compare.solving.runner import sweep

if __name__ == "__main__":
    folder = Path(sys.argv[1])
    tasks = loads(*map(float, range(1, 13)), solver=Stand(marks=str(folder), seconds=0.05))
    with lock([folder], print):
        sweep(tasks, Store(folder / "solved"), workers=1)
"""


def twin(folder, place=None):
    """Another run, in a folder and started in a place."""
    (folder / "twin.py").write_text(TWIN)
    paths = os.pathsep.join(filter(None, sys.path))
    return start(place or folder, str(folder), program=(str(folder / "twin.py"),), PYTHONPATH=paths)


def test_no_process_looks_for_its_first_modules_in_the_working_folder(tmp_path):
    here = tmp_path / "here"
    here.mkdir()
    for name in ("signal", "threading", "pickle", "selectors"):
        (here / f"{name}.py").write_text("open('ran', 'w')")
    assert finish(twin(tmp_path, here)) == (0, "", "")
    assert not (here / "ran").exists()
    assert len(Store(tmp_path / "solved")) == 12


def test_a_folder_is_held_until_the_run_that_has_it_ends_or_is_killed(tmp_path):
    other, store = twin(tmp_path), Store(tmp_path / "solved")
    wait_for(lambda: marks(tmp_path) > 2)
    with pytest.raises(InvalidInput, match=re.escape(f"{store.folder}: another run holds")):
        len(store)
    with pytest.raises(InvalidInput, match=re.escape(f"{tmp_path}: another run holds")), lock([tmp_path], str):
        pass
    os.killpg(other.pid, signal.SIGKILL)
    other.communicate()
    with lock([tmp_path], pytest.fail), pytest.raises(InvalidInput), lock([tmp_path], str):  # and no thread twice
        pass
    tasks = loads(*map(float, range(1, 13)), solver=Stand(marks=str(tmp_path), seconds=0.05))
    swept = sweep(tasks, store, workers=1)
    assert swept.reused >= 2
    assert forces(swept, tasks) == [task.work for task in tasks]


def test_tasks_that_other_code_has_solved_are_said_and_solved_again(here, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr("compare.solving.digest._code_digest", lambda _: "0" * 32)
        here(loads(1.0, 2.0))
    heard = Heard()
    assert here(loads(1.0, 2.0, 3.0), progress=heard).solved == 3
    assert heard.said_lines == ["2 stored tasks were solved by other code: they are solved again"]


def test_workers_have_one_thread_the_caller_its_own_and_what_cannot_be_sent_is_solved_here(tmp_path, monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "5")
    monkeypatch.delenv("NUMBA_NUM_THREADS", raising=False)
    tasks = [*loads(1.0), Odd("cannot be sent")]
    swept = sweep(tasks, Store(tmp_path), workers=1)
    assert swept.faults == {}
    assert Store(tmp_path).get(tasks[1]).rows[0].normal_force == 1.0
    measures = swept.outcomes[tasks[0]].rows[0].measures
    assert [measures[name] for name in ONE_THREAD] == [1.0] * len(ONE_THREAD)
    assert measures["process"] != os.getpid()
    assert os.environ["OMP_NUM_THREADS"] == "5"
    assert "NUMBA_NUM_THREADS" not in os.environ


def test_the_longest_task_goes_first_and_every_step_is_told(here):
    heard = Heard()
    here(loads(1.0, 3.0, 2.0), progress=heard)
    steps = [(step, work) for work in (3.0, 2.0, 1.0) for step in ("started", "finished")]
    assert heard.heard == [("planned", [3.0, 2.0, 1.0], 0), *steps]


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
    assert sum(Store(tmp_path).get(task) is not None for task in loads(1.0, 2.0)) == stored
    assert [work for step, work, *_ in heard.heard if step == "started"] == [2.0]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_task_keeps_the_fields_of_its_first_scene_only():
    scenes = tuple(replace(SCENE, motion=Indent(load=load)) for load in (3.0, 4.0))
    assert Task(Stand(), scenes, keeps_fields=True).solve().fields == {"x": [3.0]}
    assert Task(Stand(), scenes).solve().fields == {}
