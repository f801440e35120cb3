"""What was solved before, without solving: for pages, figures and tables of a folder that a command left."""

import time
from collections.abc import Sequence

from scene import Refused

from .store import Store, Task
from .sweep import SweepResult


def recall(tasks: Sequence[Task], store: Store) -> SweepResult:
    """The outcomes of tasks by whatever code solved them. Raises Refused where any of them is not there."""
    start, wanted = time.perf_counter(), list(dict.fromkeys(tasks))
    found = store.recalled(wanted)
    missing = [task for task in wanted if task not in found]
    if missing:
        traces = [trace for task in missing for trace in store.traces(task)[:1]]
        broke = f", {len(traces)} of which broke, as {traces[0].name} tells" if traces else ""
        raise Refused(
            f"{len(missing)} of {len(wanted)} tasks are not solved in {store.folder}{broke}: {missing[0].label}"
            f"{', ...' if len(missing) > 1 else ''}; the command that wrote the folder solves them"
        )
    return SweepResult(found, 0, len(found), time.perf_counter() - start)


def of_other_code(tasks: Sequence[Task], store: Store) -> list[Task]:
    """Those of some tasks that this code has not solved: what is recalled of them is of other code or versions."""
    return [task for task in dict.fromkeys(tasks) if not store.holds(task)]
