"""Friction that a user measured: the table is read or refused by its line, and shifted onto one curve."""

import numpy as np
import pandas
import pytest
import xarray
import yourdata
from drawn_again import from_files
from processes import ask

import compare
from compare.figures import collapse
from compare.solving.words import found as worded
from compare.statistics.eq23 import NO_SHIFT
from compare.statistics.finding import FAILS, HOLDS, REPORTED, UNDECIDED
from compare.studies.mastercurve.measurements import MeasuredFriction
from compare.studies.mastercurve.study import NOT_REPEATED, Mastercurve
from scene.files.reading import InvalidInput


def columns(law, speeds, loads, repeats=1, noise=0.0, seed=4):
    """Friction by a law of load and speed at each pair of both, `repeats` times with scatter; by columns."""
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


NAMES = "friction_coefficient", "normal_force", "speed"
MU, LOAD, SPEED = COLUMNS = tuple(table().values())


def written(columns, separator=","):
    """A table of columns by their headings."""
    rows = zip(*(np.asarray(each).tolist() for each in columns.values()), strict=True)
    return "\n".join([separator.join(columns), *(separator.join(map(repr, row)) for row in rows)])


def study(tmp_path, columns, name="ball.csv"):
    path = tmp_path / name
    path.write_text(written(columns))
    return Mastercurve.of(path)


def found(study):
    return {each.claim.id.removeprefix("mastercurve."): each for each in study.judge(study.answers({})).findings}


@pytest.mark.parametrize("noise", [0.0, 0.01])
@pytest.mark.parametrize("vertical", [0.0, 0.05, -0.1])
def test_the_answer_holds_the_pair_of_shifts_that_was_planted(tmp_path, vertical, noise):
    made = study(tmp_path, table(vertical=vertical, noise=noise))
    named = found(made)
    pair = {"vertical-exponent": vertical, "exponent-beside-vertical": -1.5} if vertical else {"exponent": -1.5}
    for name, planted in pair.items():
        low, high = named[name].interval
        assert low - ROUNDING <= planted <= high + ROUNDING, name
    message = " ".join(made.judge(made.answers({})).answer)
    for name in pair:
        assert f"{named[name].claim.sentence}: {worded(named[name], 3)}" in message
    if vertical:
        assert (named["vertical-exponent"].verdict, named["vertical"].verdict) == (FAILS, REPORTED)
        assert "No shift along friction" not in message
        assert not named["exponent"].interval[0] <= -1.5 <= named["exponent"].interval[1]
    else:
        assert named["vertical"].verdict == HOLDS
        assert "shift along friction, beside" not in message


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
    """Three to six loads, five to `speeds` speeds over one to four decades, three times each; and their shifts."""
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


