"""Commands as functions of the same names, arguments and defaults: `crosscheck X` is `compare.X`.

A function that solves returns a `report.Report` and prints nothing: printed, the report is what the command
prints; in a notebook it shows tables, and its `figures`. Interrupted or killed, the same call resumes. As worker
processes are started, a script calls these under `if __name__ == "__main__":`.

The types of arguments are in `compare.options`, with the help of the command. Options of all functions that solve:

output : folder for the page, the figures and the solved contacts
workers : number of processes; if absent, one for each processor
scheduler : address of a dask.distributed scheduler, as tcp://host:8786; its workers then solve the contacts
executor : object with `submit`, as those of concurrent.futures, that gets as many contacts at once as `workers`
figure_format : file formats of the figures, separated by commas: png, pdf, svg. A PNG is always written
report : write the page and its figures. Findings, tables and results are written in any case
yes : agree to a study of more than a day or of more than 300,000 contacts
progress : whether the terminal shows how far it is

Each warns Doubtful of what is doubtful of a scene before it solves, of contacts without an answer after it: what
stands before the answer on the page and on a terminal.

Each raises InvalidInput or Refused before anything is solved where what is asked for cannot be, and OSError where
the folder cannot be written.
"""

# Nothing is imported before a command needs it: `crosscheck --help` answers at once.
from __future__ import annotations

import sys
import warnings
from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack, cast

from .options import (
    Baseline,
    Budget,
    CaseSize,
    Channel,
    Crop,
    Diagram,
    DiagramSize,
    Draws,
    ExportFormat,
    FigureFormat,
    FilesFolder,
    Folder,
    HeightMap,
    Interval,
    Journal,
    Kind,
    LengthUnit,
    Level,
    LoadsOrDepths,
    Missing,
    Model,
    Models,
    ModulusFigure,
    NewFile,
    Options,
    Outliers,
    Output,
    PaperSize,
    Peaks,
    Pixel,
    ReadyName,
    Reference,
    Repeat,
    SceneFile,
    SceneFiles,
    Scheduler,
    SchemaFile,
    ShiftC1,
    ShiftC2,
    ShiftReference,
    ShortestKept,
    Speeds,
    StudyName,
    StudySize,
    Style,
    Table,
    Tolerance,
    Update,
    Width,
    WithReport,
    Workers,
    Yes,
)
from .solving.suggest import checked

if TYPE_CHECKING:
    from concurrent.futures import Executor
    from types import FrameType

    import xarray
    from matplotlib.figure import Figure

    from .library.ready import Listing
    from .solving.terminal import Shown
    from .studies.plan import Plans
    from .studies.regress.quantity import Quantity
    from .studies.report import Report
    from .studies.study import Study
    from .studies.sweep.study import Sweep
    from .trustmap.verdict import Advice


@checked
def solve(
    study: Study,
    output: Output,
    *,
    workers: Workers = None,
    scheduler: Scheduler = None,
    executor: Executor | None = None,
    figure_format: FigureFormat = "png",
    report: WithReport = True,
    yes: Yes = False,
    budget: Budget = None,
    progress: bool | str | Shown | None = False,
) -> Report:
    """Do a study, one of your own too: solve what the folder has not, judge, and write the page.

    study : an object of a class derived from `compare.Study`
    budget : time after which no more surfaces are asked for, of a study that asks for them: in seconds, or "10min"
    """
    from scene.printable import brief
    from scene.reading import InvalidInput

    from .studies import pipeline
    from .studies.study import Study

    if not isinstance(study, Study):
        raise InvalidInput(f"study = {brief(repr(study))}: an object of a class derived from Study is needed")
    _warn(study.doubts)
    with _shown(progress) as shown:
        found = pipeline.run(
            study, output, workers, scheduler, executor, figure_format, report, yes, budget, shown
        )
    _warn([" ".join(found.unsolved.sentences)] if found.unsolved.failed else [])
    return found


def _shown(progress: bool | str | Shown | None) -> AbstractContextManager[Shown | None]:
    """What shows how far a run is; None where nothing is to be shown. One that is given is ended by its giver."""
    if not progress:
        return nullcontext()
    from .solving.terminal import Shown

    return nullcontext(progress) if isinstance(progress, Shown) else Shown(lines=progress == "lines")


def _warn(messages: Sequence[str | Warning]) -> None:
    """Warn of each message, Doubtful if it is a text, as from the line that called a function of this module.

    Each function is called by `checked`, whose frames are passed over too.
    """
    from scene import Doubtful

    frame: FrameType | None = sys._getframe()
    level = 1
    while frame is not None and frame.f_globals.get("__name__") in (__name__, checked.__module__):
        level, frame = level + 1, frame.f_back
    for each in messages:
        warnings.warn(each, Doubtful, stacklevel=level)


