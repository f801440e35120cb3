"""Codes of others hold the laws of what they solve, by the adapters of the page."""

import importlib
import re
import sys
from pathlib import Path

import pytest

import compare
from compare.solving.words import VERDICTS
from compare.studies.checks.study import Checks

PAGE = Path(__file__).parents[2] / "docs" / "howto" / "verify.md"
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


def by_verdict(findings):
    names = {verdict: set() for verdict in VERDICTS}
    for each in findings:
        names[each.verdict].add(each.claim.id)
    return names


def test_tamaas_holds_the_laws_of_planes_at_rest(peers, tmp_path):
    pytest.importorskip("tamaas", exc_type=ImportError)
    report = compare.verify(peers.Tamaas(points=64), tmp_path / "verify", workers=1, report=False)
    found = by_verdict(report.judged)
    assert not found["fails"]
    assert {"verify.wave.gap.0.5", "verify.crossed.fraction.0.3", "verify.symmetry.turn"} <= found["holds"]
    assert "verify.sphere.force" in found["reported"]


def test_contact_mechanics_holds_the_laws_of_bodies_at_rest(peers):
    pytest.importorskip("ContactMechanics", exc_type=ImportError)
    study = Checks.verify(peers.ContactMechanics(points=32))
    outcomes = {task: task.solve() for batch in study.batches() for task in batch.tasks}
    found = by_verdict(study.judge(study.answers(outcomes)).findings)
    assert not found["fails"]
    assert {"verify.sphere.force", "verify.cone.depth", "verify.same.rest", "verify.seed"} <= found["holds"]
    # A quarter of 32 points shows no order.
    assert {"verify.order.sphere", "verify.slow.sphere.kelvin", "verify.wave.gap.0.5"} <= found["reported"]
