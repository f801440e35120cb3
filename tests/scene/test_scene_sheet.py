"""Sheets of numbers: whatever their dialect, they are read as they were written, or refused."""

import numpy as np
import pytest

from scene.blocks import joined
from scene.columns import Column, chosen
from scene.heading import named
from scene.quantities import HERTZ, KELVIN, PASCAL, SECOND
from scene.sheet import read_sheets

FIELDS = "frequency", "storage", "loss"
WANTED = [
    Column("frequency", ("f", "frequency"), (HERTZ,)),
    Column("storage", ("G'", "storage modulus"), (PASCAL,)),
    Column("loss", ("G''", 'G"', "loss modulus"), (PASCAL,)),
]
ROUNDING = 4e-16  # of one product
HEADED = "f [Hz];G' [MPa];G'' [kPa]"
ROWS = "1;2;3", "2;3;4", "3;4;5"


def read_table(path):
    found, _ = chosen(joined(read_sheets(path)), WANTED, FIELDS)
    return {name: each.numbers for name, each in found.items()}


def written(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "table.csv"
    path.write_bytes(text.encode(encoding))
    return path


CELLS = ["1.5", "-2.25e3", "nan"], ["2.5", "n/a", "4.5"], ["3", "4", "5"]
NUMBERS = np.array([[1.5, -2250.0, np.nan], [2.5, np.nan, 4.5], [3.0, 4.0, 5.0]])


@pytest.mark.parametrize("quote", ["", '"'])
@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("separator", [";", "\t", "|", ", ", "  "])
def test_a_file_in_any_dialect_is_read_as_it_was_written_or_refused(tmp_path, separator, decimal, quote):
    """Refused where commas part both columns and decimals, and where a cell is no number."""

    def text(*rows):
        lines = (separator.join(f"{quote}{cell}{quote}" for cell in row) for row in rows)
        return "\r\n".join(lines).replace(".", decimal)

    headed = text(["f [Hz]", "Storage modulus [MPa]", "Loss modulus [kPa]"], *CELLS)
    if (separator, decimal, quote) == (", ", ",", ""):
        for each in (headed, text(*CELLS)):
            with pytest.raises(ValueError, match="other rows have"):
                read_sheets(written(tmp_path, each))
        return
    (sheet,) = read_sheets(written(tmp_path, text(*CELLS)))
    np.testing.assert_array_equal(sheet.numbers, NUMBERS)
    found = read_table(written(tmp_path, headed))
    for name, numbers, unit in zip(FIELDS, NUMBERS.T, (1.0, 1e6, 1e3), strict=True):
        np.testing.assert_allclose(found[name], unit * numbers, rtol=ROUNDING)
    for spoilt in ("1.2.3", "x", "1e", "12.5.1"):
        for damaged in (headed, text(*CELLS)):
            with pytest.raises(ValueError, match=f"column 3: '{spoilt}' is not a number"):
                read_sheets(written(tmp_path, damaged.replace("4.5".replace(".", decimal), spoilt)))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "latin-1"])
def test_the_encoding_does_not_matter(tmp_path, encoding):
    text = "\r\n".join(["Maßstab 1, 25 °C", "", HEADED, *ROWS])
    found = read_table(written(tmp_path, text, encoding))
    np.testing.assert_array_equal(found["storage"], [2e6, 3e6, 4e6])
    np.testing.assert_array_equal(found["loss"], [3e3, 4e3, 5e3])


@pytest.mark.parametrize(
    "above",
    [
        [HEADED],
        ["f;G';G''", "Hz;MPa;kPa"],
        ["f;G';G''", "[Hz];[MPa];[kPa]"],
        ["% f, Hz", '"f / Hz";"G\' / MPa";"G"" / kPa"'],
        ["# f [Hz], G' [MPa], G'' [kPa]"],
        [HEADED, "# " + "-" * 20],
        ["sample;7;;", ";;;", HEADED],
        ["Speed: 3 mm/s", HEADED, ""],
    ],
)
def test_units_are_those_of_the_heading_wherever_it_stands(tmp_path, above):
    found = read_table(written(tmp_path, "\n".join([*above, *ROWS])))
    np.testing.assert_array_equal(found["frequency"], [1, 2, 3])
    np.testing.assert_array_equal(found["storage"], [2e6, 3e6, 4e6])
    np.testing.assert_array_equal(found["loss"], [3e3, 4e3, 5e3])


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (["f [Hz];G' [MPa];G'' [kPx]", *ROWS], "kPx"),
        (["f [s];G' [MPa];G'' [kPa]", *ROWS], "a frequency, as Hz"),
        (["f;G';G''", "Hz;MPa", *ROWS], "neither"),
        (["# all moduli in MPa", *ROWS], "speaks of MPa"),
        (["1,5", "2,5", "3,5"], "can be read as 1 and 5 and as 1.5"),
        (["1,5,2,5,3,5", "4,5,5,5,6,5"], "commas may part columns or decimals"),
        (["f [Hz];G' [MPa];G'' [kPa]", "Hz;Pa;Pa", *ROWS], "state one"),
        (["f;G';G'';loss modulus", *(row + ";1" for row in ROWS)], "both loss"),
        (["# storage modulus and loss modulus in MPa", *ROWS], "above the numbers is no heading"),
        (["f;G';G''", "1;2;3", ";;", "2;3;4"], "line 3: a row without a number"),
        (["f,G',G''", '1.5,"1,003,935","65,230"', '2.5,"1,003,936","65,231"'], "column 2.*between thousands"),
        (["f;G';G''", "0.5;1,5;2", "2;3,5;3"], "column 1: '0.5' is not a number: the other numbers have commas"),
        ([HEADED, "1;2;3", "2;x;4", "3;4;5"], r"line 3, column 2: 'x' is not a number"),
        ([HEADED, "1;2;3", "2;3", "3;4;5"], "line 3: 2 columns, and other rows have 3"),
        ([HEADED, *ROWS, "", "f [Hz];G' [Pa];G'' [Pa]", *ROWS], "two tables, from line 2 and from line 7"),
        (["1,234;2,345;3,456", "4,567;5,678;6,789"], "between thousands"),
        (["1.234,5;2;3", "2;3;4"], "1.234,5"),
        (["1 2;3", "2 3;4"], "is not a number"),
        ([""], "no row of numbers"),
    ],
)
def test_what_cannot_be_read_is_refused_with_its_place_and_what_stands_there(tmp_path, lines, said):
    with pytest.raises(ValueError, match=said):
        read_table(written(tmp_path, "\n".join(lines)))


