"""Friction that a user measured: the table is read or refused by its line, and shifted onto one curve."""

import os
import sys

import numpy as np
import pandas
import pytest
import xarray
import yourdata
from drawn_again import from_files
from typer.testing import CliRunner

import compare
from compare.cli.app import app
from compare.figures import collapse
from compare.library.ready import ready
from compare.solving.words import found as worded
from compare.statistics.eq23 import NO_SHIFT
from compare.statistics.finding import FAILS, HOLDS, REPORTED, UNDECIDED
from compare.studies.comparison import asked
from compare.studies.mastercurve.measurements import MeasuredFriction
from compare.studies.mastercurve.study import NOT_REPEATED, Mastercurve
from scene.files.reading import InvalidInput


def columns(law, speeds, loads, repeats=1, noise=0.0, seed=4):
    """Friction by a law of load and speed at every one of both, each so many times with scatter; by columns."""
    v, load, _ = (each.ravel() for each in np.meshgrid(speeds, loads, range(repeats), indexing="ij"))
    scatter = 1 + noise * np.random.default_rng(seed).normal(size=v.size)
    return {"mu": law(load, v) * scatter, "F_N": load, "v": v}


def knee(load, speed):
    """One curve shifted by v^-1.5 along the load."""
    return (1 + 3e-4 * load * speed**-1.5) ** -0.6


def table(repeats=3, seed=4, vertical=0.0, noise=0.01):
    """Friction on one curve shifted along friction too, with 1 % of scatter."""
    speeds, loads = np.geomspace(3e-3, 2e-2, 4), np.geomspace(1.0, 100.0, 8)
    return columns(lambda load, v: knee(load, v) * v**-vertical, speeds, loads, repeats, noise, seed)


MU, LOAD, SPEED = COLUMNS = tuple(table().values())


def written(columns, separator=","):
    """A table of columns by their headings."""
    rows = zip(*(np.asarray(each).tolist() for each in columns.values()), strict=True)
    return "\n".join([separator.join(columns), *(separator.join(map(repr, row)) for row in rows)])


def study(tmp_path, columns, name="ball.csv"):
    (tmp_path / name).write_text(written(columns))
    return Mastercurve.of(tmp_path / name)


def found(study):
    return {each.claim.id.removeprefix("mastercurve."): each for each in study.judge(study.answers({})).findings}


@pytest.mark.skipif(sys.platform != "linux", reason="names of files are texts elsewhere")
def test_a_file_whose_name_is_no_text_is_named_by_letters_that_stand_for_it(tmp_path):
    name = os.fsdecode(b"ball\xff")
    np.save(tmp_path / f"{name}.npy", np.random.default_rng(1).normal(size=(16, 16)))
    study(tmp_path, table(), f"{name}.csv")
    (tmp_path / f"{name}.toml").write_text(ready()["hertz"].text, encoding="utf-8")
    for left in (
        compare.mastercurve(tmp_path / f"{name}.csv", output=tmp_path / name, report=False),
        compare.topography(tmp_path / f"{name}.npy", 1e-6, unit="um", output=tmp_path / name, report=False),
    ):
        assert r"ball\udcff" in str(left)
        assert r"ball\udcff" in left.study.title
    assert [each.name for each in asked.run(tmp_path / f"{name}.toml").series] == [r"ball\udcff"]


@pytest.mark.parametrize("noise", [0.0, 0.003, 0.01])
@pytest.mark.parametrize("vertical", [0.0, 0.05, 0.1, -0.1])
def test_the_answer_holds_the_pair_of_shifts_that_was_planted(tmp_path, vertical, noise):
    made = study(tmp_path, table(vertical=vertical, noise=noise))
    told = found(made)
    pair = {"vertical-exponent": vertical, "exponent-beside-vertical": -1.5} if vertical else {"exponent": -1.5}
    for name, planted in pair.items():
        low, high = told[name].interval
        assert low - ROUNDING <= planted <= high + ROUNDING, name
    said = " ".join(made.judge(made.answers({})).answer)
    for name in pair:
        assert f"{told[name].claim.sentence}: {worded(told[name], 3)}" in said
    if vertical:
        assert (told["vertical-exponent"].verdict, told["vertical"].verdict) == (FAILS, REPORTED)
        assert "No shift along friction" not in said
        assert not told["exponent"].interval[0] <= -1.5 <= told["exponent"].interval[1]
    else:
        assert told["vertical"].verdict == HOLDS
        assert "shift along friction, beside" not in said


