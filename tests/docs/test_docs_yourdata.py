"""The pages on data of one's own: their commands print what they show."""

import re
import shutil
from pathlib import Path

import pytest
import yourdata
from typer.testing import CliRunner

from compare.cli.app import app
from compare.studies.mastercurve import measurements as measuredfriction
from scene import heighttext, modulinames, scanheader, stylus

PAGES = sorted(yourdata.FOLDER.glob("*.md"))
# Seconds and bytes, which the machine decides.
MEASURED = re.compile(r"^(?:time|memory) .*$", re.MULTILINE)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_commands_print_what_the_page_shows(page):
    for output, block in yourdata.printed(page):
        assert MEASURED.sub("", block[2]).strip() == MEASURED.sub("", output).strip()


REFERENCE = yourdata.FOLDER.parents[1] / "reference"
COLUMNS = {"rubber": modulinames.COLUMNS, "friction": measuredfriction.COLUMNS}
ROW = re.compile(r"^\| [^|]+ \| (`.*`) \| ([^`|]*)\|$", re.MULTILINE)


def called(columns):
    return {name for column in columns for name in column.called}


@pytest.mark.parametrize("page", COLUMNS)
def test_names_and_units_of_columns_are_those_that_are_read(page):
    text = (yourdata.FOLDER / f"{page}.md").read_text(encoding="utf-8").replace(r"\|", "¦")
    table = text.partition("| Column | Names, such as |")[2].partition("\n\n")[0]
    rows = ROW.findall(table)
    assert len(rows) == table.count("\n") - 1
    for names, units in rows:
        meant = [each.replace("¦", "|") for each in re.findall("`(.*?)`", names)]
        columns = [column for column in COLUMNS[page] if set(meant) & set(column.called)]
        assert set(meant) <= called(columns), names
        for unit in filter(None, units.strip().split(", ")):
            assert any(_allows(each, unit) for column in columns for each in column.units), (names, unit)


def _allows(known, unit):
    try:
        return bool(known.scale(unit))
    except ValueError:
        return False


@pytest.mark.parametrize(
    ("page", "names"),
    [
        ("command.md", called(measuredfriction.COLUMNS)),
        ("scenes.md", called((heighttext.X, heighttext.Y, heighttext.Z))),
        ("scenes.md", {name for names in (*scanheader.SIZES, *scanheader.PIXELS) for name in names}),
        ("scenes.md", {*scanheader.CHANNEL, *scanheader.UNIT}),
        ("scenes.md", called((stylus.X, stylus.Z))),
    ],
)
def test_the_reference_has_every_name_that_is_read(page, names):
    text = (REFERENCE / page).read_text(encoding="utf-8")
    assert [name for name in sorted(names) if f"`{name}`" not in text] == []