@checked
def run(
    scene: SceneFiles = None,
    output: Output = "crosscheck-report",
    models: Models = None,
    reference: Reference = None,
    interval: Interval = None,
    budget: Budget = None,
    **options: Unpack[Options],
) -> Report:
    """Solve a scene in 1D and in 3D, compare, and write a report.

    scene : file of a scene (TOML), or name of a ready scene, or several, which the page then has side by side; if
        absent, the paper's sphere and cone. From Python also a Scene or a Case, or several by name
    models : names of the models, separated by commas: mdr, bem, persson, law, those of installed packages,
        MODULE:NAME; mdr,bem if absent. From Python also objects, see `scene.Solver`
    reference : name of the model against which the others are judged; bem, or the last, if absent
    interval : wanted half-width of the intervals of 95 %, relative, as 2%. It takes the place of the numbers of
        surfaces and profiles: many are solved on coarse grids, few on finer ones, until every claim is decided or
        its interval is so narrow, and so are those of the scene's own friction, depth or force
    budget : time after which no more surfaces are asked for, as 10min. It alone makes results depend on the
        speed of the machine
    """
    from .studies.run.study import Run

    return solve(Run.of(scene, models, reference, interval), output, budget=budget, **options)


@checked
def study(
    name: StudyName = None,
    size: StudySize = "quick",
    output: Output = "crosscheck-study",
    models: Models = None,
    reference: Reference = None,
    interval: Interval = None,
    budget: Budget = None,
    **options: Unpack[Options],
) -> Report | Listing:
    """Test the paper's claims on many contacts in 1D and 3D.

    name : name of a study, or file of your own study (TOML); if absent, a table of the studies is printed
    size : how much is solved: quick (minutes), standard (up to an hour) or full (up to a day)
    models, reference, interval, budget : like those of `run`
    """
    if name is None:
        from .library.ready import studies

        return studies()
    from .studies.claims.study import ClaimStudy

    return solve(ClaimStudy.of(str(name), size, models, reference, interval), output, budget=budget, **options)


@checked
def paper(size: PaperSize = "full", output: Output = "crosscheck-paper", **options: Unpack[Options]) -> Report:
    """Repeat the paper in 1D: figures, parameter studies, claims.

    size : how many rough profiles are averaged: quick (20), standard (50) or full (200, as published)
    """
    from .studies.paper.study import Paper

    return solve(Paper.of(size), output, **options)


@checked
def workprecision(
    name: Diagram = None,
    size: DiagramSize = "quick",
    output: Output = "crosscheck-workprecision",
    models: Models = None,
    **options: Unpack[Options],
) -> Report | Listing:
    """Measure the error and the time of both solvers. Timed contacts are solved one by one on this machine.

    name : name of a diagram, or all; if absent, a table of the diagrams is printed
    size : how much is solved: quick (a minute a diagram), standard or full (hours)
    models : names of other models that the diagram `models` measures on smooth bodies, separated by commas. From
        Python also objects, see `scene.Solver`
    """
    if name is None:
        from .library.ready import diagrams

        return diagrams()
    from .studies.workprecision.study import WorkPrecision

    return solve(WorkPrecision.of([name], size, models), output, **options)


@checked
def stability(
    size: CaseSize = "quick", output: Output = "crosscheck-stability", **options: Unpack[Options]
) -> Report:
    """Solve hard cases and check the law of each. The status is 1 if any case breaks its law.

    size : how much is solved: quick (half a minute), standard or full (some minutes)
    """
    from .studies.stability.study import Stability

    return solve(Stability.of(size), output, **options)


@checked
def verify(model: Model, output: Output = "crosscheck-verify", **options: Unpack[Options]) -> Report:
    """Check a code of contact against what it must hold. The status is 1 if any law fails.

    model : name of a model, mdr or bem, or module:NAME of one of your own. From Python also the model itself
    """
    from .studies.verify.study import Verify

    return solve(Verify.of(model), output, **options)


@checked
def regress(
    baseline: Baseline = None,
    update: Update = False,
    quantities: Sequence[Quantity] | None = None,
    output: Output = "crosscheck-regress",
    **options: Unpack[Options],
) -> Report:
    """Compare the accuracy of 1D with stored values. The status is 1 if any value has changed.

    baseline : file of stored values (TOML); if absent, the values that come with the package
    update : store the values that have changed
    quantities : quantities to measure; if absent, those of the package
    """
    from .studies.regress.study import Regress

    asked = Regress.of(baseline, quantities, update)
    report = solve(asked, output, **options)
    if update:
        asked.store(report.findings)
    return report


