"""The pages on the user's own data: their commands print what they show."""

import re
import shutil
from pathlib import Path

import pytest
import yourdata
from typer.testing import CliRunner

from compare.cli.app import app
from compare.studies.mastercurve import measurements
from scene.effects import temperature
from scene.files.heightfile import X, Y, Z
from scene.solids import moduli, viscoelastic

PAGES = sorted(yourdata.FOLDER.glob("*.md"))
# Seconds and bytes, which the machine decides.
MEASURED = re.compile(r"^(?:time|memory) .*$", re.MULTILINE)


@pytest.mark.parametrize(
    "page",
    [
        pytest.param(each, marks=pytest.mark.slow if each.stem == "friction" else (), id=each.stem)
        for each in PAGES
    ],
)
def test_commands_print_what_the_page_shows(page):
    for output, block in yourdata.printed(page):
        assert MEASURED.sub("", block[2]).strip() == MEASURED.sub("", output).strip()


REFERENCE = yourdata.FOLDER.parents[1] / "reference"
COLUMNS = {
    *(*moduli.COLUMNS, *viscoelastic.TERMS, temperature.TEMPERATURES, *temperature.FACTORS, *measurements.COLUMNS),
    *(X, Y, Z),
}


def test_the_reference_has_every_name_that_is_read():
    text = (REFERENCE / "scenes.md").read_text(encoding="utf-8").replace(r"\|", "|")
    names = {name for column in COLUMNS for name in (column.field, *column.names) if not name.isupper()}
    assert [name for name in sorted(names) if f"`{name}`" not in text] == []
    assert len({name for column in COLUMNS for name in column.names}) < 80


RUBBER, ROUGH, LINE = ("plan", "rubber.toml"), ("plan", "rough.toml"), ("plan", "line.toml")
PSD = "plan", "psd.toml"
MAP = ("topography", "map.txt", "--skip", "4", "--unit", "m", "--pixel", "1.04167 um")
FRICTION = ("mastercurve", "tribometer.csv")
WRONG = [
    # page, command, file, the text there, its replacement, the message
    ("rubber", RUBBER, "rubber.toml", r"kind = .*", "", "elastomer.kind: missing"),
    ("rubber", RUBBER, "rheometer.txt", r"^Hz", "", "elastomer.frequency_unit: missing"),
    ("rubber", RUBBER, "rubber.toml", r"\[temperature\](.*\n){6}", "", "has several temperatures"),
    ("rubber", RUBBER, "rheometer.txt", r"^\d\S*\t", "1\t", "is no table of"),
    ("rubber", RUBBER, "rubber.toml", "c1 = 8.9", "c1 = 30", "the best passive solid is off by"),
    ("rubber", RUBBER, "rheometer.txt", "MPa", "Pa", "softer than a gel; is"),
    ("surface", MAP, "map.txt", r"\Z", "", 'missing: missing = "fill" fills them in'),
    ("surface", MAP, "map.txt", "nan", "-9999", "as programs write missing ones"),
    ("surface", (*MAP, "--unit", "V"), "map.txt", r"\Z", "", "a unit of length is needed"),
    ("surface", LINE, "profile.csv", "^0,195", "0,197", "places of heights are evenly spaced"),
    ("surface", PSD, "psd.toml", "convention.*", "", "state the convention of the density"),
    ("surface", PSD, "psd.csv", ";90.05", ";900", "below zero, and no isotropic surface has such line scans"),
    ("surface", PSD, "psd.csv", r"^q", "k", "one column q or frequency is needed"),
    ("friction", FRICTION, "tribometer.csv", r"Speed \[mm/s\]", "Speed [rpm]", "is in 'rpm', and is a speed"),
    (
        "friction",
        FRICTION,
        "tribometer.csv",
        r"Remark|;$",
        lambda found: "mu" if found[0] == "Remark" else ";9",
        "must agree within 5%",
    ),
    ("friction", FRICTION, "tribometer.csv", "^(1;.*;)[^;]*;$", r"\g<1>-1;", "must be greater than 0"),
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
    ("page", "command", "name", "stands", "instead", "message"), WRONG, ids=[each[-1] for each in WRONG]
)
def test_what_the_page_says_of_a_wrong_file_is_said(
    page, command, name, stands, instead, message, tmp_path, monkeypatch
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
    assert message in output
    assert message in " ".join(text.split())
