"""Commands as functions of the same names, arguments and defaults: `crosscheck X` is `compare.X`.

A function that solves returns a `report.Report` and prints nothing: printed, the report is what the command
prints; in a notebook it shows tables, and its `figures`. Interrupted or killed, the same call resumes. As worker
processes are started, a script calls these under `if __name__ == "__main__":`.

Options of all of them:

output : folder of the page and of what has been solved
workers : processes; as many as processors if absent
scheduler : address of a scheduler of dask.distributed, as tcp://host:8786, whose workers solve then
format : of the page, html, markdown or latex
figures : forms of the figures, separated by commas: png, or png,pdf,svg
report : whether the page and its figures are written; findings and results always are
yes : agree to what takes more than a day
progress : whether the terminal says how far it is

Each raises InvalidInput or Refused before anything is solved where what is asked for cannot be, and OSError where
the folder cannot be written.
"""

# Nothing is imported before a command needs it: `crosscheck --help` answers at once.
from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict, Unpack

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from .declaration import Study
    from .inputs import Asked
    from .library import Listing
    from .planning import Plans
    from .quantity import Quantity
    from .report import Report
    from .studies.trust.verdict import Trust


class Options(TypedDict, total=False):
    """Options of every command that solves, see the module."""

    workers: int | None
    scheduler: str | None
    format: str
    figures: str
    report: bool
    yes: bool
    progress: bool | str


def solve(study: Study, output: str | Path, **options: Unpack[Options]) -> Report:
    """Do a study, one of your own too: solve what the folder has not, judge, and write the page.

    study : an object of a class derived from `compare.Study`
    """
    from . import pipeline
    from .console import watch

    chosen: dict[str, Any] = dict(options)
    progress = chosen.pop("progress", False)
    told = watch(lines=progress == "lines") if progress else None
    return pipeline.run(study, output, watch=told, **chosen)


def run(
    scene: Asked | Mapping[str, Asked] | None = None,
    output: str | Path = "crosscheck-report",
    **options: Unpack[Options],
) -> Report:
    """Solve a scene in one and in three dimensions, compare, and write a report.

    scene : scene as TOML, or the name of a ready one; the paper's sphere and cone if absent. From Python also a
        Scene or a Case, or several by name
    """
    from .studies.run import Run

    return solve(Run.of(scene), output, **options)


def study(
    name: str | Path | None = None,
    size: str = "quick",
    output: str | Path = "crosscheck-study",
    **options: Unpack[Options],
) -> Report | Listing:
    """Ask the claims of the paper of many contacts in one and in three dimensions, and write a page.

    name : study, or a file with one of your own; absent, the studies are listed
    size : how much is solved, quick (minutes), standard (up to an hour) or full (up to a day)
    """
    from .studies.claimstudy import ClaimStudy
    from .studies.trust.study import TrustStudy

    if name is None:
        return ClaimStudy.listing()
    if name == TrustStudy.name:
        return solve(TrustStudy.of(size), output, **options)
    return solve(ClaimStudy.of(str(name), size), output, **options)


def paper(size: str = "full", output: str | Path = "crosscheck-paper", **options: Unpack[Options]) -> Report:
    """Simulate the paper again in one dimension: its figures, its parameter studies, its claims.

    size : how much is solved, quick (20 rough profiles averaged), standard (50) or full (200, as published)
    """
    from .studies.paper.study import Paper

    return solve(Paper.of(size), output, **options)


def workprecision(
    name: str | None = None,
    size: str = "quick",
    output: str | Path = "crosscheck-workprecision",
    **options: Unpack[Options],
) -> Report | Listing:
    """Measure what accuracy costs in time, in one and in three dimensions, and write a page.

    name : diagram, or all of them by the name all; absent, they are listed. What is timed is solved on this
        machine, alone
    size : how much is solved, quick (a minute a diagram), standard or full (up to ten)
    """
    from .studies.workprecision.study import WorkPrecision

    if name is None:
        return WorkPrecision.listing()
    return solve(WorkPrecision.of([name], size), output, **options)


def stability(
    size: str = "quick", output: str | Path = "crosscheck-stability", **options: Unpack[Options]
) -> Report:
    """Solve the named hard cases, and say whether each keeps its law; status 1 if any does not.

    size : how much is solved, quick (half a minute), standard or full (some minutes)
    """
    from .studies.stability import Stability

    return solve(Stability.of(size), output, **options)


def regress(
    baseline: str | Path | None = None,
    update: bool = False,
    quantities: Sequence[Quantity] | None = None,
    output: str | Path = "crosscheck-regress",
    **options: Unpack[Options],
) -> Report:
    """Say whether the accuracy of one dimension has moved from what is stored; status 1 if it has.

    baseline : stored quantities as TOML; those of the package if absent
    update : store what has moved
    quantities : that are measured; those of the package if absent
    """
    from .studies.regress import Regress

    asked = Regress.of(baseline, quantities, update)
    report = solve(asked, output, **options)
    if update:
        asked.store(report.claims)
    return report


def mastercurve(table: str | Path, output: str | Path = "mastercurve", **options: Unpack[Options]) -> Report:
    """Shift measured curves of friction against load onto one, and say whether that works.

    table : CSV of friction mu, normal force F_N [N] and speed v [m/s]
    """
    from .studies.mastercurve import Mastercurve

    return solve(Mastercurve.of(table), output, **options)


