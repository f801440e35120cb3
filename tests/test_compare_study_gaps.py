"""A study with gaps: what was not solved is undecided, with its reason; no claim is asked where it cannot hold."""

from dataclasses import replace

import numpy as np
import pytest
from test_compare_studies import SERIES, SLOPE, eq_19, obeying, verdicts
from test_compare_study_figures import spoiled

from compare import publish
from compare.outcome import Outcome, Row
from compare.studies import claims, depthclaims, families, report
from compare.studies.catalogue import SIZES, STUDIES
from compare.studies.judgement import JudgedStudy, judge_series
from compare.studies.series import FINE, REST, ROUGH, SMOOTH, Key, Solved, blocks, collect, tasks
from compare.studies.sides import Side
from compare.sweep import Swept
from mdr1d import equations

THREE = Key("BEM", ROUGH, FINE)


@pytest.fixture(autouse=True)
def quickly_drawn(monkeypatch):
    """Small pictures in one form: what a page says is the same."""
    save = publish.save
    monkeypatch.setattr(publish, "save", lambda folder, name, drawing, _: save(folder, name, drawing, ("png",)))
    monkeypatch.setattr(publish, "DOTS_PER_INCH", 50)


@pytest.fixture(scope="module")
def whole():
    return obeying(eq_19)


def cut(solved, speeds=None, presses=None, surfaces=None):
    """The same with fewer of them."""
    series, answers = solved.series, {}
    for key, each in solved.answers.items():
        draws = surfaces if key.body in (ROUGH, REST) else None
        place = np.s_[:speeds, :presses, :draws]
        numbers = {
            name: getattr(each, name)[place] for name in ("normal_force", "friction_force", "depth", "contact")
        }
        measures = {name: values[place] for name, values in each.measures.items()}
        answers[key] = replace(each, measures=measures, **numbers)
    count = surfaces or series.surfaces
    less = replace(
        series, speeds=series.speeds[:speeds], presses=series.presses[:presses], surfaces=count, profiles=count
    )
    return Solved(less, answers)


def found(judged, part):
    return [each for each in judged.findings if part in each.claim]


def written(folder, judged):
    study = JudgedStudy("collapse", STUDIES["collapse"], SIZES["quick"], (judged,))
    return report.write_study(folder, study, Swept({}, 1, 0, 1.0)).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "place",
    [
        np.s_[0, 2],
        *(pytest.param(place, marks=pytest.mark.slow) for place in (np.s_[-1, 2], np.s_[0], np.s_[0, 2, :5])),
    ],
)
def test_a_point_without_answer_leaves_undecided_what_needs_it_and_the_page_whole(whole, tmp_path, place):
    judged = judge_series(spoiled(whole, THREE, place))
    assert len(judged.findings) == len(judge_series(whole).findings)
    three = [each for each in judged.findings if each.dimension == "3D"]
    lost = [each for each in three if each.verdict == "undecided"]
    assert "Eq. 19: friction at all speeds and loads" in {each.claim for each in lost}
    assert all("half of the surfaces" in each.undecidable for each in lost)
    # the shifts leave the point out
    assert {each.verdict for each in three if "Eq. 23" in each.claim} == {"holds"}
    assert "half of the surfaces" in written(tmp_path, judged)


def test_friction_that_is_not_positive_on_average_is_no_number(whole):
    answers = whole.answers[THREE]
    pushed = answers.friction_force.copy()
    pushed[0, 0] *= -1
    judged = judge_series(Solved(SERIES, whole.answers | {THREE: replace(answers, friction_force=pushed)}))
    (level,) = (each for each in found(judged, "level of friction") if each.dimension == "3D")
    assert (level.verdict, np.isnan(level.value)) == ("undecided", True)
    assert "not positive" in level.undecidable


def test_an_average_of_fewer_than_half_of_the_surfaces_is_none(whole):
    for lost, known in ((4, True), (5, False)):
        side = Side.of(spoiled(whole, THREE, np.s_[1, 1, :lost]), "BEM")
        assert np.isfinite(side.friction()[1, 1]) == known
        assert np.isfinite(side.mean("depth", ROUGH)[1, 1]) == known


def test_of_one_surface_the_reason_is_that_its_scatter_is_not_known(whole):
    judged = judge_series(cut(whole, surfaces=1))
    rough = [each for each in judged.findings if each.surfaces]
    assert {each.verdict for each in rough} == {"undecided"}
    assert all("scatter" in each.undecidable for each in rough)
    assert not any("straight" in each.undecidable for each in rough)


def test_smooth_bodies_need_no_second_surface(whole):
    (smooth,) = found(judge_series(cut(whole, surfaces=1)), "smooth")
    assert (smooth.verdict, smooth.surfaces, smooth.statistical) == ("holds", 0, (smooth.value, smooth.value))
    key = Key("BEM", SMOOTH, FINE)
    (smooth,) = found(judge_series(spoiled(whole, key, np.s_[0, 1])), "smooth")
    assert smooth.verdict == "undecided"


