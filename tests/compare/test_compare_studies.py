"""Studies: what claims come to on answers that obey a law, on answers with gaps, and on those of solvers."""

from dataclasses import replace
from functools import reduce

import numpy as np
import pytest
from invented_answers import FEW, SERIES, SLOPE, changed, cut, eq_19, obeying, other, spoiled
from small_cases import seldom

from compare.library.ready import studies
from compare.solving import curve
from compare.statistics.finding import REPORTED
from compare.statistics.jackknife import friction, mean
from compare.studies.comparison import asked, together
from compare.studies.comparison.answers import THEORIES
from compare.studies.comparison.comparison import Comparison
from compare.studies.comparison.measures import SLOW, loading
from compare.studies.comparison.rough import ROUGH, SMOOTH, RoughSeries
from scene import Indent, Program, Slide, Stage
from scene.files.reading import InvalidInput

# Friction that grows as a length is none that is the same over every part of an area.
DRAG = "eq17.friction-per-contact"


def of(judged, name, dimension=None):
    """The findings on claims whose id begins so."""
    found = [each for each in judged.findings if each.claim.id.startswith(name) and each.verdict != REPORTED]
    return [each for each in found if dimension in (None, each.dimension)]


def verdicts(judged, dimension):
    return {each.claim.id: each.verdict for each in of(judged, "", dimension)}


@pytest.fixture(scope="module")
def whole():
    return obeying(eq_19)


@pytest.fixture(scope="module")
def judged(whole):
    return whole.judge()


def test_answers_that_obey_the_law_are_said_to_in_both_dimensionalities_by_the_same_claims(judged):
    one, three = verdicts(judged, "1D"), verdicts(judged, "3D")
    assert set(one.values()) == {"holds"}, one
    assert "limit.slow" in one
    assert three == one | {DRAG: "fails"}


STRAIGHT = {f"eq23.{name}": "undecided" for name in ("collapse", "vertical", "exponent")}
LEVEL = "eq17.level-least"
LEVELS = {
    f"{name}-{end}": "fails"
    for name in ("eq17.level", "eq19.level", "eq14.plateau")
    for end in ("least", "greatest")
} | {"eq19.law": "fails"}


@pytest.mark.parametrize(
    ("answers", "expected"),
    [
        # half as high: what speaks of levels, and nothing else
        (
            lambda: obeying(eq_19, level=0.5),
            LEVELS | dict.fromkeys(("eq23.collapse", "eq17.speed-exponent"), "holds"),
        ),
        # shifts of friction itself, by little and by more than the tolerance
        (
            lambda: obeying(lambda load, speed: eq_19(load, speed) * speed**0.1),
            {"eq23.vertical-exponent": "fails", "eq23.collapse": "holds"},
        ),
        (
            lambda: obeying(lambda load, speed: eq_19(load, speed) * speed**0.33),
            {"eq23.vertical-exponent": "fails", "eq23.collapse": "fails"},
        ),
        # a solid whose loss grows with the root of the frequency, judged as if it were a Kelvin solid
        (
            lambda: obeying(lambda load, speed: eq_19(load, speed**0.5 * 0.3)),
            {"eq23.collapse": "holds", "eq23.exponent": "fails", "eq23.predicted": "fails"},
        ),
        # shifts of straight lines cannot be distinguished; the predicted shift is not sought, and fits
        (
            lambda: obeying(lambda load, speed: 1e-2 * load ** (-2 / 3) * speed),
            STRAIGHT | {"eq23.predicted": "holds"},
        ),
        # the grid may have made it
        (lambda: obeying(eq_19, grid=0.2), {LEVEL: "undecided"}),
    ],
    ids=["level", "little vertical", "vertical", "wrong shift", "straight", "grid"],
)
def test_answers_that_break_a_law_break_the_claims_on_it(answers, expected):
    found = answers().judge()
    three = verdicts(found, "3D")
    assert three | expected == three
    if expected.get(LEVEL) == "fails":
        assert {each.verdict for each in of(found, "friction.ratio.") if each.draws} == {"fails"}
        assert {name for name, verdict in three.items() if verdict == "fails"} == {*LEVELS, DRAG}
    straight = [each.reason for each in of(found, "eq23", "3D") if each.verdict == "undecided"]
    assert all("straight" in reason for reason in straight if reason) or LEVEL in expected


