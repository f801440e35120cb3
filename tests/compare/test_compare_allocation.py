"""Who asks for an interval gets one as narrow, of as few surfaces as scatter and cost ask for."""

import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
import xarray
from small_cases import SLIDING
from test_compare_multilevel import answers

import compare
from bem3d import BEM
from compare.library.lookup import case_of
from compare.solving.cost import MOST_DRAWS
from compare.statistics.jackknife import mean_ratio
from compare.statistics.means import interval as interval_of
from compare.statistics.multilevel import DrawnSurfaces, means_of, pooled, unreached
from compare.studies.comparison import asked
from compare.studies.comparison.series import PILOT, pilot
from mdr1d import MDR
from scene import Refused

COSTS = 10.0, 3.0, 1.0


def means(found):
    """Mean of friction at every place."""
    return means_of("BEM", interval_of(pooled(found).expand_dims(speed=[0.0]), "friction_force"))


def needed(found, interval):
    """Surfaces of each stratum for intervals of friction of a half-width."""
    drawn = DrawnSurfaces({"BEM": tuple(np.bincount(found["stratum"]).tolist())}, {"BEM": COSTS})
    return drawn.more(means(found), interval)["BEM"]


def grown(rng, had, counts, variation, correlation=None):
    """Answers of `counts` surfaces on each level, the known ones among them."""
    new = answers(rng, counts, variation, correlation=correlation)
    if had is None:
        return new
    parts = []
    for stratum, old in had.groupby("stratum"):
        more = new.isel(surface=np.flatnonzero(new["stratum"] == stratum))
        parts += [old, more.isel(surface=slice(old.sizes["surface"], None))]
    return xarray.concat(parts, "surface")


def sampled(rng, variation, asked, correlation=None):
    """Answers once no more surfaces are asked for, and the number of looks.

    asked : function of answers that gives numbers of surfaces
    """
    had, counts, found, looks = None, pilot(3), None, 0
    while counts != had:
        had, looks = counts, looks + 1
        found = grown(rng, found, counts, variation, correlation)
        counts = asked(found)
    return found, looks


@pytest.mark.slow
@pytest.mark.parametrize(
    ("variation", "interval", "correlation", "least"),
    [(0.15, 0.02, None, 0.94), (0.5, 0.05, None, 0.94), (1.0, 0.1, None, 0.93), (0.15, 0.02, 0.85, 0.93)],
)
def test_intervals_hold_as_often_although_sampling_stops_by_them(variation, interval, correlation, least):
    """Five hundred synthetic studies of two points that share their surfaces.

    correlation : how a moment of the surfaces, among seven, correlates; None without any
    """
    rng, studies, held = np.random.default_rng(7), 500, []
    for _ in range(studies):
        surfaces = sampled(rng, variation, partial(needed, interval=interval), correlation)[0]
        found = pooled(surfaces).sel(level="fine")
        low, high = mean_ratio(found["friction_force"].values, 1.0, found["stratum"].values).interval()
        held.append(np.mean((low <= 1) & (high >= 1)))
    close = 2 * np.std(held) / studies**0.5
    assert least - close <= np.mean(held) <= 0.96 + close


def test_sampling_stops_with_intervals_as_narrow_as_wanted():
    rng = np.random.default_rng(0)
    for interval in (0.1, 0.05):
        found, looks = sampled(rng, 0.3, partial(needed, interval=interval))
        fine, coarse = (pooled(found).sel(level=grid) for grid in ("fine", "coarse"))
        ratio = mean_ratio(fine["friction_force"].values, 1.0, fine["stratum"].values)
        grid = abs(ratio.value - coarse["friction_force"].mean("surface").values)
        low, high = ratio.interval()
        assert np.all((high - low) / 2 + grid <= interval * ratio.value)
        assert looks <= 5


