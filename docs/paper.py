"""The paper simulated again at full size: writes docs/paper.md, with its figures and tables in docs/paper/.

The same is `crosscheck paper`, which writes a page to read; what has been solved once is in docs/paper/solved. Its
files are named by the code, too: a change of code solves all again beside what is there, and leaves the old files,
which can be deleted at any time.
"""

import os
import resource
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from rich.console import Console
from tables import table

from compare.figures import paper_losses
from compare.paper import parameters, reproduction
from compare.paper.campaign import Block, Campaign, places
from compare.paper.claims import claims
from compare.paper.predicted import EVERY, SHORTEST, STIFFNESS, WITH_SMOOTH
from compare.paper.report import figures
from compare.paper.shifts import ONE
from compare.progress import watch
from compare.publish import write_csv, write_text
from compare.store import Store
from compare.sweep import sweep
from mdr1d import MDR
from mdr1d.ensemble import solve_profiles

FOLDER = Path(__file__).with_suffix("")
SIDE_BY_SIDE = range(10)
TIMED = range(4)
# All processors times the clock, over the time that was used of them, up to where a machine was left alone.
ALONE = 1.2
INTRODUCTION = """# The paper in one dimension

Popov, Voll, Li, Chai, Popov, Sci. Rep. 4, 3750 (2014), simulated again at full size: every figure, and what
becomes of every claim. Measured by `python docs/paper.py`, which writes this page; `crosscheck paper` writes the
same as a page of its own, with figures as PDF. Both keep what is solved in a folder `solved` and resume from
there; a change of code solves again and leaves the old files, which can be deleted. Equation by equation, as
printed and corrected: [equations.md](equations.md).
This page is about the one-dimensional model alone; what three dimensions say is another question.
"""
SHIFTS = """## What becomes of the shift

Eq. 23 shifts curves of friction against load along the load, by a factor that goes as v^(−3β/2) for a sphere
where the loss goes as frequency^β. In full contact a power of the frequency is the same factor for every wave:
Eq. 22 has this shift with the loss of the shortest wave and with that of every wave alike. The friction of the
smooth body grows with the load where that of the roughness falls, and with it nothing is a shift any more. What
simulated friction exceeds that of the smooth body by shifts as claimed where the macroscopic modulus |G(v/a)|
is constant, as the paper presupposes. On a rubber with the time of Fig. 4, τ = 1 ms, it is not: it grows with
the speed, the contact shrinks, and the shift comes out too small, most of all at β = 0.1. There a modulus that
is constant within a tenth takes a τ of 10⁻¹⁴ s: the loss on that scale is then a hundredth of G₀.

There are two verdicts: whether horizontal shifts bring the curves onto one, and what power of the speed the shifts
are. Without the first the second has no meaning, and is left undecided. Straight parallel lines come onto one, but
cannot tell a horizontal shift from a vertical one: there the collapse is undecided, and the exponent is that of
shifts which are taken for horizontal.

Exponents of the shift as a power of the speed; intervals are of 95 %. Forms of Eq. 22 have no scatter: their
curves are one where they miss one another by no more than {one:.0%}.

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
        blocks = [task for task in tasks if isinstance(task, Block)]
        start = time.perf_counter(), _of_workers()
        campaign = sweep(blocks, store, progress=progress)
        seconds = time.perf_counter() - start[0], _of_workers() - start[1]
    with watch(Console()) as progress:
        swept = sweep(tasks, store, progress=progress)
    found = reproduction.collect(size, swept.outcomes)
    shifts = SHIFTS.format(one=ONE) + _shifts(found)
    parts = [INTRODUCTION, "## Claims\n", _claims(found), shifts, OPEN, "## Figures\n"]
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


def _shifts(found):
    rows = []
    for lossy in found.losses:
        ratio = lossy.predicted.conditions.ratios[STIFFNESS]
        modulus = f"{ratio.min():.2f} to {ratio.max():.2f}"
        numbers = paper_losses.exponents(lossy)
        laws = [_number(numbers[name]) for name in ("expected", SHORTEST, EVERY, WITH_SMOOTH)]
        simulated = [
            f"{_number(numbers[name])} ({_number(numbers[f'{name}, low'])} to {_number(numbers[f'{name}, high'])})"
            if np.isfinite(numbers[name])
            else "undecided"
            for name in ("simulated", "simulated less smooth body")
        ]
        collapses = [each.collapse.verdict for each in (lossy.whole, lossy.rough)]
        shifts = (cell for pair in zip(collapses, simulated, strict=True) for cell in pair)
        rows.append((lossy.loss.symbols, modulus, *laws, *shifts))
    heading = (
        "rubber|G(v/a) over G₀|expected|Eq. 22, shortest wave|Eq. 22, every wave|every wave and smooth body|"
        "simulated: collapse|exponent|less smooth body: collapse|exponent"
    )
    return table(heading, rows) + "\n"


def _number(value):
    return f"{value:.4f}" if np.isfinite(value) else "undecided"


def _cost(found, campaign, seconds):
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 2**20
    contact, passes = _per_contact()
    return (
        f"Fig. 3: {found.collapse.samples.size} contacts under a prescribed load, {found.collapse.sweeps:.2f} "
        f"sweeps each, profiles included, in {seconds[1]:.0f} s of processor time, the start of workers included, "
        f"and {_clock(*seconds)}; the largest worker took {peak:.2f} GiB.\n"
        "N is 5000 but in the study of Δx, where it runs from 1000 to 100000 on the same length, and which takes "
        f"most of the time. In one process a contact takes {1e3 * contact:.2f} ms of the processor, as long as it "
        f"takes to read the heights of its profile {passes:.0f} times from memory. Side by side on the study of "
        f"the load, H = 0.4, {len(SIDE_BY_SIDE)} profiles: {_ratio():.0f} times less processor time than `MDR` "
        "one contact at a time.\n"
    )


def _clock(wall, used):
    """What the clock said, and whether other work kept the processors from this one."""
    count = os.cpu_count() or 1
    disturbed = ", disturbed by other work" if count * wall > ALONE * used else ""
    return f"{wall:.0f} s of the clock on {count} processors{disturbed}"


def _of_workers():
    """Processor time of the workers that have ended [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _per_contact():
    """Processor time of a contact of Fig. 3 [s], and over that of a plain pass over its nodes, best of three."""
    found = places(Campaign())
    scenes, points = [place.scene for place in found], [place.points for place in found]
    nodes = np.ones(sum(points))
    campaign = min(_seconds(lambda: solve_profiles(scenes, points, TIMED)) for _ in range(3)) / len(TIMED)
    return campaign / len(found), campaign / min(_seconds(nodes.sum) for _ in range(3))


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
