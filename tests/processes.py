"""The command in a process of its own, as a person starts it, and in this one."""

import os
import signal
import subprocess
import sys
import time

from typer.testing import CliRunner

from compare.cli.app import app
from compare.solving.store import FILE

# A machine under load starts processes slowly [s].
PATIENCE = 120


def heed_signals():
    """Whoever runs the tests in the background ignores interrupts, and what is started inherits that."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def start(folder, *arguments, program=("-m", "compare"), output=subprocess.PIPE, **environment):
    """A process in a group of its own, in which warnings are errors."""
    return subprocess.Popen(
        [sys.executable, *program, *arguments],
        cwd=folder,
        stdout=output,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=heed_signals,
        env=os.environ | {"PYTHONWARNINGS": "error"} | environment,
    )


def ask(*words):
    """What the command answers in this process, for what needs no process of its own."""
    return CliRunner().invoke(app, list(map(str, words)))


def stored_so_far(folder):
    """Answers that a run under way has stored, by the size of the write-ahead log of SQLite."""
    log = folder / f"{FILE}-wal"
    try:
        return (log.stat().st_size - 32) // (24 + 4096)  # a head, then at least a page an answer
    except FileNotFoundError:
        return 0


def finish(process):
    """Status, standard output and standard error of a process."""
    output, complained = process.communicate(timeout=PATIENCE)
    return process.returncode, output, complained


def wait_for(condition):
    deadline = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert condition()
