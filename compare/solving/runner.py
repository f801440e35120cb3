"""Solving tasks by workers; what the store has is not solved again, and what breaks does not stop the rest."""

import logging
import pickle
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, wait
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import dataclass, field
from typing import Any

from scene import InvalidInput, Refused

from .digest import code_of
from .executors import Answer, Processes, Workers, caught, counted, solved
from .folders import write
from .store import Store
from .task import Outcome, Task

PULSE = 0.2  # time after which an interrupt is noticed [s]
_LOG = logging.getLogger(__name__)


class Progress:
    """Receiver of the progress of a run; this base class ignores it."""

    def message(self, line: str) -> None:
        """Message for the user, such as the cost of a study, or that a worker died or is missing."""

    def solving(self) -> AbstractContextManager[Any]:
        """Context of solving, which yields the receiver of its progress."""
        return nullcontext(self)

    def planned(self, tasks: Sequence[Task], reused: int) -> None:
        """The tasks that have to be solved, and how many more the store has."""

    def started(self, task: Task) -> None:
        """A task is handed out to a worker."""

    def finished(self, task: Task, outcome: Outcome) -> None:
        """A task is solved and stored, or has failed: then its rows have a reason."""

    def interrupted(self) -> None:
        """Tell that nothing more is started; the solves under way are waited for."""

    def writing(self, count: int) -> AbstractContextManager[Callable[[str], Any]]:
        """Context while `count` figures are drawn; gives a function that takes the name of each."""
        return nullcontext(str)


@dataclass(frozen=True)
class SweepResult:
    """Outcomes of a sweep, with counts, time and faults.

    outcomes : by task
    solved, reused : how many tasks were handed to workers, and how many the store had
    seconds : wall time [s]
    faults : reasons by task, of the tasks that broke; their outcomes have these reasons, and are not stored
    """

    outcomes: Mapping[Task, Outcome]
    solved: int
    reused: int
    seconds: float
    faults: Mapping[Task, str] = field(default_factory=dict)

    def joined(self, later: "SweepResult") -> "SweepResult":
        """This and a later one."""
        return SweepResult(
            {**self.outcomes, **later.outcomes},
            self.solved + later.solved,
            self.reused + later.reused,
            self.seconds + later.seconds,
            {**self.faults, **later.faults},
        )


def sweep(
    tasks: Iterable[Task],
    store: Store,
    workers: int | None = None,
    progress: Progress | None = None,
    fresh: bool = False,
    scheduler: str | None = None,
    executor: Executor | None = None,
    processes: Processes | None = None,
) -> SweepResult:
    """Solve tasks, longest first, storing each as it ends.

    workers : processes of this machine, one thread each; absent, as many as there are processors
    fresh : whether each task has a process of its own, one after the other
    scheduler : address of a dask scheduler, whose workers then solve the tasks in place of processes
    executor : that solves the tasks in place of processes, as many at once as `workers` says
    processes : of this machine, begun and ended by the caller, so that several sweeps share them

    What no other process can import, as the model of a script or a notebook, or what cannot be sent there is
    solved in this one. A task that raises, or that workers die of, has failed: its outcome has the reason in each
    row, its traceback lies in the store's folder, and the next sweep solves it again. On an interrupt, which is
    any signal that raises KeyboardInterrupt, nothing more is started; what is being solved is finished and stored,
    and KeyboardInterrupt is raised. A second interrupt ends it at once.

    Raises OSError where the store cannot be written (everything before is kept), where processes end as they
    start, and where a scheduler cannot be reached or is lost; InvalidInput where another run writes the store;
    Refused of a scheduler whose address is none or whose library is not installed, and of workers with other code.
    """
    progress, start = progress or Progress(), time.perf_counter()
    tasks = list(dict.fromkeys(tasks))
    outcomes = store.stored(tasks)
    missing = sorted((task for task in tasks if task not in outcomes), key=lambda task: -task.work)
    if missing and (other := store.by_other_code(missing)):
        progress.message(f"{other} stored tasks were solved by other code: they are solved again")
    progress.planned(missing, len(outcomes))
    found, faults = dict[Task, Outcome](), dict[Task, str]()
    if missing:
        _LOG.info("%d tasks to solve, %d reused from %s", len(missing), len(outcomes), store.folder)
        with (
            store.writing(),
            _workers(missing, workers, fresh, scheduler, executor, processes, progress) as pool,
            caught() as interrupts,
        ):
            found, faults = _solve(missing, store, pool, progress, interrupts)
    return SweepResult(outcomes | found, len(missing), len(outcomes), time.perf_counter() - start, faults)


def _workers(missing, count, fresh, scheduler, executor, processes, progress) -> AbstractContextManager[Workers]:
    if fresh:
        return Processes(1, fresh)
    if executor is not None:
        return Workers(executor, counted(count))
    if scheduler is not None:
        from .cluster import Cluster

        return Cluster(scheduler, progress.message)
    return Processes(min(counted(count), len(missing))) if processes is None else nullcontext(processes)


def _solve(missing, store, workers, progress, interrupts) -> tuple[dict[Task, Outcome], dict[Task, str]]:
    """Outcomes of tasks, and why some broke. Raises KeyboardInterrupt, and OSError as `sweep`."""
    queue, out = deque(missing), dict[Future[bytes], Task]()
    # What a worker died of is suspect with all that was out then, and is tried again alone.
    deaths = Counter[Task]()
    outcomes, faults, ending = {}, {}, False

    def keep(task, answer):
        outcome, note = answer.outcome, store.trace(task)
        if outcome is not None:
            try:
                store.put(task, outcome)
                note.unlink(missing_ok=True)
            except (InvalidInput, OSError):
                raise
            except Exception as error:
                answer, outcome = Answer.of(error), None
        if outcome is None:
            faults[task] = answer.reason
            text = f"{task.label}\n{answer.reason}\n\n{answer.trace}"
            write(note, lambda file: file.write(text.encode()))
            outcome = task.failed(answer.reason)
        outcomes[task] = outcome
        progress.finished(task, outcome)

    while queue or out:
        if interrupts:
            queue.clear()
            if not ending:
                progress.interrupted()
            ending = True
        room = workers.room()
        while queue and len(out) < room and not interrupts:
            if out and any(deaths[each] for each in (queue[0], *out.values())):
                break
            task = queue.popleft()
            if not deaths[task]:
                progress.started(task)
            packed = None
            with suppress(Exception):  # of what cannot be sent
                packed = pickle.dumps(task) if getattr(task, "portable", True) else None
            if packed is None:
                keep(task, solved(task))
            else:
                out[workers.submit(packed, code_of(tuple(task.packages)))] = task
        if not room:
            time.sleep(PULSE)
        for future in wait(out, PULSE, FIRST_COMPLETED).done:
            task = out.pop(future)
            try:
                answer = pickle.loads(future.result())
            except workers.died:
                workers.renew()
                deaths[task] += 1
                if ending:
                    continue
                if deaths[task] < workers.tries:
                    progress.message(f"{task.label}: its worker process died; the task is tried again alone")
                    queue.appendleft(task)
                    continue
                times = f"{deaths[task]} times, the last time alone"
                answer = Answer(reason=f"its worker died {times}, as when memory runs out")
            except CancelledError:  # by the executor
                queue.appendleft(task)
                continue
            except Refused:
                raise
            except Exception as error:
                answer = Answer.of(error)
            keep(task, answer)
    if ending:
        raise KeyboardInterrupt
    return outcomes, faults
