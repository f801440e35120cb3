"""Completion in a shell: names of scenes and studies, and values that are allowed."""

from collections.abc import Callable, Sequence
from glob import glob

from ..library import ready as library

FILES = "*.toml"  # in this folder: scenes or studies of one's own


def copied() -> list[str]:
    """Ready scenes and studies that `crosscheck new` copies."""
    return [*library.ready()]


def scenes() -> list[str]:
    """Ready scenes, and files that may be scenes."""
    return [*(name for name, each in library.ready().items() if each.kind == "scene"), *sorted(glob(FILES))]


def studies() -> list[str]:
    """Studies of `crosscheck study`, and files that may be studies."""
    return [*library.studies(), "all", *sorted(glob(FILES))]


# By command and argument, or by argument alone.
NAMES = {("study", "name"): studies, ("new", "name"): copied, "scene": scenes}


def completion(command: str, parameter: str, values: Sequence[str]) -> Callable[[str], list[str]] | None:
    """The names or values of a parameter that begin as what is typed; None where there are none to complete."""
    names = NAMES.get((command, parameter)) or NAMES.get(parameter)
    if not (names or values):
        return None

    def completed(incomplete: str) -> list[str]:
        return [each for each in (names() if names else values) if each.startswith(incomplete)]

    return completed
