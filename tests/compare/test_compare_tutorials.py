"""Tutorials run from their first cell to their last; what they claim of their numbers, hidden cells assert."""

import re
import sys

from imports import ROOT

FOLDER = ROOT / "docs" / "tutorials"
CELL = re.compile(r"^```\{code-cell\}.*?\n(?::tags:.*?\n\n)?(.*?)^```$", re.MULTILINE | re.DOTALL)


def cells(name):
    return CELL.findall((FOLDER / f"{name}.md").read_text(encoding="utf-8"))


def test_a_tutorial_runs_from_its_first_cell_to_its_last(tmp_path, monkeypatch):
    """The others run each time the pages are built."""
    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.delitem(sys.modules, "mine", raising=False)
    known = {"__name__": "tutorial"}
    for number, cell in enumerate(cells("trust")):
        exec(compile(cell, f"cell {number}", "exec"), known)
    assert known.keys() > {"__name__", "__builtins__"}
