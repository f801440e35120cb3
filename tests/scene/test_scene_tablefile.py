"""Tables of numbers: read as they were written, or refused with the place and the option that helps."""

import numpy as np
import pandas
import pint
import pytest
import xarray
from maps import refused

from scene.files.stated import TableFormat
from scene.files.tablefile import Column, read_columns
from scene.files.tabletext import SEPARATORS
from scene.quantities import HERTZ, KELVIN, PASCAL, RADIAN_PER_SECOND

FREQUENCY = Column("frequency", ("f",), (HERTZ, RADIAN_PER_SECOND))
STORAGE, LOSS = Column("storage", ("G'",), (PASCAL,), needed=True), Column("loss", ("G''",), (PASCAL,))
TEMPERATURE = Column("T", ("temperature",), (KELVIN,), unit_needed=True)
KNOWN = FREQUENCY, STORAGE, LOSS, TEMPERATURE, Column("tan_delta", ())
ROUNDING = 4e-16  # of a single product
HEADED = "f [Hz];G' [MPa];G'' [kPa]"
ROWS = "1;2;3", "2;3;4", "3;4;5"
LINES = [HEADED, *ROWS]
READ = {"frequency": [1, 2, 3], "storage": [2e6, 3e6, 4e6], "loss": [3e3, 4e3, 5e3]}