@checked
def mastercurve(
    table: Table,
    output: Output = "mastercurve",
    tolerance: Tolerance = 0.05,
    c1: ShiftC1 = None,
    c2: ShiftC2 = None,
    reference: ShiftReference = None,
    **options: Unpack[Options],
) -> Report:
    """Shift measured friction curves onto one, if they allow it. The curves are friction against load.

    table : CSV file, a measurement a line: friction mu, normal force F_N [N], speed v [m/s]. A heading may give
        another order and other units, as F_N [mN]; friction force F_T in place of mu; temperature T [degC]. From
        Python also a DataFrame, a Dataset of xarray, or arrays by the names of the columns
    tolerance : loads that differ by less, relative, are one load, and so are speeds; their lines are repeats
    c1 : constant of WLF, by which temperatures are shifted along the speed; if absent, the shifts are found
    c2 : constant of WLF, as "101.6 K"
    reference : temperature at which c1 and c2 are stated, as "20 degC"
    """
    from .studies.mastercurve.study import Mastercurve

    stated = {"c1": c1, "c2": c2, "reference": reference}
    return solve(Mastercurve.of(table, tolerance, **stated), output, **options)


@checked
def topography(
    file: HeightMap,
    pixel: Pixel = None,
    unit: LengthUnit = None,
    channel: Channel = None,
    crop: Crop = None,
    outliers: Outliers = None,
    missing: Missing = "refuse",
    level: Level = None,
    shortest_kept: ShortestKept = None,
    repeat: Repeat = "mirror",
    peaks: Peaks = "up",
    output: Output = "topography",
    **options: Unpack[Options],
) -> Report:
    """Describe a measured surface: slopes, spectra, exponent H.

    file : map of heights: .npy, .npz, .csv, .txt, .tsv, .xyz, or any format that SurfaceTopography reads. From
        Python also heights [m] as rows, an array, a DataFrame or an object of xarray
    pixel : side of a pixel with its unit, as "1 um". Give it twice, along x and along y, if the sides differ.
        Needed if the file states none. From Python also a number [m]
    unit : unit of the heights: m, mm, um or nm. Needed if the file states none
    channel : name of the map to take, of a file that holds several
    crop : part to keep: give it four times, x from, x to, y from, y to, as "10 um", from the corner of the map
    outliers : heights so many robust standard deviations off the median around them are filled in, 3 or more
    missing : fill fills in missing heights, at most 5 % of the pixels; refuse, the default, makes them an error
    level : what is subtracted first: mean, tilt (a plane), curvature (a form of second degree) or cubic (of
        third); if absent, tilt, and mean of a periodic map
    shortest_kept : leave out waves shorter than this, as "5 um"
    repeat : how the map continues beyond its sides: mirror or periodic
    peaks : up if the heights grow towards the elastomer, down if they grow away from it
    """
    from .studies.topography.study import Map

    asked = {"unit": unit, "channel": channel, "crop": crop, "outliers": outliers, "missing": missing}
    done = {"level": level, "shortest_kept": shortest_kept, "repeat": repeat, "peaks": peaks}
    return solve(Map.of(file, pixel=pixel, **asked, **done), output, **options)


@checked
def sweep(
    scene: SceneFile,
    speed: Speeds = None,
    load: LoadsOrDepths = None,
    depth: LoadsOrDepths = None,
    draws: Draws = None,
    output: Output = "crosscheck-sweep",
    models: Models = None,
    reference: Reference = None,
    interval: Interval = None,
    budget: Budget = None,
    **options: Unpack[Options],
) -> xarray.Dataset:
    """Solve a scene at many speeds and loads, in 1D and 3D.

    Returns a Dataset with the dimensions solver, grid, speed, load or depth, and seed: every single draw with its
    `status` and `reason`, and the means over draws on the fine grid, `friction_coefficient_mean`,
    `normal_force_mean` and `depth_reached_mean`, each with `_low` and `_high` in place of `_mean`: the interval of
    95 % with the scatter of draws and the change on halving the grid.
    `friction_error` bounds what the grid leaves of friction in 95 % of draws; above a tenth UncertainFriction is
    warned.

    scene : file of a scene (TOML), or name of a ready scene. From Python also a Scene or a Case
    speed : speeds, as "1mm/s,10mm/s", or a range of three to a decade, as "1mm/s..1m/s", or of seven in all, as
        "1mm/s..1m/s:7"; "0 m/s" is rest. That of the scene if absent. From Python also numbers [m/s]
    load, depth : likewise, as "0.1N..10N" or "10um..100um"; those of the scene if both are absent. From Python
        also numbers [N], [m]
    draws : rough surfaces, and as many profiles; 8 if absent
    interval : in place of draws, the half-width that is wanted of the interval of 95 % of each mean, relative:
        0.02 or "2%". Many surfaces are then solved on coarse grids and few on finer ones, until every interval is
        so narrow; `stratum` tells on which grids. An error of the grid above half of it keeps an interval wider
    models, reference, budget : like those of `run`
    """
    from .statistics import griderror

    asked = {"scene": scene, "speed": speed, "load": load, "depth": depth, "draws": draws}
    compared = {"models": models, "reference": reference, "interval": interval}
    report = swept(output, budget, **asked, **compared, **options)
    _warn(griderror.warnings_of(report.answers))
    return cast("Sweep", report.study).dataset(report.answers)