@pytest.mark.parametrize(
    ("noise", "sets", "speeds"),
    [
        (0.01, 4, 7),
        *(pytest.param(noise, 20, 20, marks=pytest.mark.slow) for noise in (0.0, 0.003)),
    ],
)
def test_exponent_and_shifts_are_in_their_intervals_whatever_the_shape_of_the_curve(noise, sets, speeds):
    """Sets of a shape; allowed: three deviations of their number from 93 %, as first-order theory has it.

    The fitted curve is a polynomial, and the curve of the data is not.
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
    named = found(study(tmp_path, table(repeats=1)))
    assert (named["horizontal"].verdict, named["horizontal"].reason) == (UNDECIDED, NOT_REPEATED)
    assert 0 < named["horizontal"].value < 0.03
    assert named["exponent"].value == pytest.approx(-1.5, abs=0.1)
    assert np.isnan(named["exponent"].interval).all()


def bent():
    """Each speed bends in its own way, and measurements hardly scatter: no shift helps."""
    return columns(
        lambda load, v: (1 + load ** (1 + np.log2(v))) ** -0.5,
        [1.0, 2.0, 4.0],
        np.geomspace(0.1, 10.0, 9),
        3,
        1e-3,
    )


def test_friction_that_does_not_collapse_has_no_exponent(tmp_path):
    made = study(tmp_path, bent())
    named = found(made)
    assert named["horizontal"].verdict == FAILS
    assert (named["exponent"].verdict, named["exponent"].reason) == (REPORTED, NO_SHIFT)
    assert np.isnan(named["exponent"].value)
    # which the fit has, and which means nothing
    assert np.isfinite(made.collapse.horizontal.exponent.value)


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
    for name, wanted in zip(NAMES, COLUMNS, strict=True):
        np.testing.assert_allclose(read.data[name], wanted, rtol=1e-14)
    for message, count in (
        ("not used", heading.lower().count("time")),
        ("negative throughout", sum(bool(np.all(each < 0)) for each in numbers)),
    ):
        assert sum(message in each for each in read.notes) == count


def test_a_table_of_another_form_is_stated_on_the_command_line(tmp_path):
    path, out = tmp_path / "other.csv", tmp_path / "out"
    _, *rows = written(table(), ";").split("\n")
    rows = "".join(f"a;{row}\n" for row in rows)
    path.write_text(f"Loads in N\nrun;Reibwert;Last;v\nwarm;0;1;1\n{rows}end\n".replace(".", ","))
    options = "--skip 1 --rows 97 --decimal , --where run=a --columns mu=Reibwert --columns F_N=Last --units F_N=N"
    asked = ["mastercurve", str(path), *options.split(), "--units", "v=m/s", "--no-report", "--output", str(out)]
    assert ask(*asked).exit_code == 0
    kept = compare.load(out)["measured"]
    for name, wanted in zip(NAMES, COLUMNS, strict=True):
        np.testing.assert_array_equal(kept[name], wanted)
    refused = ask(*asked, "--columns=mu")
    assert (refused.exit_code, "columns" in refused.output) == (2, True)


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
    assert Mastercurve.of(warm, **STATED).shifts is None
    with pytest.raises(InvalidInput, match="ask for a column of temperature"):
        Mastercurve.of(table(), **STATED)


# Five speeds, four loads, three temperatures: one curve of F_N (v a_T)^-0.6, of WLF with c1 = 8.9, c2 = 145 K.
WARMED = yourdata.FOLDER / "tribometer.csv"
STATED = {"c1": 8.86, "c2": "145 K", "reference": "20 degC"}


def test_constants_that_are_found_or_stated_are_used_and_wrong_ones_leave_no_exponent():
    sought, right, wrong = (
        Mastercurve.of(WARMED, **stated) for stated in ({}, *(STATED | {"c1": c1} for c1 in (8.9, 20.0)))
    )
    assert right.inputs["reference"] == "20 degC"
    known, named, missed = map(found, (sought, right, wrong))
    verdicts = [each["temperatures"].verdict for each in (known, named, missed)]
    assert verdicts == [HOLDS, HOLDS, FAILS]
    for each in (known, named):
        low, high = each["exponent"].interval
        assert low <= -0.6 <= high < low + 0.05
    shifts = sought.judge(None).plots[1].tables["temperature-shifts"]
    by = dict(zip(sought.shifts.temperatures, sought.shifts.shifts.value, strict=True))
    moved = np.log(shifts["reduced_speed"] / shifts["speed"])
    np.testing.assert_allclose(moved, shifts["temperature"].map(by), atol=1e-12)
    assert np.isnan(missed["exponent"].value)
    assert "temperatures together" in missed["exponent"].reason
    # Whether the curves are one does not depend on the speed that they have.
    assert missed["horizontal"].value == pytest.approx(named["horizontal"].value, abs=1e-3)


@pytest.mark.parametrize(
    ("stated", "message"),
    [
        (STATED | {"reference": "500 degC"}, "the law ends at reference - c2"),
        (STATED | {"reference": 20}, "is degC meant"),
        ({"tolerance": -0.1}, "tolerance = "),
        ({"tolerance": 0.6}, "tolerance = "),
    ],
)
def test_constants_and_tolerances_that_are_none_are_refused(stated, message):
    with pytest.raises(InvalidInput, match=message):
        Mastercurve.of(WARMED, **stated)


@pytest.mark.parametrize("columns", [table(), bent()], ids=["holds", "fails"])
def test_the_figure_is_a_function_of_its_csv_files(tmp_path, columns):
    made = study(tmp_path, columns, r"$\frac{$.csv")
    (plot,) = made.judge(made.answers({})).plots
    left, middle, *shifts, below = from_files(plot).axes
    assert left.get_title(loc="left") == r"(a) \$\frac{\$"  # a name that would be a formula
    for axes, across in ((left, "normal_force"), (middle, "shifted_force"), (below, "shifted_force")):
        curves = np.concatenate([bars[0].get_xdata().astype(float) for bars in axes.containers])
        np.testing.assert_allclose(np.sort(curves), np.sort(plot.tables[collapse.NAME][across]), rtol=1e-12)
    assert bool(shifts) == plot.tables[collapse.NAME + collapse.SHIFTS]["log_shift"].notna().all()
