"""Scorecards of MDR, BEM, tamaas and ContactMechanics: writes results/verify.md and .csv.

The adapters of the last two are those of howto/verify.md, and need the extra `peers`. It takes some minutes.
"""

import importlib
import sys
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

import pandas
from tables import RESULTS, example, stored, table

import compare
from bem3d import BEM
from compare.studies.checks.law import GROUPS, STORED
from mdr1d import MDR

PAGE = RESULTS / "verify.md"
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


def models(folder):
    """The four models; those of others from the page."""
    (folder / "peers.py").write_text(example(RESULTS.parent / "howto/verify.md"), encoding="utf-8")
    sys.path.insert(0, str(folder))
    peers = importlib.import_module("peers")
    yield from (MDR(), BEM(), peers.Tamaas(), peers.ContactMechanics())


def hard():
    """Text on the hard cases, as they are stored."""
    cases = pandas.read_csv(PAGE.with_name("stability.csv"))
    return HARD.format(kept=cases["verdict"].eq("holds").sum(), count=len(cases))


def counted(found):
    """Rows with the numbers of laws of each group that a code keeps, breaks and refuses."""
    for model, group in product(found["model"].unique(), GROUPS[: GROUPS.index(STORED)]):
        own = found.query("model == @model and where == @group")["verdict"]
        yield model, group, *(str((own == each).sum()) for each in VERDICTS)


def main():
    """Write the page."""
    with TemporaryDirectory() as folder:
        reports = {
            model.name: compare.verify(model, Path(folder) / model.name, report=False)
            for model in models(Path(folder))
        }
        found = pandas.concat([report.findings.assign(model=name) for name, report in reports.items()])
    failed = found[found["verdict"] == "fails"][["model", "claim", "sentence"]].to_numpy()
    text = HEAD + table("code|group|hold|fail|left out", counted(found)) + "\n"
    text += f"\n{table('code|law that fails|law', failed)}\n" if len(failed) else "\nNo law fails.\n"
    PAGE.write_text(text + NOTES + hard(), encoding="utf-8")
    columns = ["model", "claim", "where", "verdict", "value", "tolerance", "sentence", "meaning"]
    stored(PAGE.with_suffix(".csv"), found[found["verdict"] != "reported"][columns])


if __name__ == "__main__":
    main()
