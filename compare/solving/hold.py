"""Folders held for one run: by a lock that the system takes back, however the process ends."""

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from scene.printable import brief
from scene.reading import InvalidInput

from .workers import starting

if sys.platform == "win32":
    import msvcrt

    def _lock(file: int) -> None:
        try:
            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        except PermissionError as error:
            raise BlockingIOError from error
else:
    import fcntl

    def _lock(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


LOCK = ".crosscheck-lock"  # an empty file, which stays: one that is removed could be locked twice


@contextmanager
def hold(folders: Iterable[Path], say: Callable[[str], Any] | None = None) -> Iterator[None]:
    """Folders for this run alone; they are made.

    say : told where nothing keeps other runs out; absent, of whoever only reads, nothing is made, and a folder
        without a lock is free

    Raises InvalidInput, which names the folder, where another run holds it.
    """
    if starting():  # of a script without a guard, run again: its parent has the folder
        raise SystemExit(1)
    flags, unlocked = os.O_RDWR | getattr(os, "O_NOFOLLOW", 0) | (os.O_CREAT if say else 0), ""
    with ExitStack() as held:
        for folder in dict.fromkeys(folders):
            try:
                if say:
                    folder.mkdir(parents=True, exist_ok=True)
                file = os.open(folder / LOCK, flags, 0o666)
                held.callback(os.close, file)
                _lock(file)
            except BlockingIOError:
                raise InvalidInput(
                    f"{brief(str(folder))}: another run holds this folder until its page is written: wait for it, "
                    "or name another folder"
                ) from None
            except OSError as error:
                unlocked = str(error.strerror)
        if say and unlocked:
            say(f"this folder cannot be locked ({unlocked}), as on some network drives: run one at a time")
        yield
