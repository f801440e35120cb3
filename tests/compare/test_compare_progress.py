"""What a person sees of a run: a bar for each phase, the time left, and lines where there is no terminal."""

import io

from rich.console import Console
from stand_in_solver import loads

from compare.solving.task import Outcome, Row
from compare.solving.terminal import PAUSE, Shown

ANSWER = Outcome((Row(1.0),))


class Seen(Shown):
    """What is shown on a console, by a clock that is set; no thread draws."""

    now = 0.0

    def __init__(self, **console):
        self.file = io.StringIO()
        super().__init__(Console(file=self.file, color_system=None, width=70, **console), lambda: self.now)
        self.bar.live.auto_refresh = False

    def solve(self, *tasks, seconds):
        """Solve tasks one by one, each in `seconds` seconds; yields after each start and each end."""
        with self.solving():
            self.planned(tasks, 1)
            for task in tasks:
                self.started(task)
                yield self.bar.live.refresh()
                self.now += seconds
                self.finished(task, ANSWER)
                yield self.bar.live.refresh()


def test_each_phase_has_its_bar_which_says_what_it_waits_for_and_grows_with_the_work_that_is_done():
    phases = []

    def look(*_):
        (row,) = shown.bar.tasks
        phases.append((row.description, row.total and row.percentage))

    with Seen(force_terminal=True, force_interactive=True) as shown:
        look()
        for _ in shown.solve(*loads(100.0, 25.0), seconds=100.0):
            look()
        look()
        with shown.writing(2) as drawn:
            look(drawn("one"))
        look()
    assert phases == [
        *(("preparing", None), ("compiling", None), ("solving", 80.0), ("solving", 80.0), ("solving", 100.0)),
        *(("judging", None), ("drawing", 50.0), ("writing", None)),
    ]
    estimate = shown.file.getvalue()
    assert "1/2, stand sph" in estimate  # cut off where there is no room
    assert "2 of 2 tasks solved, 1 reused, 3.3 min" in estimate


def test_a_log_has_one_line_every_ten_seconds_and_nothing_that_moves_a_cursor():
    with Seen() as shown:
        [*shown.solve(*loads(*[1.0] * 30), seconds=1.0)]
        for _ in range(2):
            shown.now += PAUSE
            shown.bar.live.refresh()
    assert [line.split(",")[0] for line in shown.file.getvalue().splitlines()] == [
        *("solving 10/30", "solving 20/30", "solving 30/30", "30 of 30 tasks solved", "judging", "judging")
    ]
