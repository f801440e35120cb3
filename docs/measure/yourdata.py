"""The pages on data of one's own: what commands print of files as instruments write them, which are made up.

`python docs/measure/yourdata.py` writes below each command of the pages what it prints.
"""

import re
import shlex
from contextlib import chdir
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest import mock

from typer.testing import CliRunner

from compare.cli.app import app

FOLDER = Path(__file__).parents[1] / "howto" / "yourdata"
FILES = "rheometer.txt", "map.txt", "profile.csv", "psd.csv", "tribometer.csv"
BLOCK = re.compile(r"^```(toml|sh|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NAMED = re.compile(r"# (\w+\.toml)\n")  # first line of a file that a page shows
HEAD = " | head -"


def printed(page):
    """What each command of a page prints among the files of all, and the block that shows it."""
    command = None
    with TemporaryDirectory() as folder, chdir(folder):
        for name in FILES:
            Path(name).write_bytes((FOLDER / name).read_bytes())
        for block in BLOCK.finditer(page.read_text(encoding="utf-8")):
            kind, text = block.groups()
            if kind == "toml" and (named := NAMED.match(text)):
                Path(named[1]).write_text(text, encoding="utf-8")
            elif kind == "text" and command:
                yield _output(command), block
            command = text.strip() if kind == "sh" else None


def _output(command):
    """Lines that a command prints, of it alone or through `head`."""
    asked, _, most = command.partition(HEAD)
    program, *arguments = shlex.split(asked)
    assert program == "crosscheck"
    # Pages and figures change nothing of it, and take seconds.
    arguments += ["--no-report"] * (arguments[0] in ("mastercurve", "topography"))
    with mock.patch("compare.solving.terminal.PAUSE", 3600.0):  # no line of progress on a slow machine
        lines = CliRunner().invoke(app, arguments).output.splitlines(keepends=True)
    return "".join(lines[: int(most)] if most else lines)


def main():
    """Write what the commands print."""
    for page in sorted(FOLDER.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        for output, block in reversed(list(printed(page))):
            text = f"{text[: block.start(2)]}{output.rstrip()}\n{text[block.end(2) :]}"
        page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
