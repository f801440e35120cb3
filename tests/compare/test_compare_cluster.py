"""On a cluster the same tasks have the same answers, whoever is lost on the way."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import ExitStack
from functools import partial
from types import SimpleNamespace

import pytest
from imports import ROOT
from processes import finish, start, stored_so_far, wait_for
from small_cases import SLIDING
from stand_in_solver import Heard, Stand, exactly, forces, loads, marks

from compare.solving import cluster as cluster_module
from compare.solving.cluster import Cluster
from compare.solving.executors import ONE_THREAD, differences
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.solving.task import SceneTask as Task
from mdr1d import MDR
from scene import Refused

dask = pytest.importorskip("dask", reason="the extra `cluster` is not installed")
distributed = pytest.importorskip("distributed", reason="the extra `cluster` is not installed")

DASK = [sys.executable, "-m", "dask"]

HERE = {"PYTHONPATH": os.pathsep.join([str(ROOT / "tests"), str(ROOT)])}


@pytest.fixture(scope="module")
def cluster():
    settings = {"n_workers": 2, "threads_per_worker": 2, "dashboard_address": None, "silence_logs": 50}
    # A task that two workers died of fails; by default four.
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 1}),
        distributed.LocalCluster(**settings) as running,
    ):
        yield running


@pytest.mark.slow
def test_answers_are_those_of_this_machine_bit_for_bit_and_this_process_stores_them(cluster, tmp_path):
    tasks = [Task(MDR(points=n), (SLIDING,), work=n) for n in (400, 500, 600, 700, 800, 900)]
    heard = Heard()
    there = sweep(tasks, Store(tmp_path / "there"), scheduler=cluster.scheduler_address, progress=heard)
    here = sweep(tasks, Store(tmp_path / "here"), workers=1)
    for task in tasks:
        assert exactly(there.outcomes[task]) == exactly(here.outcomes[task])
        assert Store(tmp_path / "there").get(task) is not None
    assert heard.said_lines == []
    again = sweep(tasks, Store(tmp_path / "there"), scheduler="tcp://127.0.0.1:1")  # nobody is asked
    assert (again.solved, again.reused) == (0, len(tasks))


@pytest.mark.slow
def test_a_task_that_kills_every_worker_fails_and_the_rest_is_solved(cluster, tmp_path):
    tasks = loads(20000.0, *range(1, 11), solver=Stand(marks=str(tmp_path), seconds=0.1))
    swept = sweep(tasks, Store(tmp_path / "solved"), scheduler=cluster.scheduler_address)
    assert list(swept.faults) == tasks[:1]
    assert marks(tmp_path) <= len(tasks) + 1 + 2 * 2 * 2  # what the threads of two workers had, and answers there
    assert swept.faults[tasks[0]] == "its worker died 2 times, the last time alone, as when memory runs out"
    assert forces(swept, tasks[1:]) == [task.work for task in tasks[1:]]


@pytest.mark.slow
@pytest.mark.usefixtures("heeded")
def test_an_interrupt_waits_for_what_is_handed_out_and_no_more_is(cluster, tmp_path):
    class Impatient(Heard):
        def finished(self, task, outcome):
            super().finished(task, outcome)
            signal.raise_signal(signal.SIGINT)

    tasks = loads(*range(1, 41), solver=Stand(marks=str(tmp_path), seconds=0.3))
    with pytest.raises(KeyboardInterrupt):
        sweep(tasks, Store(tmp_path / "solved"), scheduler=cluster.scheduler_address, progress=Impatient())
    time.sleep(0.5)
    with distributed.Client(cluster, set_as_default=False) as client:
        assert client.run_on_scheduler(lambda dask_scheduler: len(dask_scheduler.tasks)) == 0
    assert marks(tmp_path) < len(tasks) / 2


CLIENT = """
from pathlib import Path
import typer
from stand_in_solver import Stand, loads
from compare.cli.app import said_to_people
from compare.solving.store import Store
from compare.solving.runner import sweep

def client(folder: Path, address: str):
    tasks = loads(*range(1, 200), solver=Stand(marks=str(folder), seconds=0.2))
    with said_to_people("", solves=True):
        sweep(tasks, Store(folder / "solved"), scheduler=address)

if __name__ == "__main__":
    typer.run(client)