def test_an_empty_cell_is_missing_and_closes_no_gap(tmp_path):
    (sheet,) = read_sheets(written(tmp_path, "1;2;;4\n;2;3;4\n1;nan;3;#N/A\n1;2;3;-1.#IND"))
    expected = [[1, 2, np.nan, 4], [np.nan, 2, 3, 4], [1, np.nan, 3, np.nan], [1, 2, 3, np.nan]]
    np.testing.assert_array_equal(sheet.numbers, expected)


def test_rows_of_separators_at_the_end_are_rows_without_numbers(tmp_path):
    (sheet,) = read_sheets(written(tmp_path, "f;G';G''\n1;2;3\n2;3;4\n;;\n;;\n"))
    np.testing.assert_array_equal(sheet.numbers, [[1, 2, 3], [2, 3, 4], *[[np.nan] * 3] * 2])


@pytest.mark.parametrize(
    ("cell", "parts"),
    [
        ("storage_modulus_mpa", ("storage_modulus", "mpa")),
        ("v_mm_s", ("v", "mm/s")),
        ("speed_m_per_s", ("speed", "m/s")),
        ("Normal force F_N", ("Normal force F_N", "")),
        ("T_g", ("T_g", "")),
        ("temp_deg_C", ("temp", "degC")),
    ],
)
def test_units_behind_underscores_are_units(cell, parts):
    assert named(cell) == parts


def test_a_blank_line_a_comment_or_a_text_ends_a_block(tmp_path):
    one, two, three = read_sheets(written(tmp_path, "Height\n1 2\n3 4\n\nPhase\n5 6\n# Error\n7 8\n"))
    assert [each.before for each in (one, two, three)] == [("Height",), ("Phase",), ("Error",)]
    assert [each.numbers[0, 0] for each in (one, two, three)] == [1, 5, 7]


def test_a_heading_tells_commas_between_columns_from_those_of_decimals(tmp_path):
    (sheet,) = read_sheets(written(tmp_path, "f,G'\n1,5\n2,5"))
    np.testing.assert_array_equal(sheet.numbers, [[1, 5], [2, 5]])


def test_a_column_that_is_not_known_is_named(tmp_path):
    text = "f [Hz];status;G' [MPa];strain [%];G'' [kPa]\n1;12.03.2024;2;0,1;3\n2;ok;3;0,1;4\n"
    _, notes = chosen(*read_sheets(written(tmp_path, text)), WANTED)
    assert [each.rpartition(": ")[2] for each in notes] == ["column 'strain' is not used"]


def test_capital_letters_tell_names_apart_only_where_two_columns_need_it(tmp_path):
    wanted = [Column("temperature", ("T",), (KELVIN,)), Column("time", ("t",), (SECOND,))]
    found, _ = chosen(*read_sheets(written(tmp_path, "t [ms],T [C]\n1,20\n2,30\n")), wanted)
    np.testing.assert_allclose(found["time"].numbers, [1e-3, 2e-3], rtol=ROUNDING)
    np.testing.assert_allclose(found["temperature"].numbers, [293.15, 303.15], rtol=ROUNDING)
    with pytest.raises(ValueError, match="write it out"):
        chosen(
            *read_sheets(written(tmp_path, "TIME,t\n1,20\n2,30\n")),
            [Column("a", ("Time", "T")), Column("b", ("tIme",))],
        )


def test_many_rows_are_read_at_once_as_they_are_one_by_one(tmp_path):
    numbers = np.random.default_rng(5).normal(size=(400, 6))
    text = "\n".join(";".join(f"{each:.6e}".replace(".", ",") for each in row) for row in numbers)
    (fast,) = read_sheets(written(tmp_path, text))
    (slow,) = read_sheets(written(tmp_path, text.replace("e", "d", 1)))  # numpy does not know this exponent
    (quoted,) = read_sheets(written(tmp_path, text.replace(";", '";"').replace("\n", '"\n"').join('""')))
    np.testing.assert_array_equal(fast.numbers, slow.numbers)
    np.testing.assert_array_equal(fast.numbers, quoted.numbers)
    with pytest.raises(ValueError, match="at most 300 are read"):
        read_sheets(written(tmp_path, text), most_rows=300)
    with pytest.raises(ValueError, match=r"line 401: 5 columns"):
        read_sheets(written(tmp_path, text + "\n1;2;3;4;5"))
