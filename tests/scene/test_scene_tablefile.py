"""Tables of numbers: read as they were written, or refused with the place and the option that helps."""

import numpy as np
import pandas
import pint
import pytest
import xarray

from scene.quantities import HERTZ, KELVIN, PASCAL, RADIAN_PER_SECOND
from scene.tablefile import Column, TableFormat, read_columns

FREQUENCY = Column("frequency", ("f",), (HERTZ, RADIAN_PER_SECOND))
STORAGE, LOSS = Column("storage", ("G'",), (PASCAL,), needed=True), Column("loss", ("G''",), (PASCAL,))
TEMPERATURE = Column("T", ("temperature",), (KELVIN,), unit_needed=True)
KNOWN = FREQUENCY, STORAGE, LOSS, TEMPERATURE, Column("tan_delta", ())
ROUNDING = 4e-16  # of one product
HEADED = "f [Hz];G' [MPa];G'' [kPa]"
ROWS = "1;2;3", "2;3;4", "3;4;5"
READ = {"frequency": [1, 2, 3], "storage": [2e6, 3e6, 4e6], "loss": [3e3, 4e3, 5e3]}


def written(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "table.csv"
    path.write_bytes(text.encode(encoding))
    return path


def read(path, **stated):
    return read_columns(path, KNOWN, TableFormat(**stated))


def agree(columns, expected=READ):
    assert sorted(columns.values) == sorted(expected)
    for name, numbers in expected.items():
        np.testing.assert_allclose(columns[name], numbers, rtol=ROUNDING)


@pytest.mark.parametrize(
    "lines",
    [
        [HEADED, *ROWS],
        [HEADED.replace(";", "\t"), *(row.replace(";", "\t") for row in ROWS)],
        [HEADED.replace(";", " , "), *(row.replace(";", ",") for row in ROWS)],
        [HEADED.replace(";", "   "), *(f"  {row.replace(';', ' ')}" for row in ROWS)],
        ["f (Hz);G' (MPa);G'' (kPa)", *ROWS],
        ["f;G';G''", "Hz;MPa;kPa", *ROWS],
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
        ["f [Hz];G' [MPa];G'' [kPa]", "1,0;2,00;3", "2;3,0;4", "3;4;5,0"],
    ],
    ids=range(13),
)
def test_the_documented_form_is_read(tmp_path, lines):
    agree(read(written(tmp_path, "\r\n".join([*lines, ""]))))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_encodings_with_a_mark_and_utf_8_are_read(tmp_path, encoding):
    agree(read(written(tmp_path, "\n".join(["# 25 °C", HEADED, *ROWS]), encoding)))


STATED = {
    "encoding": (["# 25 °C", HEADED, *ROWS], {"encoding": "cp1252"}, "line 1: byte 0xb0 is not utf-8"),
    "skip": (
        ["Sample A", "1;2", HEADED, *ROWS],
        {"skip": 2},
        "line 3: .* has 4 cells, and line 1, 'Sample A', has 2: state skip",
    ),
    "rows": ([HEADED, *ROWS, "mean;3;4"], {"rows": 3}, "line 5, column 'f': 'mean' is no number: state rows"),
    "a second block": (
        ["A", HEADED, *ROWS, "B", HEADED, *ROWS],
        {"skip": 1, "rows": 3},
        "line 2: .* line 7 is another heading: state rows",
    ),
    "after a blank line": ([HEADED, *ROWS, "", *ROWS], {"rows": 3}, "line 5 is blank.*state rows = 3"),
    "a short row": ([HEADED, *ROWS, "3;4"], {"rows": 3}, "line 5: '3;4' has 2 cells.* has 3"),
    "a long row": ([HEADED, *ROWS, "3;4;5;6"], {"rows": 3}, "line 5: '3;4;5;6' has 4 cells.* has 3"),
    "a quotation mark": ([HEADED, *ROWS, '3;"4;5'], {"rows": 3}, "line 5: .*quotation mark"),
    "units": (
        ["# moduli in kPa", "f;G';G''", *ROWS],
        {"units": {"frequency": "Hz", "storage": "MPa", "loss": "kPa"}},
        'no unit in the heading: state units = {storage = "Pa"}',
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
    "two columns": (
        ["f [Hz];G' [MPa];storage [Pa];loss [kPa]", *(f"{row[:3]};7{row[3:]}" for row in ROWS)],
        {"columns": {"storage": "G' [MPa]"}},
        "are both storage: state one, as columns",
    ),
    "numbers of columns": (
        ROWS,
        {
            "columns": {"frequency": 1, "storage": 2, "loss": 3},
            "units": {"frequency": "Hz", "storage": "MPa", "loss": "kPa"},
        },
        "line 1: '1;2;3' is no heading: write one, state skip, or state the columns by number",
    ),
    "where": (
        [f"sample;{HEADED}", *(f"NR;{row}" for row in ROWS), "SBR;2;3;4"],
        {"where": {"sample": "NR"}},
        'column \'sample\' has several values, "NR" and "SBR", and is not used: .* where = {sample = "NR"}',
    ),
    "where of numbers": (
        [f"{HEADED};batch no", *(f"{row};1" for row in ROWS), "2;3;4;2.0"],
        {"where": {"batch no": 1}},
        'where = {"batch no" = "1"}',
    ),
    "where of all": (
        [f"{HEADED};state", *(f"{row};{state}" for row, state in zip(ROWS, "abc", strict=True))],
        {"where": {"state": "*"}},
        "column 'state' has several values",
    ),
    "decimal": (
        [HEADED, "1,000;2,000;3,000", "2,000;3,000;4,000", "3,000;4,000;5,000"],
        {"decimal": ","},
        "'1,000' may have decimals or thousands behind its comma: state decimal",
    ),
    "separator": (
        [HEADED.replace(";", " ").replace("Hz", ","), "1 2 3", "2 3 4", "3 4 5"],
        {"separator": "blanks", "columns": {"frequency": "f [,]"}, "units": {"frequency": "Hz"}},
        "state skip for lines above the heading, rows for those below the table, or separator",
    ),
}


@pytest.mark.parametrize(("lines", "stated", "refusal"), STATED.values(), ids=STATED)
def test_what_differs_is_refused_with_its_place_and_read_once_it_is_stated(tmp_path, lines, stated, refusal):
    path = written(tmp_path, "\n".join(lines), stated.get("encoding", "utf-8"))
    with pytest.raises(ValueError, match=refusal):
        read(path)
    agree(read(path, **stated))


@pytest.mark.parametrize(
    ("lines", "stated", "refusal"),
    [
        (["f [Hz];G' [MPa];G'' [kPx]", *ROWS], {}, "in 'kPx', and is a pressure .*kPx"),
        (["f [s];G' [MPa];G'' [kPa]", *ROWS], {}, "in 's', and is a frequency or an angular frequency"),
        (["f [Hz];G' [MPa]", "kHz;MPa", "1;2"], {}, r"'f \[Hz\]' and 'kHz' are two units of one column"),
        ([HEADED, *ROWS], {"units": {"storage": "Pa"}}, "in 'MPa', and units states 'Pa': they must agree"),
        ([HEADED, *ROWS], {"columns": {"stoarge": "G'"}}, "'stoarge' is none of the columns: frequency, storage"),
        ([HEADED, *ROWS], {"columns": {"storage": "E'"}}, 'no column is called "E\'"'),
        ([HEADED, *ROWS], {"where": {"sample": "NR"}}, "no column is called 'sample'"),
        ([HEADED, *ROWS], {"where": {"f": 7}}, "no row has {'f': 7}"),
        ([HEADED, *ROWS], {"encoding": "latin-9000"}, "encoding = 'latin-9000': Python knows none"),
        ([HEADED + ";tan_delta [%]", *(row + ";1" for row in ROWS)], {}, "in '%', and is a number without a unit"),
        (["T;G'", "20;1"], {}, "column 'T' has no unit in the heading: state units = {T = \"K\"}"),
        (["G' [Pa];G' [kPa]", "20;1"], {}, "are both storage"),
        ([HEADED, "1;2;", *ROWS], {}, "line 2, column \"G''\": '' is no number"),
        ([HEADED, "1;2;1_0", *ROWS], {}, "line 2, column \"G''\": '1_0' is no number"),
        ([HEADED, "1;2;inf", *ROWS], {}, "line 2, column \"G''\": 'inf' is no number"),
        ([HEADED, "1;2;1e999", *ROWS], {}, "line 2, column \"G''\": '1e999' is no number"),
        ([HEADED, "1;2;1.2.3", *ROWS], {}, "line 2, column \"G''\": '1.2.3' is no number"),
        ([HEADED, "1;2;1,000,000", *ROWS], {}, "line 2, column \"G''\": '1,000,000' is no number"),
        ([HEADED, "0.5;1,5;2"], {}, "decimals have commas, '1,5', and points, '0.5': state decimal"),
        ([HEADED, "0,5;1.5;2"], {"decimal": ","}, "line 2, column \"G'\": '1.5' is no number"),
        ([HEADED], {}, "no row below line 1"),
        (["# nothing"], {}, "no row in it"),
    ],
)
def test_what_is_no_table_is_refused_with_what_stands_there(tmp_path, lines, stated, refusal):
    with pytest.raises(ValueError, match=refusal):
        read(written(tmp_path, "\n".join(lines)), **stated)


@pytest.mark.parametrize(
    ("content", "said"),
    [(b"PK\3\4rest", "workbooks"), (b"\x89PNG\r\n", "a picture"), (b"II*\0", "a picture")],
)
def test_workbooks_and_pictures_are_refused_by_what_they_are(tmp_path, content, said):
    (tmp_path / "table.csv").write_bytes(content)
    with pytest.raises(ValueError, match=f"table.csv is .*{said}.*a table is a text file"):
        read(tmp_path / "table.csv")


@pytest.mark.parametrize(
    "stated",
    [{"skip": -1}, {"rows": "3"}, {"separator": "|"}, {"decimal": "'"}, {"columns": {"z": 0}}, {"sep": ";"}],
)
def test_what_is_stated_is_checked(stated):
    with pytest.raises(ValueError, match=next(iter(stated))):
        TableFormat(**stated)


def test_a_single_letter_has_its_case_and_a_frequency_per_second_stays_open(tmp_path):
    known = Column("T", (), (KELVIN,)), Column("time", ("t",)), FREQUENCY
    columns = read_columns(written(tmp_path, "t,T [degC],f [1/s]\n1,20,5\n2,30,6\n"), known)
    agree(columns, {"time": [1, 2], "T": [293.15, 303.15], "frequency": [5, 6]})
    assert [columns.units[name] for name in columns.values] == [KELVIN, None, None]


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
    agree(read(pandas.concat([frame, frame.assign(remark="b")]), where={"remark": "b"}))
    for wrong, said in (
        (3.0, "3.0: a path, a DataFrame"),
        ({"G'": [1.0, np.nan]}, 'row 2, column "G\'": nan is no number'),
        ({"G'": [[1.0]]}, r"shape \(1, 1\), and \(rows,\) is needed"),
        ({"G'": [1.0], "f": [1, 2]}, "must be equally many"),
        (pandas.concat([frame, frame.assign(remark="b")]), "column 'remark' has several values"),
    ):
        with pytest.raises(ValueError, match=said):
            read(wrong)


UNITS = {
    "frequency": {"Hz": 1.0, "kHz": 1e3},
    **{name: {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6} for name in ("storage", "loss")},
}
NAMES = {"frequency": ("f", "Frequency"), "storage": ("G'", "storage"), "loss": ("G''", 'G"', "loss")}
EXTRA = {
    "point": lambda count, rng: [str(k + 1) for k in range(count)],
    "tan_delta": lambda count, rng: [f"{each:.3g}" for each in rng.uniform(0, 1, count)],
    "remark": lambda count, rng: ["ok"] * count,
    "status": lambda count, rng: [""] * count,
    "sample": lambda count, rng: ["A", *rng.choice(["A", "B"], count - 1)],
    "T [degC]": lambda count, rng: ["25"] * count,
}


class Drawn:
    """A table as somebody may have written it, what is meant by it, and what has to be stated of it.

    spoilt : whether a row that is meant cannot be read; damaged : whether any cannot
    """

    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)
        self.fields = self.shuffled(NAMES)
        self.separator = self.one_of("\t", ";", ",", "  ")
        self.comma = self.separator in "\t;" and self.often(0.4)
        self.units = {name: self.one_of(*UNITS[name]) for name in self.fields}
        self.stated = {"separator": {"\t": "tab", ";": "semicolon", ",": "comma"}.get(self.separator, "blanks")}
        self.stated["decimal"] = "," if self.comma else "."
        above, heading, numbers = self.above(), self.heading(), self.rows()
        blank = {" ": ""} if self.separator == "  " else {}
        lines = [self.line(each, blank) for each in [*heading, *numbers]]
        skipped = [*above, *lines[: len(heading)]] if not heading else above
        if skipped:
            self.stated["skip"] = len(skipped)
        self.text = "\n".join([*above, *lines, *self.below(len(numbers))])
        self.encoding = "utf-8"
        if not self.text.isascii() and self.often(0.5):
            self.encoding = self.stated["encoding"] = "cp1252"

    def one_of(self, *given):
        return given[self.rng.integers(len(given))]

    def shuffled(self, given):
        return [str(each) for each in self.rng.permutation(list(given))]

    def often(self, share):
        return self.rng.random() < share

    def line(self, cells, blank):
        cells = [each or "-" for each in cells] if blank else cells
        quoted = self.often(0.1) and not any('"' in each for each in cells) and self.separator != "  "
        return self.separator.join(f'"{each}"' if quoted else each for each in cells)

    def above(self):
        self.place = self.one_of("heading", "heading", "below", "comment", "sentence", "nowhere")
        spoken = ", ".join(f"{name} in {unit}" for name, unit in self.units.items())
        lines = [f"# {spoken}"] if self.place == "comment" else [spoken] if self.place == "sentence" else []
        others = (
            "# NR, 1.2 MPa, 0.3 MPa",
            "# all moduli in GPa",
            "# 25 °C",
            "Sample A",
            "T = 25 °C",
            "Run;7;8",
            "1 2 3",
        )
        lines += [self.one_of(*others)] * self.often(0.3)
        if self.place == "nowhere":
            self.units = dict.fromkeys(self.fields, "Pa") | {"frequency": "Hz"}
        if self.place not in ("heading", "below"):
            self.stated["units"] = self.units
        return self.shuffled(lines)

    def heading(self):
        self.extra = self.shuffled(EXTRA)[: self.rng.integers(3)]
        self.extra = [each for each in self.extra if " " not in each or self.separator != "  "]
        if self.often(0.1):
            self.stated["columns"] = {name: k + 1 for k, name in enumerate(self.fields)}
            self.stated["units"] = self.units
            self.extra = [each for each in self.extra if each != "T [degC]"]
            self.stated["where"] = {str(4 + k): "*" for k, _ in enumerate(self.extra)}
            return []
        named = [self.one_of(*NAMES[name]) for name in self.fields]
        bracket = self.one_of("{} [{}]", "{} ({})")
        if self.place == "heading":
            named = [bracket.format(name, self.units[each]) for name, each in zip(named, self.fields, strict=True)]
        below = [*(self.units[each] for each in self.fields), *("" for _ in self.extra)]
        below = [
            "degC" if name.startswith("T") else unit
            for name, unit in zip([*named, *self.extra], below, strict=True)
        ]
        return [[*named, *self.extra], *([below] if self.place == "below" else [])]

    def rows(self):
        count, rng = self.rng.integers(2, 8), self.rng
        texts = {name: [f"{each:.5g}" for each in 10 ** rng.uniform(-2, 6, count)] for name in self.fields}
        self.meant = {name: np.array(texts[name], float) * UNITS[name][self.units[name]] for name in self.fields}
        columns = [texts[name] for name in self.fields] + [EXTRA[name](count, rng) for name in self.extra]
        chosen = np.ones(count, bool)
        if "sample" in self.extra:
            place = 3 + self.extra.index("sample")
            chosen = np.array(columns[place]) == "A"
            self.meant = {name: each[chosen] for name, each in self.meant.items()}
            named = str(place + 1) if "columns" in self.stated else "sample"
            self.stated["where"] = {**self.stated.get("where", {}), named: "A"}
        rows = [
            [each.replace(".", "," if self.comma else ".") for each in row] for row in zip(*columns, strict=True)
        ]
        self.spoilt = self.damaged = self.often(0.2)
        row = rng.integers(count)
        if self.spoilt and self.often(0.5):
            rows[row][rng.integers(3)] = self.one_of("", "x", "nan", "1.2.3", "1 2", "1,234,567", "--")
            self.spoilt = chosen[row]
        elif self.spoilt:
            rows[row].pop()
        return rows

    def below(self, count):
        """A second block, a row of means or a sample, so that what is read as one is wrong."""
        if not self.often(0.2):
            return []
        self.stated["rows"] = int(count)
        row = self.separator.join(["7"] * (3 + len(self.extra)))
        return self.one_of(
            ["", row], ["Sample B", row], ["# Sample B, Pa", row], [row + self.separator + "7"], ["mean"]
        )


def check_drawn(tmp_path, seed):
    """What is read without a word, and with what is stated, is what is meant, or it is refused."""
    drawn, read_at_all = Drawn(seed), []
    path = written(tmp_path, drawn.text, drawn.encoding)
    for stated in ({}, drawn.stated):
        try:
            found = read(path, **stated)
        except ValueError as error:
            refused = str(error)
        else:
            refused = ""
        if refused:
            assert "table.csv" in refused, refused
            continue
        assert not drawn.spoilt, (stated, drawn.text)
        read_at_all.append(stated)
        for name, numbers in drawn.meant.items():
            assert name in found, (stated, drawn.text)
            np.testing.assert_allclose(found[name], numbers, rtol=1e-12, err_msg=f"{stated}\n{drawn.text}")
    assert drawn.damaged or read_at_all, (drawn.stated, drawn.text)
    return len(read_at_all)


@pytest.mark.parametrize(
    ("first", "count"), [(0, 300), pytest.param(300, 5000, marks=pytest.mark.slow)], ids=["some", "many"]
)
def test_no_table_is_read_as_other_numbers_than_were_meant(tmp_path, first, count):
    times = [check_drawn(tmp_path, seed) for seed in range(first, first + count)]
    # Many are read as they stand, and many more once what differs is stated.
    assert min(times.count(1), times.count(2)) > 0.15 * count