"""


def command(folder, address):
    """A command that solves on a cluster, in a process of its own, and its tasks."""
    tasks = loads(*range(1, 200), solver=Stand(marks=str(folder), seconds=0.2))
    return start(folder, str(folder), address, program=("-c", CLIENT), **HERE), tasks


@pytest.mark.slow
def test_a_client_that_is_killed_leaves_nothing_to_solve_and_its_store_whole(cluster, tmp_path):
    process, tasks = command(tmp_path, cluster.scheduler_address)
    solved = tmp_path / "solved"
    wait_for(lambda: stored_so_far(solved) >= 2)
    process.kill()
    process.communicate()
    begun = marks(tmp_path)
    with distributed.Client(cluster, set_as_default=False) as client:
        wait_for(lambda: client.run_on_scheduler(lambda dask_scheduler: len(dask_scheduler.tasks)) == 0)
        wait_for(lambda: not any(client.run(lambda dask_worker: len(dask_worker.state.executing)).values()))
    ended = marks(tmp_path)
    assert ended <= begun + 4  # what the threads were at
    time.sleep(1.0)
    assert marks(tmp_path) == ended
    assert sum(Store(solved).get(task) is not None for task in tasks) == len(Store(solved))


@pytest.fixture
def scheduler(tmp_path):
    """A scheduler without workers, in a process of its own."""
    place = tmp_path / "scheduler.json"
    process = subprocess.Popen(
        [*DASK, "scheduler", "--port=0", "--no-dashboard", "--host=127.0.0.1", f"--scheduler-file={place}"],
        stderr=subprocess.DEVNULL,
    )
    wait_for(lambda: place.exists() and place.read_text().rstrip().endswith("}"))
    process.address = json.loads(place.read_text())["address"]
    yield process
    process.kill()
    process.wait()


@pytest.fixture
def join(scheduler, tmp_path):
    """Starts a worker in a process of its own, one thread and no nanny, that ends with the test."""
    asked = "worker", scheduler.address, "--no-nanny", "--nthreads=1", "--no-dashboard"
    with ExitStack() as stack:

        def joined(**environment):
            worker = subprocess.Popen(
                [*DASK, *asked, f"--local-directory={tmp_path}"],
                stderr=subprocess.DEVNULL,
                cwd=tmp_path,
                env=os.environ | HERE | environment,
            )
            stack.enter_context(worker)
            stack.callback(worker.kill)

        yield joined


@pytest.mark.slow
def test_without_workers_it_says_so_and_waits(scheduler, join, tmp_path):
    class Inviting(Heard):
        def message(self, line):
            super().message(line)
            join()

    tasks, heard = loads(1.0), Inviting()
    swept = sweep(tasks, Store(tmp_path / "solved"), scheduler=scheduler.address, progress=heard)
    assert forces(swept, tasks) == [1.0]
    assert heard.said_lines == [f"no worker at {scheduler.address}: waiting for one, with this package installed"]


@pytest.mark.slow
def test_a_command_that_loses_its_scheduler_says_so_in_a_line_and_goes_on_from_there(scheduler, join, tmp_path):
    solved = tmp_path / "solved"
    join(**ONE_THREAD)
    process, tasks = command(tmp_path, scheduler.address)
    wait_for(lambda: stored_so_far(solved) >= 2)
    scheduler.kill()
    lost = f"crosscheck: the scheduler at {scheduler.address} is lost. Solved contacts are kept.\n"
    assert finish(process) == (1, "", lost)
    kept = len(Store(solved))
    again = sweep(tasks[-kept - 2 :], Store(solved), workers=1)
    assert (again.solved, again.reused) == (2, kept)


def test_where_no_scheduler_answers_it_is_said_within_seconds(tmp_path, monkeypatch):
    monkeypatch.setattr(cluster_module, "ANSWERS", 0.3)
    with pytest.raises(ConnectionError, match=r"^no scheduler of dask answers at tcp://127\.0\.0\.1:1$"):
        sweep(loads(1.0), Store(tmp_path), scheduler="tcp://127.0.0.1:1")


@pytest.mark.parametrize("address", ["inproc://1/2/3", "", "tcp://name", "name:8786"])
def test_what_is_no_address_is_refused(address, tmp_path):
    with pytest.raises(Refused, match=r"^scheduler = '.*': an address, as tcp://name:8786$"):
        sweep(loads(1.0), Store(tmp_path), scheduler=address)


def test_a_scheduler_that_stands_still_is_lost(monkeypatch):
    monkeypatch.setattr(cluster_module, "LOST", 0.1)
    cluster = Cluster("tcp://x", print)
    cluster.client = SimpleNamespace(nthreads=partial(time.sleep, 2), status="running")
    with pytest.raises(ConnectionError, match="the scheduler at tcp://x is lost"):
        cluster.room()


def test_without_the_library_it_is_said_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(Refused, match=r"pip install mdr-bem-crosscheck\[cluster\]"):
        sweep(loads(1.0), Store(tmp_path), scheduler="tcp://127.0.0.1:9")


def test_a_worker_without_the_packages_does_not_state_its_code():
    assert "does not state its code" in differences({"code": {"no_such_package": "x"}, "versions": {}})