RUBBER, ROUGH, LINE = ("plan", "rubber.toml"), ("plan", "rough.toml"), ("plan", "line.toml")
PSD = "plan", "psd.toml"
MAP, FRICTION = ("topography", "map.txt"), ("mastercurve", "tribometer.csv")
WRONG = [
    # page, command, file, what stands there and what in its place, what is said
    ("rubber", RUBBER, "rubber.toml", r"kind = .*", "", "elastomer.kind: missing"),
    ("rubber", RUBBER, "rheometer.txt", r"^Hz", "", "elastomer.frequency_unit: missing"),
    ("rubber", RUBBER, "rubber.toml", r"\[temperature\](.*\n){6}", "", "has several temperatures"),
    ("rubber", RUBBER, "rheometer.txt", r"^\d\S*\t", "1\t", "is no table of frequencies"),
    (
        "rubber",
        RUBBER,
        "rheometer.txt",
        "Storage modulus",
        "E'",
        "names moduli of kind 'tensile', and kind = 'shear' is stated",
    ),
    (
        "rubber",
        RUBBER,
        "rheometer.txt",
        r"Storage modulus(.*\n).*\n",
        r"Storage modulus [mpa]\1",
        "no unit is called 'mpa'",
    ),
    ("rubber", RUBBER, "rheometer.txt", "2,4067", "2.4067", "is not a number"),
    ("rubber", RUBBER, "rheometer.txt", "2,4067", "0", "must be finite and greater than 0"),
    ("rubber", RUBBER, "rubber.toml", "c1 = 8.9", "c1 = 30", "the best passive solid is off by"),
    ("rubber", RUBBER, "rheometer.txt", "MPa", "", "softer than a gel; is"),
    ("surface", MAP, "map.txt", "# Value.*", "", "does not state the unit of its heights"),
    ("surface", MAP, "map.txt", "# Width.*", "", "the side of a pixel"),
    ("surface", LINE, "profile.csv", r" \[mm\]", "", "does not state the unit of its places"),
    ("surface", LINE, "line.toml", r"\Z", 'unit = "mm"', "states its own"),
    ("surface", MAP, "map.txt", "units: m", "units: V", "a unit of length is needed"),
    ("surface", MAP, "map.txt", "units: m", "units: m", "have no height"),
    ("surface", MAP, "map.txt", "nan", "-9999", "stand for missing heights"),
    ("surface", MAP, "map.txt", r"\Z", "MAP", "has 2 channels"),
    ("surface", ("topography", "profile.csv"), "profile.csv", r"\Z", "", "a line of heights is roughness"),
    ("surface", LINE, "profile.csv", r"^0,195.*\n", "\n", "blocks of numbers from line 4 and 44 on"),
    ("surface", LINE, "profile.csv", "^0,195", "0,197", "places of a line are evenly spaced"),
    ("surface", ROUGH, "rough.toml", "shortest_kept.*", "", "is less than two pixels of"),
    ("surface", PSD, "psd.toml", "convention.*", "", "state the convention of the density"),
    ("surface", PSD, "psd.csv", ";90.05", ";900", "below zero, and no isotropic surface has such line scans"),
    ("surface", PSD, "psd.csv", r"^q", "k", "one column q or frequency is needed"),
    ("friction", FRICTION, "tribometer.csv", r"Speed \[mm/s\]", "U [mm/s]", "there is no column for v"),
    ("friction", FRICTION, "tribometer.csv", "Friction force", "Drag, right", "for mu"),
    (
        "friction",
        FRICTION,
        "tribometer.csv",
        r"Speed \[mm/s\]",
        "Speed [rpm]",
        "is one of sliding only with the radius",
    ),
    ("friction", FRICTION, "tribometer.csv", r" \[°C\]", "", "has no unit, and 10.1 K is hardly meant"),
    (
        "friction",
        FRICTION,
        "tribometer.csv",
        r"Friction force \[N\]",
        "Friction force [MPa]",
        "gives F_T in 'MPa'",
    ),
    (
        "friction",
        FRICTION,
        "tribometer.csv",
        "Remark(.*)\n((.*;))\n",
        r"mu\n\g<2>9\n",
        "they must agree within 5%",
    ),
    ("friction", FRICTION, "tribometer.csv", "^(1;.*;)[^;]*;$", r"\g<1>-1;", "must be finite and greater than 0"),
    ("friction", FRICTION, "tribometer.csv", "^(1;.*;)[^;]*;$", r"\g<1>1,2;", "is not a number"),
    ("friction", FRICTION, "tribometer.csv", r"^\d+;\S+;\S+;(?!2[.;]|1\.9)\S+;\S+;\n", "", "has 1 load"),
    ("friction", FRICTION, "tribometer.csv", r"^\d+;[^;]*;(?!0[.](09|1)).*\n", "", "has a single speed"),
    (
        "friction",
        FRICTION,
        "tribometer.csv",
        r"^\d+;2[45].*\n",
        "",
        "share less than 25% of their speeds once shifted",
    ),
]


@pytest.mark.parametrize(
    ("page", "command", "name", "stands", "instead", "said"), WRONG, ids=[each[-1] for each in WRONG]
)
def test_what_the_page_says_of_a_wrong_file_is_said(
    page, command, name, stands, instead, said, tmp_path, monkeypatch
):
    text = (yourdata.FOLDER / f"{page}.md").read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    for each in yourdata.FILES:
        shutil.copy(yourdata.FOLDER / each, each)
    for kind, block in yourdata.BLOCK.findall(text):
        if kind == "toml" and (named := yourdata.NAMED.match(block)):
            Path(named[1]).write_text(block, encoding="utf-8")
    held = Path(name).read_text(encoding="utf-8")
    instead = held if instead == "MAP" else instead
    Path(name).write_text(re.sub(stands, instead, held, flags=re.MULTILINE), encoding="utf-8")
    output = " ".join(CliRunner().invoke(app, command).output.split())
    assert said in output
    assert said in " ".join(text.split())
