"""What the measured pages share: solving what is not solved yet, with a bar."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from compare.solving.folders import lock
from compare.solving.runner import sweep
from compare.solving.store import Store
from compare.solving.task import Outcome, Row, Task
from compare.solving.terminal import Shown
from compare.statistics.intervals import Estimated
from compare.statistics.jackknife import mean_ratio


def friction(rows: Sequence[Row]) -> Estimated:
    """Mean friction force over mean normal force of those with an answer."""
    forces = [(each.friction_force, each.normal_force) for each in rows if each.reason is None]
    return mean_ratio(*np.reshape(forces, (-1, 2)).T)


def solved(
    page: Path, tasks: Iterable[Task], workers: int | None = None, fresh: bool = False
) -> Mapping[Task, Outcome]:
    """Answers of tasks; what has been solved once lies in the folder `solved` next to the numbers of the page."""
    store = Store(page.with_suffix("") / "solved")
    with lock([store.folder], print), Shown() as shown, shown.solving() as progress:
        return sweep(tasks, store, workers, progress, fresh=fresh).outcomes
