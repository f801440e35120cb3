"""The paper simulated again at full size: writes docs/paper.md, with its figures and tables in docs/paper/.

The same is `crosscheck paper`, which writes a page to read; what has been solved once is in docs/paper/solved.
"""

import os
import resource
import time
from dataclasses import replace
from pathlib import Path

from rich.console import Console
from tables import table

from compare.paper import parameters, reproduction
from compare.paper.campaign import Block
from compare.paper.claims import claims
from compare.paper.report import figures
from compare.progress import watch
from compare.publish import write_csv, write_text
from compare.store import Store
from compare.sweep import sweep
from mdr1d import MDR
from mdr1d.ensemble import solve_profiles

FOLDER = Path(__file__).with_suffix("")
SIDE_BY_SIDE = range(10)
INTRODUCTION = """# The paper in one dimension

Popov, Voll, Li, Chai, Popov, Sci. Rep. 4, 3750 (2014), simulated again at full size: every figure, and what
becomes of every claim. Measured by `python docs/paper.py`, which writes this page; `crosscheck paper` writes the
same as a page of its own, with figures as PDF. Equation by equation, as printed and corrected:
[equations.md](equations.md).
This page is about the one-dimensional model alone; what three dimensions say is another question.
"""
OPEN = """## What the paper leaves open

- What is held while one parameter varies in Fig. 3: here the set of Fig. 4, F_N = 10 N, G = 1 MPa, h₀ = 50 µm,
  τ = 1 ms, Δx = 2 µm, θ = 10°. The speed: here 1 mm/s.
- Whether θ is the angle of the body or of its line: here of the body, so that the line is steeper by π/2.
- How the twenty values lie in their range: here geometrically, angles evenly. Spacings are moved by at most 2 % to
  where a Fourier transform over 10 mm is fast.
- The rms slope: here by finite differences on the grid, the slope of the line that is solved. The spectral one is
  larger, and the plateau then reads 0.86.
- The measured friction of Figs. 5 to 7 was not published. Here it is simulated, on the sphere of Fig. 4 with
  G(ω) = G₀ (1 + (iωτ)^β), so that G″ is the power law of Eq. 24; a table of your own takes the same way with
  `crosscheck mastercurve data.csv`.

With these parameters the rms slope is about 2, where no linear theory of contact applies. The figures are about
the model, as published.
"""


def main() -> None:
    """Solve what is not solved yet, and write the page."""
    FOLDER.mkdir(exist_ok=True)
    size = reproduction.Size.of()
    tasks = reproduction.tasks(size)
    store = Store(FOLDER / "solved")
    with watch(Console()) as progress:
        start = time.perf_counter()
        campaign = sweep([task for task in tasks if isinstance(task, Block)], store, progress=progress)
        seconds = time.perf_counter() - start
    with watch(Console()) as progress:
        swept = sweep(tasks, store, progress=progress)
    found = reproduction.collect(size, swept.outcomes)
    parts = [INTRODUCTION, "## Claims\n", _claims(found), OPEN, "## Figures\n"]
    for figure in figures(FOLDER, found):
        parts.append(f"![{figure.name}](paper/{figure.name}.png)\n\n{figure.caption}\n")
    if campaign.solved:
        parts += ["## What it costs\n", _cost(found, campaign, seconds)]
    write_text(FOLDER.with_suffix(".md"), "\n".join(parts))


def _claims(found):
    said = claims(found)
    write_csv(FOLDER / "claims.csv", [claim.row for claim in said])
    rows = [
        (claim.name, f"{claim.expected:g} ± {claim.tolerance:.2g}", claim.written, claim.verdict, claim.text)
        for claim in said
    ]
    return table("claim|claimed|found, 95 %|verdict|how", rows) + "\n"


def _cost(found, campaign, seconds):
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 2**20
    return (
        f"Fig. 3: {found.collapse.samples.size} contacts under a prescribed load, {found.collapse.sweeps:.2f} "
        f"sweeps each, profiles included, in {seconds:.0f} s on {os.cpu_count()} processors; the largest worker "
        f"took {peak:.2f} GiB.\nN is 5000 but in the study of Δx, where it runs from 1000 to 100000 on the same "
        f"length. Side by side on the study of the load, H = 0.4, {len(SIDE_BY_SIDE)} profiles: "
        f"{_ratio():.0f} times less processor time than `MDR` one contact at a time.\n"
    )


def _ratio():
    """Processor time of contacts one at a time over that of the same together, best of three."""
    load = parameters.STUDIES[0]
    scenes = [parameters.varied(load, value, 0.4)[0] for value in load.values]
    drawn = [
        replace(scene, roughness=replace(scene.roughness, seed=seed)) for scene in scenes for seed in SIDE_BY_SIDE
    ]

    def together():
        solve_profiles(scenes, [parameters.POINTS] * len(scenes), SIDE_BY_SIDE)

    def one_at_a_time():
        for scene in drawn:
            MDR(points=parameters.POINTS).solve(scene)

    return min(map(_seconds, [one_at_a_time] * 3)) / min(map(_seconds, [together] * 3))


def _seconds(work):
    start = time.process_time()
    work()
    return time.process_time() - start


if __name__ == "__main__":
    main()