def topography(
    file: str | Path,
    pixel: Sequence[float] | None = None,
    unit: str | None = None,
    level: str | None = None,
    repeat: str = "mirror",
    peaks: str = "up",
    output: str | Path = "topography",
    **options: Unpack[Options],
) -> Report:
    """Describe a measured map of heights: size, slopes, spectra, and the self-affine law in them.

    file : map of heights, .npy, .npz, .csv, .txt, or as SurfaceTopography reads it
    pixel : side of a pixel [m], twice, along x and y, where they differ; if the file has none
    unit : of its heights, m, mm, um or nm; if the file has none
    level : taken off first, mean, tilt or curvature; if absent tilt, and mean of what is periodic
    repeat : how the map goes on, mirror or periodic
    peaks : up if heights grow towards the elastomer, down if away from it
    """
    from .studies.topography import Map

    return solve(Map.of(file, pixel=pixel, unit=unit, level=level, repeat=repeat, peaks=peaks), output, **options)


def sweep(
    scene: Asked,
    speed: Sequence[float],
    load: Sequence[float] | None = None,
    depth: Sequence[float] | None = None,
    draws: int = 8,
    output: str | Path = "crosscheck-sweep",
    **options: Unpack[Options],
) -> xarray.Dataset:
    """Solve a scene at every speed and every load or depth in both dimensionalities.

    Returns a Dataset with the dimensions solver, grid, speed, load or depth, and draw: every single draw with its
    `status` and `reason`, and the means over draws on the fine grid, `friction`, `force` and `reached`, each with
    `_low` and `_high`, the interval of 95 % with the scatter of draws and the change on halving the grid.

    speed : [m/s]; 0 is rest
    load, depth : [N], [m]; those of the scene if both are absent
    draws : rough surfaces, and as many profiles
    """
    from .studies.sweep import Sweep

    asked = Sweep.of(scene, speed, load, depth, draws)
    return asked.dataset(solve(asked, output, **options).answers)


def friction_plot(dataset: xarray.Dataset) -> Figure:
    """Friction of a sweep against speed, or against load, both models with error bars: a matplotlib Figure."""
    from .studies.sweep import figure_of

    return figure_of(dataset)


def trust(scene: Asked) -> Trust:
    """Say what the 1D answer to a scene is worth: use it, multiply it, or solve in 3D; nothing rough is solved.

    scene : scene as TOML, or the name of a ready one. From Python also a Scene or a Case
    """
    from .inputs import case_of
    from .studies.trust.verdict import trust

    return trust(case_of(scene).scene)


def plan(scene: Asked) -> Plans:
    """Say what would be simulated of a scene, what that costs, and what is left out; status 2 if no solver can.

    scene : scene as TOML, with or without settings of the solvers, or the name of a ready one. From Python also a
        Scene or a Case
    """
    from .planning import plans

    return plans(scene)


def load(folder: str | Path) -> xarray.DataTree:
    """Everything that a command solved, with each single draw: a Dataset for each rectangle and solver.

    folder : that a command left, or one file of results
    """
    from . import results

    return results.load(folder)


def ready() -> Listing:
    """Scenes and studies to begin with, which come with the package, by name: the command `list`."""
    from .library import ready

    return ready()


def new(name: str, file: str | Path | None = None) -> Path:
    """Write a ready scene or study into a file, to be changed; never over a file that is there.

    name : ready scene or study, see `crosscheck list`
    file : where to; NAME.toml if absent. Never overwritten
    """
    from .library import write

    return write(name, file or f"{name}.toml")


def schema(kind: str = "scene", output: str | Path | None = None) -> dict[str, Any]:
    """Write the JSON schema of scenes or of studies, for editors that complete and check TOML.

    kind : scene or study
    output : file to write; none if absent
    """
    from .json_schema import schema

    return schema(kind, output)


def figures(
    folder: str | Path, journal: str = "default", style: Any = None, output: str | Path | None = None
) -> list[Path]:
    """Draw every figure of a folder again, for a journal or in a style, from its tables; nothing is solved.

    folder : folder that a command left
    journal : whose columns and least sizes; none in particular if default
    style : style of matplotlib of your own, a .mplstyle file or a name. From Python also settings
    output : where to; `figures` in the folder if absent
    """
    from .redraw import redraw

    return redraw(folder, journal, style, output)


def export(folder: str | Path, to: str = "csv", output: str | Path | None = None) -> list[Path]:
    """Write the tables of results into files: CSV with units, or LaTeX for a paper.

    folder : folder that a command left, or a file of results
    to : csv, every digit, or latex, rounded, for booktabs
    output : where to; `tables` in the folder if absent
    """
    from .tables import export

    return export(folder, to, output)


def animate(
    scene: Asked,
    output: str | Path | None = None,
    frames: int = 60,
    seconds: float = 6.0,
    folder: str | Path = "crosscheck-animation",
    workers: int | None = None,
    progress: bool = False,
) -> Path:
    """Draw a scene as it moves in time, in one and in three dimensions side by side.

    scene : scene as TOML, or the name of a ready one. From Python also a Scene or a Case
    output : a .gif, or an .mp4 where ffmpeg is there; the name of the scene with .gif if absent
    frames : how many pictures
    seconds : how long the animation lasts [s]
    folder : folder of what has been solved
    """
    from contextlib import nullcontext

    from .animation import animate
    from .console import watch

    with watch().solving() if progress else nullcontext() as told:
        return animate(scene, output, frames, seconds, folder, workers, told)
