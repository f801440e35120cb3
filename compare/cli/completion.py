"""Completion in a shell: names of scenes, studies and diagrams, and values of options."""

from collections.abc import Callable, Sequence
from glob import glob

from ..library import ready as library
from ..report.plots.journals import JOURNALS

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


def diagrams() -> list[str]:
    """Diagrams of `crosscheck workprecision`."""
    return [*library.DIAGRAMS, "all"]


# By the name of an argument or option.
VALUES: dict[str, Sequence[str] | Callable[[], Sequence[str]]] = {
    "scene": scenes,
    "size": ("quick", "standard", "full"),
    "format": ("html", "markdown", "latex"),
    "figures": ("png", "pdf", "svg"),
    "unit": ("m", "mm", "um", "nm"),
    "level": ("mean", "tilt", "curvature", "cubic"),
    "missing": ("refuse", "fill"),
    "repeat": ("mirror", "periodic"),
    "peaks": ("up", "down"),
    "kind": ("scene", "study"),
    "to": ("csv", "latex", "vtk"),
    "journal": tuple(JOURNALS),
}
# By the name of a command: of its argument `name`.
NAMES = {"study": studies, "new": copied, "workprecision": diagrams}


def completion(command: str, parameter: str) -> Callable[[str], list[str]] | None:
    """The values of a parameter that begin as what is typed; None where there are none to complete."""
    values = NAMES[command] if parameter == "name" else VALUES.get(parameter)
    if values is None:
        return None

    def completed(incomplete: str) -> list[str]:
        offered = values() if callable(values) else values
        return [each for each in offered if each.startswith(incomplete)]

    return completed