def test_a_level_that_differs_from_load_to_load_is_stated_at_two_with_what_they_are():
    found = obeying(lambda load, speed: eq_19(load, speed) * load**0.3).judge()
    least, greatest = of(found, "eq17.level", "3D")
    loads = SERIES.values[0], SERIES.values[-1]
    assert greatest.value / least.value == pytest.approx((loads[1] / loads[0]) ** 0.3, rel=0.02)
    for each, load in zip((least, greatest), loads, strict=True):
        assert each.regime.startswith(f"F_N {load:.3g} N, ξ ")
        assert " to " not in each.regime  # one point
    ratios = of(found, "friction.ratio.slow")
    assert [each.claim.id for each in ratios] == ["friction.ratio.slow-least", "friction.ratio.slow-greatest"]


@pytest.mark.parametrize("place", [np.s_[0, 2], np.s_[0, 2, :5]])
def test_a_point_without_answer_leaves_undecided_what_needs_it(whole, judged, place):
    found = spoiled(whole, place).judge()
    assert len(of(found, "")) == len(of(judged, ""))
    three = of(found, "", "3D")
    lost = [each for each in three if each.verdict == "undecided"]
    assert "eq19.law" in {each.claim.id for each in lost}
    assert all("fewer than half of the surfaces" in each.reason for each in lost)
    # the shifts leave the point out
    assert {each.verdict for each in three if each.claim.id.startswith("eq23")} == {"holds"}


def test_a_surface_that_fails_everywhere_is_left_out_and_of_none_shifts_are_not_sought(whole, judged):
    found = spoiled(whole, np.s_[:, :, 3]).judge()
    assert found.collapses["BEM"].data.surfaces == judged.collapses["BEM"].data.surfaces - 1
    assert {name for name, verdict in verdicts(found, "3D").items() if verdict != "holds"} == {DRAG}
    found = spoiled(whole, np.s_[:, :, 1:]).judge()
    assert "BEM" not in found.collapses
    (missing,) = of(found, "eq23", "3D")
    assert (missing.verdict, missing.draws) == ("undecided", SERIES.surfaces)
    assert "too few points" in missing.reason


def test_an_average_of_fewer_than_half_of_the_surfaces_is_none(whole):
    for lost, known in ((4, True), (5, False)):
        answers = spoiled(whole, np.s_[1, 1, :lost])("BEM")
        assert np.isfinite(friction(answers)[2, 1]) == known
        assert np.isfinite(mean(answers, "depth_reached")[2, 1]) == known


def test_friction_that_is_not_positive_on_average_is_no_number(whole):
    pushed = changed(whole, place=np.s_[1, 0], friction_force=lambda values: -values)
    (level,) = of(pushed.judge(), LEVEL, "3D")
    assert (level.verdict, np.isnan(level.value)) == ("undecided", True)
    assert "not positive" in level.reason


def test_of_one_surface_the_scatter_is_not_known_but_smooth_bodies_need_none(whole):
    found = cut(whole, surfaces=1).judge()
    rough = [each for each in of(found, "") if each.draws]
    assert {each.verdict for each in rough} == {"undecided"}
    assert all("scatter" in each.reason and "straight" not in each.reason for each in rough)
    smooth, _ = of(found, "friction.ratio.smooth")
    assert (smooth.verdict, smooth.draws, smooth.scatter) == ("fails", 0, (smooth.value, smooth.value))
    least, greatest = of(spoiled(whole, np.s_[0, 0], body=SMOOTH).judge(), "friction.ratio.smooth")
    assert (least.verdict, greatest.verdict) == ("undecided", "fails")


def test_a_family_on_one_law_is_one_curve_and_one_of_two_laws_is_not():
    answers = obeying(eq_19, FEW)
    first = answers.judge()
    for level, three in ((1.0, "holds"), (1.5, "fails")):
        second = other(obeying(eq_19, FEW, level=level, seed=2), "second", hurst=0.7).judge()
        one, both = together.together([first, second])
        assert (one.dimension, one.verdict, both.verdict) == ("1D", "holds", three)
    # the same scene twice says nothing of roughness; one on fewer surfaces is no part of a family
    assert not list(together.together((first, first)))
    third = cut(answers, surfaces=3).judge()
    assert together.families((third, first, second)) == {"every sphere": [first, second]}


def test_a_family_whose_points_are_too_few_for_one_curve_is_undecided():
    asked_for = obeying(eq_19, FEW), other(obeying(eq_19, FEW, seed=2), "second", hurst=0.7)
    left = [reduce(spoiled, range(1, len(FEW.speeds)), spoiled(each, np.s_[0, 1:])) for each in asked_for]
    one, both = together.together([each.judge() for each in left])
    assert (one.verdict, both.verdict, both.why) == (
        "holds",
        "undecided",
        "too few points or surfaces have an answer",
    )


