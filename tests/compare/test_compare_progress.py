"""What a person sees of a run: a bar for each phase, the time left, and lines where there is no terminal."""

import io
import sys
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import pytest
from rich.console import Console
from stand_in_solver import Stand, loads

from bem3d import BEM
from compare.solving.outcome import Outcome, Row
from compare.solving.terminal import PAUSE, Shown
from mdr1d import MDR

TERMINAL = {"force_terminal": True, "force_interactive": True, "color_system": None, "width": 100}


class Run:
    """A run that is shown on a console, by a clock that is set."""

    def __init__(self, lines=False, **console):
        self.now, self.file = 0.0, io.StringIO()
        self.shown = Shown(
            lines, Console(file=self.file, highlight=False, soft_wrap=True, **console), clock=lambda: self.now
        )
        # No thread draws: what is seen is seen when the test looks.
        self.shown.bar.live.auto_refresh = False

    def phase(self):
        (row,) = self.shown.bar.tasks
        return row.description, row.percentage if row.total else None

    def text(self):
        """What was printed since the last look, without what moves the cursor."""
        found = self.file.getvalue()
        self.file.truncate(self.file.seek(0))
        return found


def solve(run, tasks, seconds=2.0):
    """Solve tasks one by one, each in so many seconds; yields after each start and each end."""
    run.shown.planned(tasks, 1)
    for task in tasks:
        run.shown.started(task)
        yield
        run.now += seconds
        run.shown.finished(task, Outcome((Row(1.0),)))
        yield


def test_each_phase_has_its_bar_and_that_of_solving_grows_with_the_work_that_is_done():
    run = Run(**TERMINAL)
    with run.shown as shown:
        phases = [run.phase()]
        with shown.solving():
            phases += [run.phase() for _ in solve(run, loads(4.0, 2.0))]
        phases.append(run.phase())
        with shown.writing(2) as drawn:
            for name in ("one", "two"):
                drawn(name)
                phases.append(run.phase())
        phases.append(run.phase())
    assert phases[:2] == [("preparing", None), ("compiling", None)]
    assert phases[2:5] == [("solving", pytest.approx(100 * part)) for part in (4 / 6, 4 / 6, 1)]
    assert phases[5:] == [("judging", None), ("drawing", 50.0), ("drawing", 100.0), ("writing", None)]
    assert "2 tasks solved, 1 reused, 4 s" in run.text()
    assert not shown.bar.tasks


def test_a_bar_says_what_it_waits_for_and_cuts_that_off_where_there_is_little_room():
    run = Run(**TERMINAL | {"width": 70})
    with run.shown as shown, shown.solving():
        for _ in solve(run, loads(100.0, 2.0), 100.0):
            shown.bar.refresh()
    assert "1/2, 2 s left, stand sphere …" in run.text()


@pytest.mark.parametrize("work", [1.0, 1e9], ids=["expected to take no time", "expected to take minutes"])
def test_the_time_left_is_about_right_however_long_workers_took_to_start_and_to_compile(work):
    """Two workers start for 6 s and compile for 20 s; then tasks take 9 s of one solver and 2 s of the other."""
    seconds, run, compiling = {MDR(): 9.0, BEM(): 2.0}, Run(), 20.0
    pairs = zip(*(loads(*map(float, range(1, 9)), solver=each) for each in seconds), strict=True)
    waiting = [replace(task, work=work) for pair in pairs for task in pair]
    free, lines = {6.0: None, 6.001: None}, []
    with run.shown as shown:
        shown.planned(list(waiting), 0)
        while free:
            run.now = min(free)
            if (task := free.pop(run.now)) is not None:
                spent = seconds[task.solver] + (compiling if shown.tasks.done < 2 else 0.0)
                shown.finished(task, Outcome((Row(1.0, seconds=spent),)))
            if waiting:
                task = waiting.pop(0)
                shown.started(task)
                free[
                    run.now
                    + seconds[task.solver]
                    + (compiling if len(shown.tasks.running) + shown.tasks.done <= 2 else 0)
                ] = task
            left = max(free, default=run.now) + sum(seconds[each.solver] for each in waiting) / 2 - run.now
            if shown.tasks.done > 3:
                lines.append((shown.tasks.seconds(), left))
    assert all(told == pytest.approx(left, rel=0.4, abs=6.0) for told, left in lines)
    assert all(later[0] < earlier[0] + 6.0 for earlier, later in pairwise(lines))  # it does not jump


def test_a_log_has_one_line_every_ten_seconds_and_nothing_that_moves_a_cursor():
    run = Run()
    with run.shown as shown:
        with shown.solving():
            for _ in solve(run, loads(*[1.0] * 30), 1.0):
                shown.bar.live.refresh()
        for _ in range(2):
            run.now += PAUSE
            shown.bar.live.refresh()
    lines = run.text().splitlines()
    assert [line.split(",")[0] for line in lines] == [
        *("solving 10/30", "solving 20/30", "solving 30/30", "30 tasks solved", "judging", "judging")
    ]


def test_in_lines_each_solve_and_each_figure_has_one():
    run = Run(lines=True, **TERMINAL)
    with run.shown as shown:
        with shown.solving():
            [*solve(run, loads(1.0, 2.0, solver=Stand(name="\x1b[31m")))]
        with shown.writing(1) as drawn:
            drawn("friction")
    solved, _, counts, figure = run.text().splitlines()
    assert solved.startswith("1/2, ")
    assert "solved \\x1b[31m sphere 1 N" in solved
    assert (counts, figure) == ("2 tasks solved, 1 reused, 4 s", "  figure friction")


def test_a_notebook_has_one_output_with_the_lines_and_a_bar_below_them(monkeypatch):
    shown = []
    display = SimpleNamespace(display=lambda display_id: SimpleNamespace(update=shown.append))
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(display=display))
    run = Run(force_jupyter=True)
    with run.shown as progress, progress.solving():
        for _ in solve(run, loads(1.0, 2.0)):
            progress.bar.live.refresh()
            printed = Console(file=io.StringIO(), width=100)
            printed.print(shown[-1])
            assert printed.file.getvalue().count("/2") == 1
    printed.print(shown[-1])
    assert "2 tasks solved, 1 reused, 4 s" in printed.file.getvalue()
    assert run.text() == ""
