"""Loops that numba compiles when they are first called, and keeps on disk for the next process."""

import multiprocessing
import warnings
from collections.abc import Callable
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from numba import njit


def compiled(**options: Any) -> Callable[[Callable], Callable]:
    """Decorator that compiles a function to machine code, which releases the interpreter lock.

    options : how it is compiled, see numba.njit

    Where no folder can be written, or the disk is full, each process compiles anew; a UserWarning says so once.
    """

    def made(function):
        try:
            loop = njit(cache=True, nogil=True, **options)(function)
        except RuntimeError:  # of the folders that numba tries, none can be written
            _say()
            return njit(nogil=True, **options)(function)
        if hasattr(loop, "_cache"):  # and not the plain function, by NUMBA_DISABLE_JIT
            loop._cache._cache_file._source_stamp = _stamp(Path(function.__code__.co_filename).parent)
            loop._cache.save_overload = _where_there_is_room(loop._cache.save_overload)
        return loop

    return made


@cache
def _stamp(folder):
    """Digest of all files of a package: a loop may call one of another file, and numba looks at its own alone."""
    while (folder.parent / "__init__.py").exists():
        folder = folder.parent
    return sha256(b"".join(file.read_bytes() for file in sorted(folder.rglob("*.py")))).digest()


def _where_there_is_room(save):
    def saved(*compiled):
        try:
            save(*compiled)
        except OSError:  # what is compiled serves this process all the same
            _say()

    return saved


@cache
def _say():
    if multiprocessing.parent_process() is None:  # workers leave it to their parent
        warnings.warn(
            "compiled code cannot be kept, as no folder for it can be written: each process compiles anew, for "
            "some ten seconds; NUMBA_CACHE_DIR may name a folder",
            stacklevel=2,
        )
