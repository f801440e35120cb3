"""The page of the paper: claims, figures, tables."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from ..figures import paper_contacts, paper_law, paper_losses, paper_sketch, paper_studies, shifted_curves
from ..glossary import Definitions
from ..illustration import Illustration, illustrate, sheets_of
from ..publish import machine, render, versions, write_csv, write_json, write_text
from ..sheets import Sheet, reading
from ..sweep import SweepResult
from . import parameters
from .claims import Claim
from .reproduction import Reproduction

PAGE, MANIFEST, TABLE = "paper.html", "manifest.json", "claims.csv"

CONTENTS = {"summary": "What is claimed and what is found", "open": "What is left open", "figures": "Figures"}


def write_paper(folder: Path, found: Reproduction, said: Sequence[Claim], swept: SweepResult) -> Path:
    """Write page, figures and tables into a folder, and return the path of the page.

    said : the claims
    """
    drawn = figures(folder, found)
    write_csv(folder / TABLE, [claim.row for claim in said])
    manifest = {
        "versions": versions(),
        "platform": machine(),
        "tasks": {"solved": swept.solved, "reused": swept.reused},
        "wall_seconds": swept.seconds,
        "claims": [claim.row for claim in said],
    }
    write_json(folder / MANIFEST, manifest)
    table = Sheet.read(folder, folder / TABLE, "Claims")
    page = render(
        "paper.html",
        title="The paper in one dimension",
        contents=[
            ("summary", "What is claimed and what is found"),
            ("open", "What is left open"),
            ("figures", "Figures"),
        ],
        claims=said,
        verdicts=Counter(claim.verdict for claim in said),
        table=table,
        figures=drawn,
        shown={figure.name: figure.anchor for figure in drawn},
        sheets=[table, *sheets_of(drawn)],
        definitions=Definitions(),
        **reading(),
        parameters=parameters,
        solves=found.collapse.samples.size,
        sweeps=found.collapse.sweeps,
        failed=found.failed,
        swept=swept,
    )
    write_text(folder / PAGE, page)
    return folder / PAGE


def figures(folder: Path, found: Reproduction) -> list[Illustration]:
    """Write every figure with its tables into a folder."""
    drawn = [
        illustrate(folder, folder, paper_contacts, found.contacts),
        illustrate(folder, folder, paper_sketch, None),
        illustrate(folder, folder, paper_studies, found.collapse),
        illustrate(folder, folder, paper_law, found.laws),
        *(
            illustrate(folder, folder, shifted_curves, [lossy.whole, lossy.rough], suffix=lossy.loss.suffix)
            for lossy in found.losses
        ),
        illustrate(folder, folder, paper_losses, found.losses),
    ]
    return [figure for figure in drawn if figure]
