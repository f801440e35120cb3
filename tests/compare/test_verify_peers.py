"""Codes of others hold the laws of what they solve, by the adapters of the page."""

import importlib
import re
import sys

import pytest
from imports import ROOT
from test_compare_checks import failed, judged

from compare.statistics.finding import HOLDS, REPORTED

PAGE = ROOT / "docs" / "howto" / "verify.md"
# Of the peers, not of ours: without mpi4py, NuMPI warns on import that it stands in for it.
pytestmark = pytest.mark.filterwarnings("ignore:Could not import mpi4py:ImportWarning")


@pytest.fixture
def peers(tmp_path, monkeypatch):
    """The module on the page, where workers find it too."""
    (code,) = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    (tmp_path / "peers.py").write_text(code, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    yield importlib.import_module("peers")
    del sys.modules["peers"]


# Points of each code by its package, laws that it holds, and laws of what it does not solve or measure; a quarter
# of 32 points shows no order.
CODES = {
    "tamaas": ("Tamaas", 64, {"wave.gap.0.5", "crossed.fraction.0.3", "symmetry.turn"}, {"sphere.force"}),
    "ContactMechanics": (
        *("ContactMechanics", 32, {"sphere.force", "cone.depth", "same.rest", "seed"}),
        {"order.sphere", "slow.sphere.kelvin", "wave.gap.0.5"},
    ),
}


@pytest.mark.parametrize("every", [False, pytest.param(True, marks=pytest.mark.slow)], ids=["few", "all"])
@pytest.mark.parametrize("package", CODES)
def test_a_code_of_others_holds_the_laws_of_what_it_solves(peers, package, every):
    pytest.importorskip(package, exc_type=ImportError)
    name, points, held, left_out = CODES[package]
    _, found = judged(getattr(peers, name)(points=points), None if every else held | left_out)
    assert not failed(found)
    assert {found[each].verdict for each in held} == {HOLDS}
    assert {found[each].verdict for each in left_out} == {REPORTED}