def test_friction_that_obeys_the_law_has_its_powers_of_the_slope_near_the_limits_too():
    # at the fastest speed xi is 3 at least, and Eq. 19 is up to 11 % below its plateau
    members = []
    for factor in (0.5, 1.0, 2.0):
        slope = factor * SLOPE
        answers = obeying(lambda load, speed, slope=slope: eq_19(load, speed, slope=slope), FEW, slope=slope)
        height = factor * SERIES.scene.roughness.rms_height
        members.append(other(answers, f"{factor:g}", rms_height=height).judge())

    def powers(members):
        return [each for each in together.together(members) if "slope-exponent" in each.claim.id]

    found = sorted((each.claim.dimension, each.claim.expected, each.verdict) for each in powers(members))
    assert found == [(dimension, power, "holds") for dimension in ("1D", "3D") for power in (1.0, 2.0)]
    # where no load is slow for all rms heights, nothing is asked of slow friction
    late = [
        replace(each, laws={name: replace(found, xi=found.xi + SLOW) for name, found in each.laws.items()})
        for each in members
    ]
    assert {each.claim.expected for each in powers(late)} == {1.0}


def test_a_series_pressed_by_depth_stays_so_and_is_solved_at_rest_too():
    sunk = replace(SERIES, scene=replace(SERIES.scene, motion=Slide(speed=1.0, depth=1e-4)))
    assert sunk.curves["rough"].at(2e-4, 0.5).motion == Slide(speed=0.5, depth=2e-4)
    assert sunk.curves["rough"].at(2e-4).motion == Indent(depth=2e-4)
    pressed = replace(sunk, scene=replace(sunk.scene, motion=Program(stages=(Stage(duration=1.0, depth=1e-4),))))
    assert pressed.curves["rough"].at(2e-4, 0.1).motion == Program(stages=(Stage(duration=2e-3, depth=2e-4),))
    assert not pressed.slides
    assert {each.speeds for each in sunk.curves.values()} == {(0.0, *SERIES.speeds)}
    with pytest.raises(InvalidInput, match="has none"):
        _ = replace(SERIES, scene=replace(SERIES.scene, roughness=None)).curves


def test_pressing_in_is_compared_at_the_depth_that_was_reached():
    # a march answers for the middle of its last step: half a step less deep, and F ~ d^m less force
    depths, pressed = np.array([[1e-4, 2e-4]] * 2), (SERIES.scene, (1e-2, 1e-1))
    whole, less = loading(*pressed, depths), loading(*pressed, 0.99 * depths)
    assert np.all((less < whole) & (less > 0.99**1.5 * whole * 0.99))
    unknown = loading(*pressed, np.array([[np.nan, 0.0], [1e-4, 2e-4]]))
    assert np.isnan(unknown[0]).all()
    assert np.array_equal(unknown[1], whole[1])


MANY_TASKS = {"solids", "hurst", "parameters", "regime"}


@pytest.mark.parametrize("name", seldom(studies(), studies().keys() - MANY_TASKS))
def test_every_study_can_be_solved_by_both_and_solves_nothing_twice(name):
    study = asked.study(name, "quick")
    assert (study.title, study.about) == (studies()[name].title, studies()[name].about)
    contacts = curve.contacts_of(study.grids())
    assert len({(each.solver, each.scenes) for each in contacts}) == len(contacts)
    assert {each.solver.name for each in contacts} - {each.name for each in THEORIES} == {"MDR", "BEM"}


def test_series_of_a_family_are_asked_for_as_many_surfaces(monkeypatch):
    first = obeying(eq_19, FEW)
    asked = {"sphere": {ROUGH: {"BEM": (8, 32)}}, "second": {ROUGH: {"BEM": (16, 8, 4)}}}
    monkeypatch.setattr(RoughSeries, "answers", lambda *_: None)
    monkeypatch.setattr(RoughSeries, "more", lambda self, *_: asked[self.name])
    series = (replace(each.series, interval=0.3) for each in (first, other(first, "second", hurst=0.7)))
    found = Comparison(tuple(series), "study", "Two").more(None, ())
    assert [each.strata for each in found.series] == [{ROUGH: {"BEM": (16, 32)}}] * 2  # on the grids of both
