"""The judge: one scene answered in one and in three dimensions. What the command `crosscheck` does, from Python:

crosscheck : solve scenes in both, compare, and write a report
plan : what would be simulated of a scene, what that costs, and what is left out
conduct : ask the claims of the paper of many contacts, by a study of the package or of your own
reproduce : simulate the paper again in one dimension
weigh : what accuracy costs in time
examine : the named hard cases, each with its law
regress : quantities against what is stored; `check` and `update` do so in a test of your own
shift, describe : friction that you measured, a surface that you measured
load, export : what is stored, as xarray has it, or as CSV and LaTeX
redraw : figures again for another journal or in another style, from what is stored
animate : a scene that moves, as a picture that moves
ready, new : scenes and studies to begin with, and a copy of one of them
Case, Judgement, Quantity, Study, Task : what these take and give

Each returns what was found and prints nothing: printed, that is what the command prints; in a notebook it shows
tables, and its `figures`. Nothing is imported until it is used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .archive import load
    from .cases import Case
    from .library import ready
    from .library import write as new
    from .planning import plans as plan
    from .quantity import Quantity
    from .redrawing import redraw
    from .regression import check, update
    from .run import animate, conduct, crosscheck, describe, examine, regress, reproduce, shift, weigh
    from .studies.catalogue import Study
    from .study import Task
    from .tables import export
    from .verdict import Judgement

# Where each name is, by the module and the name there.
_PLACES = {
    "Case": ("cases", "Case"),
    "Judgement": ("verdict", "Judgement"),
    "Quantity": ("quantity", "Quantity"),
    "Study": ("studies.catalogue", "Study"),
    "Task": ("study", "Task"),
    "animate": ("run", "animate"),
    "check": ("regression", "check"),
    "conduct": ("run", "conduct"),
    "crosscheck": ("run", "crosscheck"),
    "describe": ("run", "describe"),
    "examine": ("run", "examine"),
    "export": ("tables", "export"),
    "load": ("archive", "load"),
    "new": ("library", "write"),
    "plan": ("planning", "plans"),
    "ready": ("library", "ready"),
    "redraw": ("redrawing", "redraw"),
    "regress": ("run", "regress"),
    "reproduce": ("run", "reproduce"),
    "shift": ("run", "shift"),
    "update": ("regression", "update"),
    "weigh": ("run", "weigh"),
}

__all__ = [
    "Case",
    "Judgement",
    "Quantity",
    "Study",
    "Task",
    "animate",
    "check",
    "conduct",
    "crosscheck",
    "describe",
    "examine",
    "export",
    "load",
    "new",
    "plan",
    "ready",
    "redraw",
    "regress",
    "reproduce",
    "shift",
    "update",
    "weigh",
]


def __getattr__(name: str) -> Any:
    try:
        module, there = _PLACES[name]
    except KeyError:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}") from None
    found = globals()[name] = getattr(import_module(f".{module}", __name__), there)
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
