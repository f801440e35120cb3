"""A run of scenes: curves of a case, what is found of answers that are known, and the page of a small contact."""

import re
from dataclasses import replace

import numpy as np
import pytest
from invented_answers import outside
from small_cases import TINY

import compare
from bem3d import BEM
from compare.figures import style
from compare.library.case import Variations
from compare.library.ready import ready
from compare.report.export import FIGURES
from compare.solving.cost import MOST_DRAWS
from compare.solving.curve import COARSE, FINE, contacts_of
from compare.solving.task import Outcome, Row
from compare.statistics import finding
from compare.studies.comparison import asked
from compare.studies.comparison.around import (
    LOAD,
    OWN,
    ROUGH_DEPTH,
    SMOOTH_DEPTH,
    SMOOTH_SPEED,
    SPEED,
    Around,
)
from compare.studies.report import SOLVED
from compare.studies.study import Study
from scene import (
    Coulomb,
    Elastic,
    Indent,
    Program,
    Prony,
    Shear,
    Slide,
    Stage,
)
from scene.files.reading import InvalidInput
from scene.printable import brief

AROUND = replace(TINY.study, pressing=(0.3, 1.0, 3.0, 10.0), load_speeds=(0.03, 0.1, 0.3), depths=(0.5, 1.0))
ROUGH = replace(TINY.roughness, hurst=0.5, shortest=2e-3)
CASE = replace(TINY, title="", roughness=ROUGH, study=replace(AROUND, profiles=4))
DEEP = replace(CASE, motion=Slide(speed=0.1, depth=1e-4))


def contacts(case):
    return {name: (each.speeds, each.values) for name, each in Around("a case", case).curves.items()}


REST = {OWN, ROUGH_DEPTH, SMOOTH_DEPTH}


@pytest.mark.parametrize(
    ("change", "left"),
    [
        ({"motion": Indent(load=1.0)}, REST),
        ({"elastomer": Elastic(modulus=1e6)}, REST),
        ({"roughness": None}, {OWN, SMOOTH_DEPTH, SPEED, LOAD, SMOOTH_SPEED}),
        ({"elastomer": Prony(1e6, (1e6, 2e6), (1e-3, 1e-2))}, REST | {SPEED, LOAD}),
        ({"motion": Slide(speed=0.0, load=1.0)}, REST | {SPEED, LOAD, SMOOTH_SPEED}),
    ],
    ids=["at rest", "elastic", "smooth", "two times", "starting from rest"],
)
def test_only_curves_that_mean_something_are_solved(change, left):
    assert set(contacts(replace(CASE, **change))) == left


def test_depth_stays_prescribed_where_the_scene_prescribes_it():
    assert all(each.prescribed == "depth" for each in Around("a case", DEEP).curves.values())
    assert contacts(DEEP)[LOAD][1] == pytest.approx((0.3e-4, 1e-4, 3e-4, 1e-3))


def test_no_scene_is_solved_twice_and_fields_are_kept_of_the_own_contact_alone():
    curves = Around("a case", CASE).curves
    asked = contacts_of(curves)
    solved = [(each.solver, scene) for each in asked for scene in each.scenes]
    assert len(solved) == len(set(solved))
    assert set(asked) == {each for curve in curves.values() for each in contacts_of({"": curve})}
    kept = {(task.solver, task.scenes[0]) for task in asked if task.keeps_fields}
    assert kept == {(CASE.mdr, CASE.scene), (CASE.bem, CASE.scene)}


@pytest.mark.parametrize(
    ("case", "rough", "smooth"),
    [
        (CASE, {FINE, COARSE}, {FINE, COARSE}),
        (replace(CASE, roughness=replace(CASE.roughness, shortest=None)), {FINE}, {FINE, COARSE}),
        (replace(CASE, bem=BEM(points=16)), {FINE}, {FINE}),
    ],
    ids=["resolved", "cut off by the grid", "too few points to halve"],
)
def test_a_grid_of_half_the_points_is_solved_where_it_has_the_same_surface(case, rough, smooth):
    found = Around("a case", case).curves
    assert {name: set(grids) for name, grids in found[OWN].levels.items()}["BEM"] == rough
    assert set(found[SMOOTH_DEPTH].levels["BEM"]) == smooth


# Answers that are known: friction of 3D is v^-0.1 F^-0.2, and twice that in 1D; force is depth, 10 % more in 1D.
FRICTION, FORCE = 2.0, 1.1


def invented_of(run, **how):
    return {each: invented(each, **how) for each in contacts_of(run.grids())}


