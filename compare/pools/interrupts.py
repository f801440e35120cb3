"""Interrupts while tasks are solved: heard at moments of our own choosing."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

# What a terminal sends to every process of a run: workers leave it to their parent.
FROM_THE_TERMINAL = {getattr(signal, name) for name in ("SIGINT", "SIGHUP") if hasattr(signal, name)}


@contextmanager
def caught() -> Iterator[list[int]]:
    """The list of the signals that came meanwhile and would have raised KeyboardInterrupt."""
    came: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield came
        return
    raising = [n for n in signal.valid_signals() if signal.getsignal(n) is signal.default_int_handler]
    for number in raising:
        signal.signal(number, lambda number, frame: came.append(number))
    try:
        yield came
    finally:
        for number in raising:
            signal.signal(number, signal.default_int_handler)


@contextmanager
def held() -> Iterator[None]:
    """A process started meanwhile inherits the mask: an interrupt from the keyboard does not end it at birth."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, FROM_THE_TERMINAL)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
