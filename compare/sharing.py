"""Several sweeps at once on one store: which tasks another one is solving."""

import hashlib
import os
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows: sweeps that run at once solve some tasks twice.
    fcntl = None  # type: ignore[assignment]

FILE = "sharing.lock"
# Of the places that a lock can have in a file, whatever its length.
PLACES = 2**62


class Sharing:
    """A context: what this process has taken in a folder, to be solved by no other meanwhile.

    A lock on one byte of a file in the folder, at a place that the task's name gives: the system gives it back
    when the process ends, in whatever way. Where a folder cannot be locked, everything can be taken.
    """

    def __init__(self, folder: Path):
        self.folder = folder

    def __enter__(self):
        self.file = None
        if fcntl is not None:
            self.folder.mkdir(parents=True, exist_ok=True)
            self.file = os.open(self.folder / FILE, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
        return self

    def __exit__(self, *_):
        if self.file is not None:
            os.close(self.file)

    def take(self, name: str) -> bool:
        """Whether nobody else has it; if so, it is taken until it is given back."""
        if self.file is None:
            return True
        try:
            fcntl.lockf(self.file, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, _place(name))
        except (BlockingIOError, PermissionError):
            return False
        except OSError:
            return True
        return True

    def give_back(self, name: str) -> None:
        """Let others have it."""
        if self.file is not None:
            try:
                fcntl.lockf(self.file, fcntl.LOCK_UN, 1, _place(name))
            except OSError:
                return


def _place(name):
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:8]) % PLACES