def invented(task, halved=0.0, scatter=0.0, broken=(), random=None):
    """Rows of a contact.

    halved : error of a coarse 3D grid; scatter : between surfaces of 3D; broken : seeds; random : generator, where
    all contacts scatter, and on coarse grids the first surfaces have estimates far apart
    """
    rows, name = [], task.solver.name
    coarse = name == "BEM" and task.solver.points < CASE.bem.points  # as of TINY
    for scene in task.scenes:
        seed = 0 if scene.roughness is None else scene.roughness.seed - CASE.roughness.seed
        if name == "BEM" and scene.roughness and seed in broken:
            rows.append(Row(reason="no answer"))
            continue
        motion = scene.motion
        load = motion.load if motion.load is not None else motion.depth * 1e4
        load *= FORCE if name == "MDR" and motion.load is None else 1.0
        friction = 0.1 * (motion.speed or 1.0) ** -0.1 * load**0.8 * (FRICTION if name == "MDR" else 1.0)
        friction *= (1 + halved * coarse) * (1 + scatter * (-1) ** seed * (name == "BEM"))
        traction = 1.02 * friction
        if random is not None:
            friction *= np.exp(0.1 * random.normal()) if scene.roughness else 1.0
            traction = friction * (1 + (0.5 if coarse and seed < MOST_DRAWS else 0.05) * random.lognormal())
        measures = {"friction_by_traction": traction, "friction_by_loss": friction} if name == "BEM" else {}
        rows.append(Row(load, 1e-4, friction, 0.0, 1.0, 2.0, measures | {"rms_slope": 0.01}))
    return Outcome(tuple(rows))


def solved(case=CASE, **how):
    """A run of a case, its answers and what is judged of them."""
    run = asked.run({"a case": case})
    answers = run.answers(invented_of(run, **how))
    return run, answers, run.judge(answers)


def table_of(judged):
    return finding.table(judged.findings).set_index(["claim", "where"])


def judged(*case, **how):
    return table_of(solved(*case, **how)[2])


@pytest.mark.parametrize("interval", [None, 0.05], ids=["fixed draws", "draws in strata"])
def test_every_number_lies_in_its_interval(interval):
    """Over draws in strata a mean is a sum of differences, and the mean of a size may be negative by chance."""
    run = asked.run({"a case": TINY}, interval=interval)
    findings = run.judge(run.answers(invented_of(run, random=np.random.default_rng(0)))).findings
    assert not outside(findings)
    assert min(each.value for each in findings if each.claim.id == "friction.spread") >= 0


def test_known_answers_are_found():
    found = judged()
    own = found.loc["friction.ratio.own", "a case"]
    assert own[["value", "low", "high", "surfaces", "verdict"]].tolist() == [pytest.approx(2)] * 3 + [2, "fails"]
    assert found.loc["friction.ratio.smooth-slow", "a case"][["verdict", "surfaces"]].tolist() == ["holds", 0]
    for claim in ("force.ratio.rough", "force.ratio.smooth"):
        rows = found.loc[claim]
        assert len(rows) == 2  # every depth, none chosen
        np.testing.assert_allclose(rows["value"], FORCE - 1, rtol=1e-12)
        assert set(rows["verdict"]) == {"fails"}
    np.testing.assert_allclose(found.loc["friction.spread"]["value"], 0.02, rtol=1e-12)
    # a power law collapses by any shift
    shifted = found.loc["eq23.collapse", "a case"]
    assert shifted["verdict"].tolist() == ["undecided"] * 2
    assert shifted["reason"].str.contains("straight parallel lines").all()


def test_the_error_of_the_grid_widens_every_interval_and_scatter_as_much_as_it_should():
    found = judged(halved=0.02)
    own = found.loc["friction.ratio.own", "a case"]
    assert own["grid"] == pytest.approx(2 * (1 - 1 / 1.02))
    assert own["high"] - own["value"] == pytest.approx(own["grid"])
    assert found.loc["grid.change", "a case"].set_index("model")["value"].tolist() == pytest.approx([0, 0.02])
    low, high = judged(scatter=0.1).loc["friction.ratio.own", "a case"][["low", "high"]]
    # Two surfaces, 10 % each way: 12.7 standard errors of 10 % of the ratio.
    assert high - low == pytest.approx(2 * 12.706 * 2 * 0.1, rel=0.02)


@pytest.mark.parametrize(
    ("case", "reason"),
    [
        (replace(CASE, study=replace(CASE.study, surfaces=1)), "scatter"),
        (replace(CASE, roughness=replace(CASE.roughness, shortest=None)), "grid"),
    ],
)
def test_without_an_error_nothing_is_decided(case, reason):
    found = judged(case)
    own = found.loc["friction.ratio.own", "a case"]
    assert own["verdict"] == "undecided"
    assert reason in own["reason"]


