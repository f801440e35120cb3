"""Memory that this process may have: of the machine, or what its limits leave of that."""

import os
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from .plan import size

# A control group without a limit states one near the largest whole number.
NO_LIMIT = 2**60


@cache
def memory() -> int:
    """Bytes that this process can have at most."""
    return min([*_physical(), *_of_groups(), *_of_process()], default=NO_LIMIT)


def shortage(needed: int) -> list[str]:
    """Reason why so many bytes do not fit, or nothing."""
    there = memory()
    if needed <= there:
        return []
    return [f"it needs {size(needed)} of memory, and only {size(there)} are available: use fewer points"]


def _physical() -> Iterator[int]:
    if "SC_PHYS_PAGES" in getattr(os, "sysconf_names", ()):
        yield os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


def _of_groups() -> Iterator[int]:
    """Limits of the control groups of this process, on Linux: of its own and of those around it."""
    try:
        lines = Path("/proc/self/cgroup").read_text(encoding="utf-8").splitlines()
    except OSError:
        return
    for line in lines:
        _, controllers, path = line.split(":", 2)
        root, name = (
            ("/sys/fs/cgroup/memory", "memory.limit_in_bytes")
            if "memory" in controllers.split(",")
            else ("/sys/fs/cgroup", "memory.max")
        )
        place = Path(root, path.lstrip("/"))
        for folder in (place, *place.parents):
            try:
                yield int((folder / name).read_text())
            except (OSError, ValueError):  # no such group here, or "max"
                continue


def _of_process() -> Iterator[int]:
    """Memory that `ulimit` leaves to this process."""
    try:
        import resource
    except ImportError:  # Windows
        return
    for limit in (resource.RLIMIT_AS, resource.RLIMIT_DATA):
        soft, _ = resource.getrlimit(limit)
        if soft != resource.RLIM_INFINITY:
            yield soft