@checked
def swept(output: Output = "crosscheck-sweep", budget: Budget = None, **given: Any) -> Report:
    """Report of a sweep, of the arguments of `sweep`: the command prints it."""
    from .studies.sweep.study import Sweep

    options: Any = {name: given.pop(name) for name in Options.__annotations__ if name in given}
    return solve(Sweep.of(**given), output, budget=budget, **options)


@checked
def friction_plot(dataset: xarray.Dataset) -> Figure:
    """Friction of a sweep against speed, or against load, both models with error bars: a matplotlib Figure."""
    from .studies.sweep.study import figure_of

    return figure_of(dataset)


@checked
def trust(scene: SceneFile) -> Advice:
    """Say which cheap answer to use, or to solve in 3D. It takes about a second, as nothing rough is solved.

    scene : file of a scene (TOML), or name of a ready scene. From Python also a Scene or a Case
    """
    from .library.lookup import case_of
    from .trustmap.verdict import trust

    found = trust(case_of(scene).scene)
    _warn([str(each) for each in found.doubts])
    return found


@checked
def plan(scene: SceneFile, figure: ModulusFigure = None) -> Plans:
    """Say what a scene costs and what is simulated of it. The status is 2 if no solver can solve it.

    scene : file of a scene (TOML), or name of a ready scene. From Python also a Scene or a Case
    figure : file (.png, .pdf or .svg) into which the shear moduli G', G'' of the solid are drawn; if absent, none
    """
    from .studies.plan import plans

    found = plans(scene)
    _warn(found.doubts)
    if figure is not None:
        found.draw(figure)
    return found


@checked
def load(folder: Folder) -> xarray.DataTree:
    """Everything that a command solved, with each single draw: a Dataset for each parameter grid and solver.

    folder : folder that a command has written, or its results.nc
    """
    from .solving import netcdf

    return netcdf.load(folder)


def scenes() -> Listing:
    """List the scenes and studies that come with the package."""
    from .library.ready import offered

    return offered()


@checked
def new(name: ReadyName, file: NewFile = None) -> Path:
    """Copy a ready scene or study into a file of your own.

    name : ready scene or study, see `crosscheck scenes`
    file : file to write; if absent, NAME.toml. A file that exists is never overwritten
    """
    from .library.ready import write

    return write(name, file or f"{name}.toml")


@checked
def schema(kind: Kind = "scene", output: SchemaFile = None) -> dict[str, Any]:
    """Print the JSON schema of scenes, studies or answers.

    kind : scene or study, by which editors complete and check TOML; answers, the form of what --json prints
    output : file to write beside; if absent, none
    """
    from .studies.schema import schema

    return schema(kind, output)


def as_json(found: Any) -> str:
    """What a command returns, as its option --json prints it: see `schema` of answers."""
    from .studies.answers import written

    return written(found)


@checked
def export(
    folder: Folder,
    format: ExportFormat = None,
    journal: Journal = None,
    style: Style = None,
    width: Width = None,
    output: FilesFolder = None,
) -> list[Path]:
    """Write tables, surfaces for ParaView, figures for a journal. Nothing is solved.

    folder : folder that a command has written, or its results.nc
    format : file formats, separated by commas: csv (every digit, units in the heading), vtk (surfaces for
        ParaView, which takes the extra vtk), png, pdf, svg (figures). If absent, csv; with a journal, a style or a
        width, png,pdf,svg
    journal : journal or publisher that sets column widths, smallest text and thinnest lines of figures: default,
        acs, aip, aps, elsevier, ieee, iop, nature, royal-society, sage, springer, taylor-francis, wiley
    style : your own matplotlib style: a .mplstyle file or the name of a style. From Python also settings
    width : width of a column, as 84mm, from 80 mm to 200 mm; figures across the page grow or shrink with it. That
        of the journal if absent. From Python also a number [m]
    output : folder for the files; if absent, `tables` and `figures` in the folder
    """
    from .report.export import export

    return export(folder, format, journal, style, width, output)


@checked
def draw(scene: SceneFile, output: Output = "crosscheck-draw", **options: Unpack[Options]) -> Report:
    """Draw the contact in 3D and the row of springs in 1D.

    The surface of the elastomer is coloured by pressure, with its wake; beside it stand the forces of both models.
    Of a program a second figure shows the forces in time and the contact at a few instants.

    scene : scene as TOML, or the name of a ready one. From Python also a Scene or a Case
    """
    from .studies.draw.study import Drawing

    return solve(Drawing.of(scene), output, **options)