def test_an_interval_that_is_not_reached_says_why():
    found = answers(np.random.default_rng(2), pilot(3), 0.1)
    assert unreached(means(found), 0.5) == ""
    assert re.fullmatch(
        r"is known to [\d.]+ % only, 5 % are wanted: more surfaces would narrow it",
        unreached(means(found), 0.05),
    )
    force = found["friction_force"]
    coarse = found.assign(friction_force=force.where(found["level"] == "fine", 1.2 * force))
    assert re.fullmatch(
        r"is known to [\d.]+ % only, 10 % are wanted: its grid leaves [12]\d % open, take more points",
        unreached(means(coarse), 0.1),
    )


def test_the_grid_of_a_model_counts_the_interval_that_it_states_of_its_friction():
    found = answers(np.random.default_rng(2), pilot(3), 0.1).expand_dims(speed=[0.1])
    low, high = (found["friction_force"] / found["normal_force"] + each for each in (-0.2, 0.1))
    doubtful = found.assign(friction_low=low, friction_high=high)
    plain, wider = (interval_of(pooled(each), "friction_force", "normal_force") for each in (found, doubtful))
    np.testing.assert_allclose(wider.grid - plain.grid, 0.15, rtol=1e-9)
    assert np.array_equal(wider.value, plain.value)
    assert np.array_equal(wider.interval(), plain.interval())
    force = (interval_of(pooled(each), "normal_force") for each in (found, doubtful))
    assert len({each.grid.tobytes() for each in force}) == 1


def test_one_contact_without_an_answer_does_not_stop_the_others():
    found = answers(np.random.default_rng(1), pilot(3), 0.3)
    known = (found["surface"] != 3) | (found["level"] != "fine")
    failed = found.assign(friction_force=found["friction_force"].where(known))
    assert needed(failed, 0.03)[2] > PILOT


def test_no_stratum_takes_seeds_of_another():
    found = answers(np.random.default_rng(1), pilot(3), 0.3)
    drawn = DrawnSurfaces({"BEM": (MOST_DRAWS // 2,) * 3}, {"BEM": COSTS})
    assert max(drawn.more(means(found), 1e-6)["BEM"]) == MOST_DRAWS


CASE = replace(case_of(SLIDING), bem=BEM(points=64), mdr=MDR(points=1024))


def friction(dataset, end):
    return dataset[f"friction_coefficient_{end}"].sel(speed=[0.1, 1.0]).values


@pytest.mark.slow
@pytest.mark.usefixtures("in_this_process")
def test_a_sweep_reaches_the_interval_resumes_and_agrees_with_fixed_draws(tmp_path):
    # rest among the speeds hides no friction of those that slide
    asked = {"scene": CASE, "speed": [0.0, 0.1, 1.0], "report": False}
    found = compare.sweep(**asked, interval="12%", output=tmp_path / "few")
    half = (friction(found, "high") - friction(found, "low")) / 2
    assert np.all(half <= 0.12 * friction(found, "mean"))
    again = compare.sweep(**asked, interval=0.12, output=tmp_path / "few")
    xarray.testing.assert_identical(found, again)
    kept = compare.load(tmp_path / "few")["contacts"]["control_variates"].sel(model="BEM")
    assert np.isfinite(kept.sel(surface=kept["stratum"] == kept["stratum"].max())).all()
    fixed = compare.sweep(**asked, draws=10, output=tmp_path / "many")
    apart = abs(friction(found, "mean") - friction(fixed, "mean"))
    assert np.all(apart <= half + (friction(fixed, "high") - friction(fixed, "low")) / 2)


@pytest.mark.usefixtures("in_this_process")
def test_more_than_a_day_is_refused_where_a_look_asks_for_it(tmp_path, monkeypatch):
    monkeypatch.setattr("compare.solving.cost.COMMAND", 0.0)
    planned = asked.sweep(CASE, speed=[0.1], interval="0.1%").cost()
    monkeypatch.setattr("compare.solving.cost.DAY", 1.2 * planned.seconds)
    with pytest.raises(Refused, match="--yes"):
        compare.sweep(CASE, [0.1], interval="0.1%", output=tmp_path, workers=1, report=False)
    assert (tmp_path / "solved" / "answers.sqlite").exists()