def written(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "table.csv"
    path.write_bytes(text.encode(encoding))
    return path


def read(path, **stated):
    return read_columns(path, KNOWN, TableFormat(**stated))


def agree(columns, expected=READ):
    assert sorted(columns) == sorted(expected)
    for name, numbers in expected.items():
        np.testing.assert_allclose(columns[name], numbers, rtol=ROUNDING)


@pytest.mark.parametrize(
    "lines",
    [
        LINES,
        [HEADED.replace(";", " , "), *(row.replace(";", ",") for row in ROWS)],
        ["f (Hz);G' (MPa);G'' (kPa)", *ROWS],
        ["f;G';G''", "[Hz];[MPa];(kPa)", *ROWS],
        ["# NR, 1.2 GPa, 0.3 GPa", "", HEADED, *ROWS, ";;", "", ";;"],
        [
            "f [Hz];G';G''",
            *(
                ";".join(f"{float(n) * s}" for n, s in zip(row.split(";"), (1, 1e6, 1e3), strict=True))
                for row in ROWS
            ),
        ],
        ["FRE_QUENCY [Hz];Sto rage [N/mm2];G′′ [kPa]", *ROWS],
        ['"f [Hz]";"G\' [MPa]";"G"" [kPa]"', *(f'"{row[0]}";{row[2:]}' for row in ROWS)],
        ["f [Hz];G' [MPa];point;remark;G'' [kPa]", "1;2;1;a;3", "2;3;2;a;4", "3;4;4;a;5"],
    ],
)
def test_the_documented_form_is_read(tmp_path, lines):
    agree(read(written(tmp_path, "\r\n".join([*lines, ""]))))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_encodings_with_a_mark_and_utf_8_are_read(tmp_path, encoding):
    agree(read(written(tmp_path, "\n".join(["# 25 °C", HEADED, *ROWS]), encoding)))


STATED = {
    "skip": (
        ["Sample A", "1;2", HEADED, *ROWS],
        {"skip": 2},
        "line 2: .* has not the 2 cells of line 1, 'Sample A': state skip",
    ),
    "rows": ([HEADED, *ROWS, "mean;3;4"], {"rows": 3}, "line 5, column 'f .Hz.': 'mean' is no number: state rows"),
    "after a blank line": (
        [HEADED, *ROWS, "", *ROWS],
        {"rows": 3},
        "line 5: '' has not the 3 cells.*state .* rows to end",
    ),
    "a short row": ([HEADED, *ROWS, "3;4"], {"rows": 3}, "line 5: '3;4' has not the 3 cells"),
    "units": (
        ["# moduli in kPa", "f;G';G''", *ROWS],
        {"units": {"frequency": "Hz", "storage": "MPa", "loss": "kPa"}},
        "no unit in the heading: state units = {storage = 'Pa'}",
    ),
    "units of some": (
        ["f [Hz];G' [MPa];G''", *ROWS],
        {"units": {"loss": "kPa"}},
        "\"G''\" has no unit in the heading: state units = {loss",
    ),
    "columns": (
        ["f [Hz];E (MPa);loss [kPa]", *ROWS],
        {"columns": {"storage": "E (MPa)"}},
        "there is no column storage .* but .*'E .MPa.'.*state its heading, as columns = {storage = ",
    ),
    "brackets without a unit": (
        ["f [Hz];G' (mean);G'' [kPa]", *ROWS],
        {"columns": {"storage": "G' (mean)"}, "units": {"storage": "MPa"}},
        "there is no column storage .* but .*'f .Hz.', \"G' .mean.\"",
    ),
    "two columns": (
        ["f [Hz];G' [MPa];storage [Pa];loss [kPa]", *(f"{row[:3]};7{row[3:]}" for row in ROWS)],
        {"columns": {"storage": "G' [MPa]"}},
        "are both storage: state one, as columns",
    ),
    "where": (
        [f"sample;{HEADED}", *(f"NR;{row}" for row in ROWS), "SBR;2;3;4"],
        {"where": {"sample": "NR"}},
        "column 'sample' has several values, 'NR' and 'SBR', and is not used: .* where = {'sample' = 'NR'}",
    ),
    "decimal": (
        [HEADED, "1,000;2,000;3,000", "2,000;3,000;4,000", "3,000;4,000;5,000"],
        {"decimal": ","},
        "'1,000' may have decimals or thousands: state decimal",
    ),
    "encoding": (
        ["# 25 °C", HEADED, *ROWS],
        {"encoding": "cp1252"},
        "line 1: .* byte 0xb0 .*state encoding",
    ),
    "no heading": (
        ["# in Hz, MPa, kPa", *ROWS],
        {
            "columns": {"frequency": 1, "storage": 2, "loss": 3},
            "units": {"frequency": "Hz", "storage": "MPa", "loss": "kPa"},
        },
        "line 2: '1;2;3' is no heading: .* state the columns by number",
    ),
    "separator": (
        [HEADED.replace(";", " ").replace(" [Hz]", ",1"), "1 2 3", "2 3 4", "3 4 5"],
        {"separator": "blanks", "columns": {"frequency": "f,1"}, "units": {"frequency": "Hz"}},
        "state skip for lines above the heading, rows to end before this one, or separator",
    ),
}


@pytest.mark.parametrize(("lines", "stated", "refusal"), STATED.values(), ids=STATED)
def test_what_differs_is_refused_with_its_place_and_read_once_it_is_stated(tmp_path, lines, stated, refusal):
    path = written(tmp_path, "\n".join(lines), stated.get("encoding", "utf-8"))
    refused(refusal, read, path, error=ValueError)
    agree(read(path, **stated))


@pytest.mark.parametrize(
    ("lines", "stated", "refusal"),
    [
        (["f [Hz];G' [MPa];G'' [kPx]", *ROWS], {}, "in 'kPx', and is a pressure"),
        (["f [s];G' [MPa];G'' [kPa]", *ROWS], {}, "in 's', and is a frequency or an angular frequency"),
        (["f [Hz];G' [MPa]", "kHz;MPa", "1;2"], {}, r"no column storage .*, but 'f \[Hz\]'"),
        (LINES, {"units": {"storage": "Pa"}}, "in 'MPa', and units states 'Pa': they must agree"),
        (LINES, {"columns": {"stoarge": "G'"}}, "'stoarge' is none of the columns: frequency, storage"),
        (LINES, {"columns": {"storage": "E'"}}, '0 columns are called "E\'"'),
        (LINES, {"where": {"f [Hz]": 7}}, "no row has {'f \\[Hz\\]': 7}"),
        (LINES, {"encoding": "latin-9000"}, "line 1: unknown encoding: latin-9000: state encoding"),
        ([HEADED + ";tan_delta [%]", *(row + ";1" for row in ROWS)], {}, "in '%', and is a number without a unit"),
        (["T;G'", "20;1"], {}, "column 'T' has no unit in the heading: state units = {T = 'K'}"),
        ([HEADED, "1;2;", *ROWS], {}, "line 2, column \"G'' .kPa.\": '' is no number"),
        ([HEADED, "1;2;1e999", *ROWS], {}, "line 2, column \"G'' .kPa.\": '1e999' is no number"),
        ([HEADED, "1;2;1,000,000", *ROWS], {}, "line 2, column \"G'' .kPa.\": '1,000,000' is no number"),
        ([HEADED, "0.5;1,5;2"], {}, "'1,5' may have .*: state decimal"),
        ([HEADED, "0,5;1.5;2"], {"decimal": ","}, "line 2, column \"G' .MPa.\": '1.5' is no number"),
        (["G';remark", '1;a";"', '2;b";"'], {}, "line 2: .* has not the 2 cells of line 1"),
        ([HEADED], {}, "no row below line 1"),
        (["# nothing"], {}, "no row in it"),
        (["1.234,5,2.345,6"], {"columns": {"storage": 1}}, "commas may stand between .*state decimal"),
    ],
)
def test_what_is_no_table_is_refused_with_what_stands_there(tmp_path, lines, stated, refusal):
    refused(refusal, read, written(tmp_path, "\n".join(lines)), error=ValueError, **stated)


@pytest.mark.parametrize(
    "stated",
    [{"skip": -1}, {"rows": "3"}, {"separator": "|"}, {"decimal": "'"}, {"columns": {"z": 0}}, {"sep": ";"}],
)
def test_what_is_stated_is_checked(stated):
    refused(next(iter(stated)), TableFormat, error=ValueError, **stated)


def test_a_single_letter_has_its_case_and_a_frequency_per_second_stays_open(tmp_path):
    known = Column("T", (), (KELVIN,)), Column("time", ("t",)), FREQUENCY
    columns = read_columns(written(tmp_path, "t,T [degC],f [1/s]\n1,20,5\n2,30,6\n"), known)
    agree(columns, {"time": [1, 2], "T": [293.15, 303.15], "frequency": [5, 6]})
    assert [columns.units[name] for name in columns] == [KELVIN, None, None]


def test_gaps_are_read_where_a_column_may_have_them(tmp_path):
    heights = read_columns(written(tmp_path, "z\n1\nnan\n"), [Column("z", (), gaps=True)])["z"]
    np.testing.assert_array_equal(heights, [1, np.nan])


def test_tables_of_python_are_read_by_the_same_names_with_their_units():
    units = pint.UnitRegistry()
    plain = {name: np.array(values, float) for name, values in READ.items()}
    hertz, kilo = units.Quantity(plain["frequency"], "Hz"), units.Quantity(plain["loss"] / 1e3, "kPa")
    labelled = {"f": ("row", plain["frequency"], {"units": "Hz"}), "G'": ("row", [2, 3, 4], {"units": "MPa"})}
    frame = pandas.DataFrame({"f [Hz]": [1, 2, 3], "G' [MPa]": [2, 3, 4], "G'' [kPa]": [3, 4, 5], "remark": "a"})
    agree(read(plain))
    agree(read(frame))
    agree(read({"f": hertz, "G'": units.Quantity(np.array([2, 3, 4]), "MPa"), "G''": kilo}))
    agree(read(xarray.Dataset(labelled | {"G''": ("row", plain["loss"], {"units": "Pa"})})))
    both = pandas.concat([frame, frame.assign(remark="b")])
    agree(read(both, where={"remark": "b"}))
    for wrong, message in (
        (3.0, "3.0: a path, a DataFrame"),
        ({}, "there is no row"),
        (pandas.Series([1.0, 2.0]), "a path, a DataFrame"),
        ({"G'": [None, 1.0]}, "row 1, column .*None. is no number"),
        ({"G'": [1.0], "f": [1.0, 2.0]}, "same length"),
        ({"G'": [1.0, np.nan]}, 'row 2, column "G\'": nan is no number'),
        (both, "column 'remark' has several values"),
    ):
        refused(message, read, wrong, error=ValueError)


# Tables as somebody may write them: names and units of the fields, and columns besides.
HEADINGS = (
    {"frequency": "f", "storage": "G'", "loss": "G''"},
    {"loss": 'G"', "frequency": "Frequency", "storage": "storage"},
)
UNITS = ("Hz", "MPa", "kPa"), ("kHz", "kPa", "Pa"), ("Hz", "Pa", "Pa")
SCALES = {"Hz": 1.0, "kHz": 1e3, "Pa": 1.0, "kPa": 1e3, "MPa": 1e6}
ABOVE = "# NR, 1.2 MPa, 0.3 MPa", "# all moduli in GPa", "# 25 °C", "Sample A", "T = 25 °C", "Run;7;8", "1 2 3"
OTHERS = (
    ("point", range(1, 9)),
    ("tan_delta", [0.5] * 8),
    ("remark", ["ok"] * 8),
    ("sample", ["A", "B", "A", "A"] * 2),
)
SPOILT = ["", "x", "nan", "1.2.3", "1 2", "1,234,567", "--"]


def drawn(seed):
    """Text of a table, the numbers that are meant, what has to be stated, and whether a cell or row is spoilt."""
    rng = np.random.default_rng(seed)
    often = lambda share: rng.random() < share  # noqa: E731
    pick = lambda *given: given[rng.integers(len(given))]  # noqa: E731
    named, units = pick(*HEADINGS), dict(zip(HEADINGS[0], pick(*UNITS), strict=True))
    separator = pick(*SEPARATORS)
    stated = {"separator": separator, "decimal": pick(".", ",") if separator in ("tab", "semicolon") else "."}
    place, mark = pick("heading", "below", "comment", "sentence", "no heading"), SEPARATORS[separator]
    count = pick(3, 5, 7)
    numbers = {name: [f"{each:.5g}" for each in 10 ** rng.uniform(-2, 6, count)] for name in named}
    meant = {name: np.array(each, float) * SCALES[units[name]] for name, each in numbers.items()}
    more = dict([pick(*OTHERS)]) if often(0.6) else {}
    columns = [*numbers.values(), *([str(each) for each in cells][:count] for cells in more.values())]
    spoken = ", ".join(f"{name} in {unit}" for name, unit in units.items())
    above = {"comment": [f"# {spoken}"], "sentence": [spoken]}.get(place, []) + [pick(*ABOVE)] * often(0.3)
    names = [f"{name} [{units[field]}]" if place == "heading" else name for field, name in named.items()]
    heading = [[*names, *more]] + [[*(units[name] for name in named), *("" for _ in more)]] * (place == "below")
    if "sample" in more:
        stated["where"] = {"4" if place == "no heading" else "sample": "A"}
        meant = {name: each[np.array(columns[3]) == "A"] for name, each in meant.items()}
    elif more and place == "no heading":
        stated["where"] = {"4": "*"}
    if place == "no heading":
        heading, stated["columns"] = [], {name: k + 1 for k, name in enumerate(named)}
    if place not in ("heading", "below"):
        stated["units"] = units
    if above:
        stated["skip"] = len(above)
    rows = [[cell.replace(".", stated["decimal"]) for cell in row] for row in zip(*columns, strict=True)]
    if spoilt := often(0.1):
        rows[0][rng.integers(3)] = pick(*SPOILT)
    elif spoilt := often(0.1):
        rows[rng.integers(count)].pop()
    lines = [mark.join(each or "-" if mark == " " else each for each in row) for row in [*heading, *rows]]
    if often(0.2):
        stated["rows"] = count
        row = mark.join("7" * len(columns))
        lines += pick(["", row], ["Sample B", row], ["# Sample B, Pa", row], [row + mark + "7"], ["mean"])
    return "\n".join([*above, *lines]), meant, stated, spoilt


@pytest.mark.parametrize(
    ("first", "count"), [(0, 150), pytest.param(150, 5000, marks=pytest.mark.slow)], ids=["some", "many"]
)
def test_no_table_is_read_as_other_numbers_than_were_meant(tmp_path, first, count):
    """A table is read as it is meant, or refused by its name; and read once what differs is stated."""
    unstated = 0
    for seed in range(first, first + count):
        text, meant, stated, spoilt = drawn(seed)
        path, refusals = written(tmp_path, text), []
        for options in ({}, stated):
            try:
                found = read(path, **options)
            except ValueError as error:
                refusals.append(str(error))
                continue
            unstated += not options
            for name, numbers in meant.items():
                assert not spoilt, text
                np.testing.assert_allclose(found[name], numbers, rtol=1e-12, err_msg=f"{options}\n{text}")
        assert all("table.csv" in each for each in refusals), refusals
        assert spoilt or len(refusals) < 2, f"{refusals}\n{text}"
    assert unstated > 0.1 * count
