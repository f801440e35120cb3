"""Scorecards of MDR, BEM, tamaas and ContactMechanics: writes results/verify.md and .csv.

The adapters of the last two are those of howto/verify.md, and need the extra `peers`. It takes some minutes.
"""

import importlib
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pandas
from tables import stored, table

import compare
from bem3d import BEM
from compare.studies.checks.law import GROUPS, STORED
from mdr1d import MDR

DOCS = Path(__file__).parents[1]
PAGE = DOCS / "results" / "verify.md"
VERDICTS = "holds", "fails", "reported"
HEAD = """# Scorecards

How many physical laws four contact codes keep, by `crosscheck verify`, with [adapters](../howto/verify.md) for
the last two. Written by `python docs/measure/verify.py`. [verify.csv](verify.csv) has every law that was
tested, with its error, its bound and the source of the bound.

"""
NOTES = """
A code in 1D is tested on other laws than one in 3D. Left out are laws whose scenes a code refuses: here tamaas
has planes at rest, and ContactMechanics bodies of revolution at rest. Laws show errors larger than those of the
grid. That tamaas 2.9 is wrong in its highest wave numbers where the points a side are odd is smaller; comparing
single pixels shows it.
"""

HARD = """
## Hard cases

{kept} of {count} hard cases of `crosscheck stability --size full` keep their law, each by each solver that is
asked. Each is a contact in which a solver may fail, with a law that must hold: a closed form, a limit, exact
scaling, a balance, or the conditions of contact computed anew by plain sums. [stability.csv](stability.csv) has
every case with its law, its error and its bound. Contacts without an answer are refused: lines far beyond
v τ/a = 10⁴, depths whose squares are no numbers, memories beyond 1e150 pixels, and contacts of less than nine
pixels in 3D or five in 1D.
"""


def models(folder: Path) -> Iterator:
    """The four models; those of others from the page."""
    (code,) = re.findall(
        r"^```python\n(.*?)^```", (DOCS / "howto" / "verify.md").read_text(), re.DOTALL | re.MULTILINE
    )
    (folder / "peers.py").write_text(code, encoding="utf-8")
    sys.path.insert(0, str(folder))
    peers = importlib.import_module("peers")
    yield from (MDR(), BEM(), peers.Tamaas(), peers.ContactMechanics())


def hard() -> str:
    """Text on the hard cases, as they are stored."""
    cases = pandas.read_csv(PAGE.with_name("stability.csv"))
    return HARD.format(kept=cases["verdict"].eq("holds").sum(), count=len(cases))


def main() -> None:
    """Write the page."""
    counts, failures, laws = [], [], []
    with TemporaryDirectory() as folder:
        for model in models(Path(folder)):
            report = compare.verify(model, Path(folder) / model.name, report=False)
            found = report.findings
            laws.append(found.assign(model=model.name))
            for group in GROUPS[: GROUPS.index(STORED)]:
                own = found[found["where"] == group]["verdict"]
                counts.append((model.name, group, *(str((own == each).sum()) for each in VERDICTS)))
            failed = found.query("verdict == 'fails'")[["claim", "sentence"]]
            failures += [(model.name, *row) for row in failed.itertuples(index=False)]
    text = HEAD + table("code|group|hold|fail|left out", counts) + "\n"
    text += "\nNo law fails.\n" if not failures else f"\n{table('code|law that fails|law', failures)}\n"
    text += NOTES + hard()
    PAGE.write_text(text, encoding="utf-8")
    columns = ["model", "claim", "where", "verdict", "value", "tolerance", "sentence", "meaning"]
    asked = pandas.concat(laws)
    stored(PAGE.with_suffix(".csv"), asked[asked["verdict"] != "reported"][columns])


if __name__ == "__main__":
    main()
