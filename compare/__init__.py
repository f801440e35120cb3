"""The judge: one scene answered in one and in three dimensions. The command `crosscheck X` is `compare.X` here.

run : solve scenes in both, or by other models, compare, and write a report
trust : what the 1D answer to a scene is worth, without solving anything rough
sweep : solve a scene at every speed and load in both, as a Dataset; friction_plot draws it
study : ask the claims of the paper of many contacts
paper : simulate the paper again in one dimension
workprecision : what accuracy costs in time
stability : the named hard cases, each with its law
verify : a code of contact of your own against what it must hold
regress : ratios of 1D over 3D against those stored; the fixture `mdr_accuracy` of pytest does so in your tests
mastercurve, topography : friction that you measured, a surface that you measured
plan : what would be simulated of a scene, and what that costs
load, export : what a command left, as xarray has it, as CSV, for ParaView, as figures for a journal
draw : the contact in 3D and the row of springs; of a program also the forces in time
scenes, new, schema : scenes and studies that come with the package, a copy of any, and the fields of such files
Persson : his theory of rough contact and friction, as published and with its later factor
CorrectedMDR : one dimension, corrected to three by the trust map, where the map knows how
FrictionLaw : friction in three dimensions from the spectrum, with an interval
solve : a Comparison of your own
InvalidInput, Refused : before anything is solved, of what cannot be read, and of what no solver can do
SolveError, OutOfMemory : of an answer that cannot be had; Doubtful and UncertainFriction are warnings

Each returns what was found and prints nothing: printed, that is what the command prints; in a notebook it shows
tables, and its `figures`. Nothing is imported until it is used.
"""

import logging
import re
from importlib import import_module
from pathlib import Path
from typing import Any

logging.getLogger(__name__).addHandler(logging.NullHandler())
# The module of each public name, from the stub that type checkers read.
_STUB = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
_HOMES = {name: home for home, name in re.findall(r"^from (\S+) import (\w+)", _STUB, re.MULTILINE)}
__all__ = [*_HOMES]


def __getattr__(name: str) -> Any:
    """A public name, imported when it is first used."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = found = getattr(import_module(_HOMES[name], __name__), name)
    return found


def __dir__() -> list[str]:
    return __all__
