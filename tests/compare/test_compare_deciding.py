"""Claims that are not decided ask for surfaces, and say how many would decide them."""

from dataclasses import replace

import numpy as np
import pytest
import xarray
from small_cases import SLIDING
from test_compare_multilevel import answers

import compare
from bem3d import BEM
from compare.library.case import Variations
from compare.library.lookup import case_of
from compare.solving.curve import EMPTY, FINER, NOT_ASKED, SOLVED, of_model
from compare.statistics.finding import UNDECIDED, Claim, Finding
from compare.statistics.jackknife import friction
from compare.statistics.multilevel import GROWTH, DrawnSurfaces, pooled
from mdr1d import MDR
from scene import SolveError

RATIO = Claim("ratio", "The ratio is one", 1.0, 0.05, measure=lambda sample: float(friction(sample["BEM"])[0]))
DRAWN = DrawnSurfaces({"BEM": (8, 32), "MDR": (100,)}, {"BEM": (1e8, 1e7), "MDR": (1e5,)})
PARTS = {("BEM", 0): 0.1, ("BEM", 1): 0.6, ("MDR", 0): 0.3}
WORDS = {"BEM": "surfaces", "MDR": "profiles"}


def found(value=0.9, half=0.1, grid=0.002, parts=PARTS, **changed):
    """A finding of three strata; undecided by default."""
    return Finding(RATIO, value, (value - half, value + half), grid, parts=parts, **changed)


def variance(counts):
    """Variance of the finding with `counts` draws, divided by its present variance."""
    return sum(share * DRAWN.counts[name][k] / counts[name, k] for (name, k), share in PARTS.items())


def test_draws_that_are_asked_for_decide_at_least_cost():
    counts = DRAWN.deciding(found())
    left = 0.05 - 0.002
    assert 0.1 * variance(counts) ** 0.5 == pytest.approx(left, rel=1e-12)

    def cost(numbers):
        return sum(count * DRAWN.costs[name][k] for (name, k), count in numbers.items())

    for source in counts:
        other = counts | {source: 1.2 * counts[source]}
        scaled = {each: count * variance(other) / variance(counts) for each, count in other.items()}
        assert cost(scaled) > cost(counts)


def test_what_is_decided_unknown_or_without_surfaces_asks_for_none():
    for each in (
        found(0.7, 0.05),
        found(reason="none"),
        found(float("nan")),
        found(parts={}),
        replace(found(), claim=replace(RATIO, tolerance=float("nan"))),
    ):
        assert DRAWN.deciding(each, 0.01) == {}
        assert DRAWN.with_remedy(each, WORDS).remedy == ""


def test_an_interval_that_is_narrow_enough_needs_no_verdict():
    near = found(0.951, 0.03)
    assert near.verdict == UNDECIDED
    assert DRAWN.deciding(near, 0.04) == {}
    half = 0.03 * variance(DRAWN.deciding(near, 0.01)) ** 0.5
    assert half == pytest.approx(0.01 - 0.002, rel=1e-12)


def test_more_draws_are_bounded_and_never_fewer():
    counts = DRAWN.more([found(0.951, 0.3)], 0.001)
    assert counts == {"BEM": (32, 128), "MDR": (400,)}
    assert GROWTH == 4
    assert DRAWN.more([found(0.7, 0.05)], 0.001) == DRAWN.counts


def test_a_finding_says_what_would_decide_it():
    finding = DRAWN.with_remedy(found(), WORDS)
    asked = DRAWN.deciding(found())
    surfaces = sum(asked["BEM", k] - had for k, had in enumerate(DRAWN.counts["BEM"]) if asked["BEM", k] > had)
    number = float(finding.remedy.split()[1].replace(",", ""))
    assert number == pytest.approx(surfaces, rel=0.1)
    assert finding.remedy.endswith("s of processor time, would decide it")
    assert finding.why == f"its interval reaches across 0.95; {finding.remedy}"
    hopeless = DRAWN.with_remedy(found(0.951, 0.3, 0.0), WORDS)
    assert hopeless.remedy == "only more than 10,000 surfaces or profiles would decide it"
    assert "finer one" in DRAWN.with_remedy(found(0.951, 0.3, 0.01), WORDS).remedy


def test_what_does_not_touch_adds_nothing_to_either_force():
    given = answers(np.random.default_rng(0), (8, 8, 40))
    away = (given["surface"] == 55) & given["normal_force"].notnull()
    forces = given[["friction_force", "normal_force"]]
    nothing = forces.where(~away, 0.0)
    empty = forces.where(~away).assign(
        normal_force=nothing["normal_force"], status=xarray.where(away, EMPTY, SOLVED).astype(object)
    )
    found, wanted = (friction(pooled(each).sel(level="fine")) for each in (empty, nothing))
    np.testing.assert_allclose(found, wanted, rtol=1e-12)


CASE = replace(
    case_of(SLIDING),
    roughness=replace(SLIDING.roughness, rms_height=1e-5),
    study=Variations(speeds=(0.1,), pressing=(1.0,), load_speeds=(0.1,), depths=(1.0,)),
    bem=BEM(points=64),
    mdr=MDR(points=1024),
)


@pytest.mark.usefixtures("in_this_process")
def test_a_run_stops_where_its_interval_is_narrow_with_hard_surfaces_on_the_next_finer_grid(tmp_path, monkeypatch):
    solve = BEM.solve

    def failing(self, scene, *warm_start):
        if self.points < CASE.bem.points and getattr(scene.roughness, "seed", 1) % 5 == 0:
            raise SolveError("a hard surface")
        return solve(self, scene, *warm_start)

    monkeypatch.setattr(BEM, "solve", failing)
    asked = {"scene": CASE, "interval": "15%", "report": False, "output": tmp_path}
    report = compare.run(**asked)
    own = [each for each in report.judged if each.curve == "scene/own"]
    assert own
    assert all(each.verdict != UNDECIDED or np.ptp(each.interval) <= 0.3 for each in own)
    assert report.unsolved.failed == []
    (note,) = report.unsolved.notes
    assert note.endswith("too much for a coarse grid, and the next finer one answers in its place.")
    dataset = of_model(report.answers["scene/own"].to_dataset(inherit=False), "BEM").isel(speed=0, load=0)
    hard, last = dataset["surface"] % 5 == 0, dataset["stratum"] == 1
    coarse, fine = (dataset.sel(level=level) for level in ("coarse", "fine"))
    assert (coarse["status"] == np.where(hard, FINER, SOLVED)).all()
    assert (fine["status"] == np.where(last, NOT_ASKED, SOLVED)).all()
    both = (each["friction_force"].sel(surface=hard & ~last) for each in (coarse, fine))
    np.testing.assert_allclose(*both, rtol=1e-3)
    again = compare.run(**asked)
    assert (again.swept.solved, again.unsolved.notes) == (0, (note,))
    assert again.findings.equals(report.findings)


def test_an_interval_and_numbers_of_surfaces_are_not_both_stated():
    with pytest.raises(ValueError, match=r"interval = 0\.02: it takes the place of surfaces and profiles"):
        Variations(interval="2%", surfaces=3)
