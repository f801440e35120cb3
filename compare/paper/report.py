"""The page of the paper: claims, figures, tables."""

from collections.abc import Sequence
from pathlib import Path

from ..figures import paper_contacts, paper_law, paper_losses, paper_sketch, paper_studies, shifted_curves
from ..publish import Drawn, draw, machine, render, versions, write_csv, write_json, write_text
from ..sweep import Swept
from . import parameters
from .claims import Claim
from .reproduction import Reproduction

PAGE, MANIFEST = "paper.html", "manifest.json"


def write_paper(folder: Path, found: Reproduction, said: Sequence[Claim], swept: Swept) -> Path:
    """Write page, figures and tables into a folder, and return the path of the page.

    said : the claims
    """
    drawn = figures(folder, found)
    write_csv(folder / "claims.csv", [claim.row for claim in said])
    manifest = {
        "versions": versions(),
        "platform": machine(),
        "tasks": {"solved": swept.solved, "reused": swept.reused},
        "wall_seconds": swept.seconds,
        "claims": [claim.row for claim in said],
    }
    write_json(folder / MANIFEST, manifest)
    page = render(
        "paper.html",
        claims=said,
        figures=drawn,
        parameters=parameters,
        solves=found.collapse.samples.size,
        sweeps=found.collapse.sweeps,
        failed=found.failed,
        swept=swept,
    )
    write_text(folder / PAGE, page)
    return folder / PAGE


def figures(folder: Path, found: Reproduction) -> list[Drawn]:
    """Write every figure with its tables into a folder."""
    drawn = [
        draw(folder, paper_contacts, found.contacts),
        draw(folder, paper_sketch, None),
        draw(folder, paper_studies, found.collapse),
        draw(folder, paper_law, found.laws),
        *(
            draw(folder, shifted_curves, [lossy.whole, lossy.rough], suffix=lossy.loss.suffix)
            for lossy in found.losses
        ),
        draw(folder, paper_losses, found.losses),
    ]
    return [figure for figure in drawn if figure]