@pytest.mark.parametrize(
    "less",
    [
        {"speeds": 1, "presses": 1},
        *(pytest.param(less, marks=pytest.mark.slow) for less in ({"speeds": 1}, {"presses": 1}, {"speeds": 2})),
    ],
)
def test_nothing_is_fitted_through_a_single_point_and_no_speed_is_asked_twice(whole, tmp_path, less):
    judged = judge_series(cut(whole, **less))
    if "presses" in less:
        assert not found(judged, "F_N^(-n/(n+1))")
    if "speeds" in less:
        assert len(found(judged, "friction in 1D is that in 3D, rough")) == 1
    assert written(tmp_path, judged)


def test_speeds_are_named_by_where_they_lie(whole):
    asked = {each.claim.split(", ")[-1] for each in found(judge_series(whole), "in 3D, rough")}
    assert asked == {"at the slowest speed", "at the knee", "at the fastest speed"}
    # all of these lie far below the knee
    slow = found(judge_series(cut(whole, speeds=3)), "in 3D, rough")
    assert [each.claim.split(", ")[-1] for each in slow] == ["at the slowest speed"]


def test_a_series_of_which_nothing_was_solved_is_no_verdict_and_says_so(tmp_path):
    series = replace(SERIES, speeds=SERIES.speeds[:2], presses=SERIES.presses[:2])
    outcomes = {task: Outcome(tuple(Row(reason="no") for _ in task.scenes)) for task in tasks(series)}
    judged = judge_series(collect(series, outcomes))
    assert judged.findings == ()
    assert "No claim can be judged" in written(tmp_path, judged)


def test_shifts_that_could_not_be_sought_are_a_finding_without_verdict(whole):
    # one surface of eight is left
    judged = judge_series(spoiled(whole, THREE, np.s_[:, :, 1:]))
    assert "BEM" not in judged.shiftings
    (missing,) = (each for each in found(judged, "Eq. 23: shifts along") if each.dimension == "3D")
    assert (missing.verdict, missing.surfaces) == ("undecided", SERIES.surfaces)
    assert "too few points" in missing.undecidable


def test_a_series_without_roughness_is_refused():
    with pytest.raises(ValueError, match="has none"):
        blocks(replace(SERIES, scene=replace(SERIES.scene, roughness=None)))


def test_every_finding_leads_to_the_figure_that_shows_it(whole):
    judged = judge_series(whole)
    assert {each.figure for each in found(judged, "at rest")} == {"study-depth"}
    assert {each.figure for each in found(judged, "F_N^(-n/(n+1))")} == {"study-collapse"}
    rest = depthclaims.depth_findings(Solved(replace(SERIES, speeds=()), whole.answers))
    assert {each.figure for each in rest} == {"study-depth"}


def another(solved, name, **roughness):
    rough = replace(solved.series.scene.roughness, **roughness)
    return replace(solved, series=replace(SERIES, name=name, scene=replace(SERIES.scene, roughness=rough)))


def test_one_scene_twice_says_nothing_of_roughness(whole):
    judged = judge_series(whole)
    assert list(families.family_findings((judged, judged))) == []


def test_series_on_fewer_surfaces_are_no_part_of_a_family(whole):
    one, two = judge_series(whole), judge_series(another(whole, "two", hurst=0.7))
    few = cut(whole, surfaces=3)
    three = judge_series(few)
    (members,) = families.families((three, one, two)).values()
    assert members == [one, two]
    assert len(list(families.family_findings((three, one, two)))) == 2


def test_friction_that_obeys_the_law_has_its_powers_of_the_slope_near_the_limits_too():
    # at the fastest speed xi is 3 at least, and Eq. 19 is up to 11 % below its plateau
    members, shape = [], SERIES.scene.indenter
    for factor in (0.5, 1.0, 2.0):

        def law(load, speed, slope=factor * SLOPE):
            xi = equations.similarity_variable(
                load, 1e6, 1e-3, speed, slope, shape.mdr_coefficient, shape.exponent
            )
            return equations.plateau(slope) * equations.interpolation(xi)

        solved = another(obeying(law), f"{factor:g}", rms_height=factor * SERIES.scene.roughness.rms_height)
        answers = {
            key: replace(each, measures=each.measures | {"rms_slope": factor * each.measures["rms_slope"]})
            for key, each in solved.answers.items()
        }
        members.append(judge_series(replace(solved, answers=answers)))
    powers = [each for each in families.family_findings(members) if "power" in each.claim]
    assert {(each.dimension, each.expected) for each in powers} == {
        (dimension, expected) for dimension in ("1D", "3D") for expected in (1.0, 2.0)
    }
    assert {each.verdict for each in powers} == {"holds"}
    # where no press is slow for all rms heights, nothing is asked of slow friction
    late = [
        replace(each, laws={name: replace(laws, xi=laws.xi + claims.SLOW) for name, laws in each.laws.items()})
        for each in members
    ]
    assert {each.expected for each in families.family_findings(late) if "power" in each.claim} == {1.0}


@pytest.mark.slow
def test_a_second_report_drops_the_failures_of_the_first(whole, tmp_path):
    written(tmp_path, judge_series(spoiled(whole, THREE, np.s_[0, 2])))
    assert (tmp_path / "sphere" / "failed.csv").exists()
    assert "failed.csv" not in written(tmp_path, judge_series(whole))
    assert not (tmp_path / "sphere" / "failed.csv").exists()


def test_both_dimensionalities_are_asked_the_same_in_the_same_words(whole):
    judged = judge_series(whole)
    assert set(verdicts(judged, "1D")) == set(verdicts(judged, "3D"))