def test_a_surface_that_failed_is_left_out_and_listed():
    run, answers, found = solved(replace(CASE, study=replace(CASE.study, surfaces=3)), broken={1})
    assert table_of(found).loc["friction.ratio.own", "a case"]["value"] == pytest.approx(2)
    own = run.series[0].answers(answers)
    failed = own.failures
    assert set(failed["reason"]) == {"no answer"}
    assert set(failed["surface"]) == {CASE.roughness.seed + 1}
    points = own.points.query("model == 'BEM' and curve in ('own', 'friction-speed', 'friction-load')")
    assert set(points["failures"]) == {1}
    assert set(points["surfaces"]) == {2}


@pytest.mark.parametrize("surfaces", [2, 3])
def test_points_have_means_and_intervals_of_the_two_surfaces_that_are_solved(surfaces):
    case = replace(CASE, study=replace(CASE.study, surfaces=surfaces))
    run, answers, _ = solved(case, scatter=0.1, broken={2})
    points = run.series[0].answers(answers).points
    one = points.query("curve == 'own' and model == 'BEM'").iloc[0]
    mu = one["friction_coefficient_mean"]
    assert mu == pytest.approx(0.1 * 0.1**-0.1)
    assert one["friction_coefficient_high"] - mu == pytest.approx(12.706 * 0.1 * mu, rel=1e-3)
    assert points.query("model == 'exact'")["normal_force_mean"].notna().all()


@pytest.mark.parametrize("motion", [CASE.motion, pytest.param(DEEP.motion, marks=pytest.mark.slow)])
def test_one_value_of_everything_is_drawn_without_a_warning(motion):
    one = Variations(speeds=(0.1,), pressing=(1.0,), load_speeds=(0.1,), depths=(1.0,), surfaces=1, profiles=1)
    _, _, found = solved(replace(CASE, motion=motion, study=one))
    with style.applied():
        for plot in found.plots:
            plot.figure().draw_without_rendering()


def test_several_files_are_named_by_themselves_and_two_of_one_name_refused(tmp_path):
    assert [each.name for each in asked.run(["paper-cone", "quick-start"]).series] == ["paper-cone", "quick-start"]
    assert [each.name for each in asked.run(["quick-start"]).series] == ["quick-start"]
    (tmp_path / "quick-start.toml").write_text(ready()["paper-cone"].text)
    with pytest.raises(InvalidInput, match=r"quick-start.toml, .*quick-start.toml: both are called quick-start"):
        asked.run([tmp_path / "quick-start.toml", "quick-start"])
    with pytest.raises(InvalidInput, match="a Scene or a Case is needed"):
        asked.run([CASE, DEEP])


def opening_of(case, **how):
    """The table of a case as texts, and the advice on its rows."""
    _, answers, found = solved(case, **how)
    table, claims = found.page("", answers).opening
    return table, claims, table.frame.set_index("")


def test_a_run_opens_with_a_table_of_answers_ratios_and_advice_then_a_line_a_claim():
    table, claims, answers = opening_of(CASE)
    assert table.caption == "a case, 1 N, 0.1 m/s, 4 profiles, 2 surfaces"
    assert answers.loc["friction", ["1D (MDR)", "3D (BEM)", "1D/3D"]].tolist() == ["0.252", "0.126", "2"]
    advice = compare.trust(CASE.scene)
    assert answers.loc["friction", "advice"].startswith(f"multiply 1D by {advice.friction.times}")
    assert answers.loc["depth [µm]", "advice"] == "use 1D as it is"
    assert claims.frame["claim"].is_unique  # a single scene
    assert set(claims.frame.query("claim.str.startswith('rough force')")["verdict"]) == {"fails"}
    # twice what the map foretells, whatever the scatter
    *_, other = opening_of(replace(CASE, roughness=replace(CASE.roughness, rms_height=2e-5)))
    assert "disagree" in other.loc["friction", "advice"]
    *_, deep = opening_of(DEEP)
    assert deep.loc["force [N]", ["1D (MDR)", "3D (BEM)", "1D/3D"]].tolist() == ["1.1", "1", "1.1"]


def marched(task):
    """A row of a contact with its history: force grows with the square of time, a tenth more in 1D."""
    times = np.linspace(0, 2.0, 21)[1:]
    force = times**2 * (1.1 if task.solver.name == "MDR" else 1.0)
    fields = {"time": times, "normal_force": force, "depth": times * 1e-5, "friction_force": 0 * force}
    return Outcome((Row(force[-1], 2e-5, 0.0, 0.0, 1.0, 1.0),), fields)