# Curves of friction, which are one of the load times a power of the speed.
SHAPES = {
    "knee": lambda x: np.log(0.8) - 2 / 3 * np.log1p(np.exp(x)),
    "maximum": lambda x: np.log(0.5) - np.log(np.exp(0.35 * x) + np.exp(-0.25 * x)),
    "nearly a power": lambda x: np.log(0.5) - 0.3 * x - 0.01 * x**2,
}
PLANTED = -0.6
ROUNDING = 1e-9
FOLLOWED = 2e-3  # misfit that the freest polynomial leaves of such curves


def planted(shape, noise, seed, speeds):
    """Three to six loads, five speeds to so many, over one to four decades, three times each; and their shifts."""
    rng = np.random.default_rng(seed)
    count = rng.integers(3, 7)
    loads = rng.uniform(2, 6) ** np.arange(count)
    v = np.geomspace(1, 10 ** rng.uniform(1, 4), rng.integers(5, speeds + 1))
    along, off = PLANTED * np.log(v), rng.uniform(-1.5, 1.5)

    def law(load, speed):
        x = np.log(load * speed**PLANTED)
        return np.exp(SHAPES[shape](x - x.mean() + off))

    return Mastercurve.of(columns(law, v, loads, 3, noise, seed), tolerance=0), along - along[v.size // 2]


def holds(number, truth, rounding=ROUNDING):
    low, high = number.interval()
    return (low - rounding <= truth) & (truth <= high + rounding)


@pytest.mark.parametrize("noise", [0.0, 0.001, 0.003, 0.01])
@pytest.mark.parametrize(
    ("sets", "speeds"), [(4, 7), pytest.param(20, 20, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_exponent_and_shifts_are_in_their_intervals_whatever_the_shape_of_the_curve(noise, sets, speeds):
    """Of so many sets of a shape; allowed: three deviations of as many beside 93 %, as first-order theory has it.

    The curve that is fitted is a polynomial, and that of the data is none.
    """
    exponents, shifts, misfits = [], [], []
    for shape in SHAPES:
        for seed in range(sets):
            made, along = planted(shape, noise, seed, speeds)
            fit = made.collapse.horizontal
            exponents.append(holds(fit.exponent, PLANTED))
            shifts.append(np.mean(holds(fit.horizontal, along)))
            misfits.append(fit.misfit.interval()[0] < FOLLOWED)
    least = 0.93 - 3 * np.sqrt(0.93 * 0.07 / len(exponents))
    assert min(map(np.mean, (exponents, shifts, misfits))) >= least, (exponents, shifts, misfits)


def test_one_scatter_stands_behind_all_points():
    kept = (np.arange(MU.size) % 3 == 0) | (np.arange(MU.size) > 40)
    data = Mastercurve.of({name: each[kept] for name, each in table().items()}).collapse.data
    errors = np.concatenate([curve.error for curve in data.curves])
    assert errors.max() / errors.min() == pytest.approx(np.sqrt(3), rel=1e-12)
    assert errors.min() == pytest.approx(0.01 / np.sqrt(3), rel=0.3)
    assert data.dof == kept.sum() - errors.size


def test_single_measurements_leave_the_verdict_open(tmp_path):
    told = found(study(tmp_path, table(repeats=1)))
    assert (told["horizontal"].verdict, told["horizontal"].reason) == (UNDECIDED, NOT_REPEATED)
    assert 0 < told["horizontal"].value < 0.03
    assert told["exponent"].value == pytest.approx(-1.5, abs=0.1)
    assert np.isnan(told["exponent"].interval).all()


def bent():
    """Each speed bends in its own way, and measurements hardly scatter: no shift helps."""
    power = {1.0: 1.0, 2.0: 2.0, 4.0: 3.0}

    def law(load, v):
        return (1 + load ** np.vectorize(power.get)(v)) ** -0.5

    return columns(law, [*power], np.geomspace(0.1, 10.0, 9), 3, 1e-3)


def test_friction_that_does_not_collapse_has_no_exponent(tmp_path):
    made = study(tmp_path, bent())
    told = found(made)
    assert told["horizontal"].verdict == FAILS
    assert (told["exponent"].verdict, told["exponent"].reason) == (REPORTED, NO_SHIFT)
    assert np.isnan(told["exponent"].value)
    # which the fit has, and which means nothing
    assert np.isfinite(made.collapse.horizontal.exponent.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("\x1b[31m,F,v\n1,2,3\n", r"there is no column F_N .*, but '\\x1b\[31m', 'F', 'v': state its heading"),
        ("mu,F_N,v\n1,2,3\n1,,3\n", "line 3, column 'F_N': '' is no number"),
    ],
)
def test_a_table_that_says_too_little_is_refused_with_its_line_and_leaves_no_folder(tmp_path, text, said):
    path = tmp_path / "ball.csv"
    path.write_text(text)
    with pytest.raises(InvalidInput, match=said) as refused:
        compare.mastercurve(path, tmp_path / "out")
    assert str(path) in str(refused.value)
    assert not (tmp_path / "out").exists()
    with pytest.raises(InvalidInput, match="no such file"):
        compare.mastercurve(tmp_path / "none.csv", tmp_path / "out")


def jittered(seed=1, jitter=0.003):
    """The table, with loads and speeds that scatter as those of devices do, friction following them."""
    by = np.exp(jitter * np.random.default_rng(seed).normal(size=(2, MU.size)))
    follows = knee(LOAD * by[0], SPEED * by[1]) / knee(LOAD, SPEED)
    return {"mu": MU * follows, "F_N": LOAD * by[0], "v": SPEED * by[1]}


def test_loads_and_speeds_that_scatter_give_the_exponent_of_nominal_ones():
    scattering = Mastercurve.of(jittered())
    nominal, told = found(Mastercurve.of(table()))["exponent"], found(scattering)
    assert len(scattering.pooled.points) == 32
    assert told["horizontal"].verdict == HOLDS
    numbers = (np.array([each.value, *each.interval]) for each in (told["exponent"], nominal))
    assert np.all(np.abs(np.subtract(*numbers)) <= (0.003, 0.006, 0.006))
    with pytest.raises(InvalidInput, match=r"has 1 load|speeds: 2 to 100"):
        Mastercurve.of(jittered(), tolerance=0)
    assert "Loads within 5 % of one another are one" in scattering.setting[0].text


ALIKE = {
    "Time [s],Friction force [mN],Velocity [mm/s],Load [N]": (np.arange(96.0), 1e3 * MU * LOAD, 1e3 * SPEED, LOAD),
    "F_N (mN),Tangential force (mN),Sliding velocity (mm/s)": (1e3 * LOAD, 1e3 * MU * LOAD, 1e3 * SPEED),
    "time [s],F_T [N],F_N [N],v [mm/s]": (np.arange(96.0), -MU * LOAD, -LOAD, 1e3 * SPEED),
    "CoF,normal_load,v": (MU, LOAD, SPEED),
}


@pytest.mark.parametrize("heading", ALIKE)
def test_names_order_units_and_the_friction_force_change_no_digit(heading):
    numbers = ALIKE[heading]
    read = MeasuredFriction.of(dict(zip(heading.split(","), numbers, strict=True)))
    for name, wanted in zip(("friction_coefficient", "normal_force", "speed"), COLUMNS, strict=True):
        np.testing.assert_allclose(read.data[name], wanted, rtol=1e-14)
    for said, count in (
        ("not used", heading.lower().count("time")),
        ("negative throughout", sum(bool(np.all(each < 0)) for each in numbers)),
    ):
        assert sum(said in each for each in read.notes) == count


def test_a_table_of_another_form_is_stated_on_the_command_line(tmp_path):
    path, out = tmp_path / "other.csv", tmp_path / "out"
    rows = "\n".join(f"a;{mu!r};{load!r};{v!r}" for mu, load, v in np.column_stack(COLUMNS).tolist())
    path.write_text(f"Loads in N\nrun;Reibwert;Last;v\nwarm;0;1;1\n{rows}\nend\n".replace(".", ","))
    options = "--skip 1 --rows 97 --decimal , --where run=a --columns mu=Reibwert --columns F_N=Last --units F_N=N"
    asked = ["mastercurve", str(path), *options.split(), "--units", "v=m/s", "--no-report", "--output", str(out)]
    assert CliRunner().invoke(app, asked).exit_code == 0
    kept = compare.load(out)["measured"]
    for name, wanted in zip(("friction_coefficient", "normal_force", "speed"), COLUMNS, strict=True):
        np.testing.assert_array_equal(kept[name], wanted)
    for wrong in ("--columns=mu", "--separator=dot", "--rows=-1"):
        refused = CliRunner().invoke(app, [*asked, wrong])
        assert (refused.exit_code, wrong[2:6] in refused.output) == (2, True)


def test_tables_of_python_give_the_numbers_of_the_file(tmp_path):
    plain = study(tmp_path, table())
    frame = pandas.DataFrame({"v [mm/s]": 1e3 * SPEED, "COF": MU, "load [N]": LOAD, "remark": ["a"] * len(MU)})
    read = Mastercurve.of(frame)
    xarray.testing.assert_allclose(read.data, plain.data, rtol=1e-13)
    assert read.inputs["table"] == "a DataFrame from Python, 96 rows"
    with pytest.raises(InvalidInput, match="row 3: v = 0 must be greater than 0"):
        Mastercurve.of(table() | {"v": SPEED * (np.arange(96) != 2)})


def test_a_friction_force_beside_the_coefficient_is_said_to_agree():
    both = {"mu": MU.round(3), "F_T [N]": MU * LOAD, "F_N [N]": LOAD, "v [m/s]": SPEED}
    (note,) = MeasuredFriction.of(both).notes
    assert "mu is used; F_T / F_N agrees with it within" in note


def test_one_temperature_is_told_and_changes_nothing():
    # The thermometer scatters too.
    warm = {"mu": MU, "F_N": LOAD, "v": SPEED, "T [degC]": 25 + 0.4 * np.sin(np.arange(96))}
    read, plain = Mastercurve.of(warm), Mastercurve.of(table())
    first, second = ({name: worded(each, 6) for name, each in found(made).items()} for made in (read, plain))
    assert first == second
    assert "one temperature, 298.2 K" in read.notes[0]
    constants = {"c1": 8.86, "c2": "101.6 K", "reference": "20 degC"}
    assert Mastercurve.of(warm, **constants).shifts is None
    with pytest.raises(InvalidInput, match="ask for a column of temperature"):
        Mastercurve.of(table(), **constants)


# Five speeds, four loads, three temperatures: one curve of F_N (v a_T)^-0.6, of WLF with c1 = 8.9, c2 = 145 K.
WARMED = yourdata.FOLDER / "tribometer.csv"


def test_several_temperatures_are_shifted_along_the_speed_and_judged():
    made = Mastercurve.of(WARMED)
    judged = made.judge(None)
    told = {each.claim.id.removeprefix("mastercurve."): each for each in judged.findings}
    assert (told["temperatures"].verdict, told["horizontal"].verdict) == (HOLDS, HOLDS)
    low, high = told["exponent"].interval
    assert low <= -0.6 <= high
    assert high - low < 0.05
    assert told["temperatures-unshifted"].value > 0.2
    assert judged.answer[0].startswith("Holds: Shifts along the load")
    assert "Shifts along the speed bring the temperatures together" in " ".join(judged.answer)
    shifts = judged.plots[1].tables["temperature-shifts"]
    by = dict(zip(made.shifts.temperatures, made.shifts.shifts.value, strict=True))
    moved = np.log(shifts["reduced_speed"] / shifts["speed"])
    np.testing.assert_allclose(moved, shifts["temperature"].map(by), atol=1e-12)


def test_stated_constants_are_used_and_wrong_ones_leave_no_exponent():
    right, wrong = (Mastercurve.of(WARMED, c1=c1, c2="145 K", reference="20 degC") for c1 in (8.9, 20.0))
    assert right.inputs["reference"] == "20 degC"
    told, missed = found(right), found(wrong)
    assert (told["temperatures"].verdict, missed["temperatures"].verdict) == (HOLDS, FAILS)
    low, high = told["exponent"].interval
    assert low <= -0.6 <= high
    assert np.isnan(missed["exponent"].value)
    assert "temperatures together" in missed["exponent"].reason
    # Whether the curves are one does not depend on the speed that they have.
    assert missed["horizontal"].value == pytest.approx(told["horizontal"].value, abs=1e-3)


@pytest.mark.parametrize(
    ("stated", "said"),
    [
        ({"c1": 8.86, "c2": 101.6, "reference": "500 degC"}, "the law ends at reference - c2"),
        ({"c1": 8.86, "c2": 101.6, "reference": 20}, "is degC meant"),
        ({"tolerance": -0.1}, "tolerance = "),
        ({"tolerance": 0.6}, "tolerance = "),
    ],
)
def test_constants_and_tolerances_that_are_none_are_refused(stated, said):
    with pytest.raises(InvalidInput, match=said):
        Mastercurve.of(WARMED, **stated)


@pytest.mark.parametrize("text", [table(), bent()], ids=["holds", "fails"])
def test_the_figure_is_a_function_of_its_csv_files(tmp_path, text):
    made = study(tmp_path, text, r"$\frac{$.csv")
    (plot,) = made.judge(made.answers({})).plots
    left, middle, *shifts, below = from_files(plot).axes
    points = plot.tables[collapse.NAME]
    assert left.get_title(loc="left") == r"(a) \$\frac{\$"  # a name that would be a formula
    for axes, across in ((left, "normal_force"), (middle, "shifted_force"), (below, "shifted_force")):
        curves = [bars[0].get_xdata().astype(float) for bars in axes.containers]
        assert len(curves) == len(made.collapse.speeds)
        np.testing.assert_allclose(np.sort(np.concatenate(curves)), np.sort(points[across]), rtol=1e-12)
    assert bool(shifts) == plot.tables[collapse.NAME + collapse.SHIFTS]["log_shift"].notna().all()
    assert len(plot.caption.split()) <= 60