def test_a_program_is_compared_over_time():
    motion = Program(stages=(Stage(duration=1.0, depth=1e-5), Stage(duration=1.0, depth=2e-5)))
    run = asked.run({"a case": replace(CASE, motion=motion)})
    answers = run.answers({task: marched(task) for task in run.batches()[0].tasks})
    answers["a-case"] = answers["a-case"].drop_nodes("fields")  # without surfaces
    assert set(answers["a-case/own"].dims) == {"model", "level", "time", "surface"}
    judged = run.judge(answers)
    (found,) = judged.findings
    assert (found.claim.id, found.verdict) == ("history.force", "fails")
    assert found.value == pytest.approx(0.1, rel=1e-9)
    table = judged.page("", answers).opening[0].frame.set_index("")
    greatest = table.loc["force [N]", ["1D (MDR)", "3D (BEM)"]]
    assert greatest.tolist() == ["4.4", "4"]  # at the end


def test_a_shear_is_compared_over_the_displacement():
    case = replace(CASE, motion=Shear(load=1.0, displacement=2e-6), interface=Coulomb(0.5), roughness=None)
    run = asked.run({"a case": case})

    def drawn(task):
        (scene,) = task.scenes
        force = 1e4 * scene.motion.displacement * (1.2 if task.solver.name == "MDR" else 1.0)
        return Outcome((Row(1.0, 1e-4, force, 0.0, 1.0, 1.0),))

    answers = run.answers({each: drawn(each) for each in contacts_of(run.grids())})
    assert dict(answers["a-case/own"].sizes)["displacement"] == 10
    found = {each.claim.id: each for each in run.judge(answers).findings}
    assert found["history.friction"].value == pytest.approx(0.2, rel=1e-9)
    assert found["history.depth"].verdict == "holds"


@pytest.mark.parametrize(
    ("stated", "roughness", "interval"),
    [
        ({}, ROUGH, 0.05),
        ({"surfaces": 2}, ROUGH, None),
        ({"profiles": 2}, ROUGH, None),
        ({"interval": "2%"}, ROUGH, 0.02),
        ({}, None, None),
    ],
    ids=["nothing stated", "surfaces", "profiles", "interval", "smooth"],
)
def test_an_interval_is_wanted_where_numbers_of_surfaces_are_not_stated(stated, roughness, interval):
    case = replace(CASE, study=Variations(**stated), roughness=roughness)
    assert Around("a case", case).interval == interval


def test_the_scene_as_it_stands_is_solved_and_answered_before_the_curves_around_it():
    run = asked.run({"a case": CASE})
    first = run.first
    assert set(first.grids()) == {"a-case/own"}
    assert {*first.batches()[0].tasks} < {*run.batches()[0].tasks}
    answers = first.answers(invented_of(first))
    whole = first.more(answers, first.judge(answers).findings)
    assert set(whole.grids()) == set(run.grids())
    assert whole.reason.startswith("a case: friction, 1D (MDR) 0.252, 3D (BEM) 0.126, 1D/3D 2, advice multiply 1D")
    assert first.rest.first.rest.grids() == whole.grids()
    smooth = asked.run({"a case": replace(CASE, motion=Program(stages=(Stage(duration=1.0, depth=1e-5),)))})
    assert smooth.first.rest is None  # it has no curves


def test_friction_by_the_law_is_drawn_against_the_shortest_wave_where_it_slides():
    drawn = {each.name: each for each in solved()[2].plots}["a-case/friction-waves"]
    law, points = drawn.tables.values()
    assert (np.diff(law["rms_slope"]) < 0).all()  # from fine waves to coarse ones
    assert (law["friction_low"] <= law["friction"]).all()
    assert (law["friction"] <= law["friction_high"]).all()
    assert law["shortest"].iloc[0] < CASE.roughness.shortest == points["shortest"].unique().item()
    own = compare.FrictionLaw().solve(CASE.scene).friction_coefficient
    between = np.interp(CASE.roughness.shortest, law["shortest"], law["friction"])
    assert between == pytest.approx(own, rel=0.1)
    _, _, rest = solved(replace(CASE, motion=Indent(load=1.0)))
    assert not [each.name for each in rest.plots if "waves" in each.name]


SHARED = ("A", "a"), ("é", "e\u0301"), ("日本", "東京"), ("a b", "a-b")


@pytest.mark.parametrize("names", [*SHARED, (SOLVED,), (FIGURES,), ("tables",)], ids=lambda names: str(names)[:20])
def test_names_that_have_no_folder_of_their_own_are_refused_before_anything_is_solved(tmp_path, names):
    with pytest.raises(InvalidInput) as caught:
        compare.run(dict.fromkeys(names, CASE), output=tmp_path / "out")
    assert all(brief(str(name)) in str(caught.value) for name in names)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("place", ["../out", "/elsewhere/out", "a/../..", SOLVED, f"{SOLVED}/a"])
def test_a_study_of_ones_own_is_written_below_its_folder(tmp_path, place):
    study = type("Mine", (Study,), {"place": place})()
    with pytest.raises(InvalidInput, match=re.escape(place)):
        compare.solve(study, tmp_path / "out")
    assert not list(tmp_path.iterdir())
