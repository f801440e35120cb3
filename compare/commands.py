"""Commands as functions of the same names, arguments and defaults: `crosscheck X` is `compare.X`.

A function that solves returns a `report.Report` and prints nothing: printed, the report is what the command
prints; in a notebook it shows tables, and its `figures`. Interrupted or killed, the same call resumes. As worker
processes are started, a script calls these under `if __name__ == "__main__":`.

What each argument is, `compare.options` says once: for a command as its help, for a function as a line of its
docstring. Functions that solve take those of `solve` too, as `options`.

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
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack, cast

from .options import (
    Baseline,
    CaseSize,
    Channel,
    Draws,
    ExportFormat,
    FilesFolder,
    Folder,
    HeightMap,
    Interval,
    Journal,
    Kind,
    LengthUnit,
    Level,
    LinesAbove,
    LinesBelow,
    LoadsOrDepths,
    Missing,
    Model,
    Models,
    NewFile,
    Options,
    Output,
    OwnScene,
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
    TableColumns,
    TableDecimal,
    TableEncoding,
    TableRows,
    TableSeparator,
    TableUnits,
    Tolerance,
    Update,
    Width,
    WithReport,
    Workers,
    Yes,
    table_form,
)
from .solving.suggest import documented

if TYPE_CHECKING:
    from concurrent.futures import Executor
    from types import FrameType

    import xarray
    from matplotlib.figure import Figure

    from .library.ready import Listing
    from .studies.comparison.comparison import Comparison
    from .studies.comparison.sweep import SweepSeries
    from .studies.plan import Plans
    from .studies.report import Report
    from .studies.study import Study
    from .trustmap.verdict import Advice


@documented
def solve(
    study: Study,
    output: Output,
    *,
    workers: Workers = None,
    scheduler: Scheduler = None,
    executor: Executor | None = None,
    report: WithReport = True,
    yes: Yes = False,
    progress: bool | None = False,
) -> Report:
    """Do a study, one of your own too: solve what the folder has not, judge, and write the page.

    study : an object of a class derived from `compare.Study`
    executor : object with `submit`, as those of concurrent.futures; it gets as many contacts at once as `workers`
    progress : whether the terminal shows how far it is
    """
    from .solving.terminal import Shown
    from .studies import pipeline

    _warn(study.doubts)
    with Shown() if progress else nullcontext() as shown:
        found = pipeline.run(study, output, workers, scheduler, executor, report, yes, shown)
    _warn([" ".join(found.unsolved.sentences)] if found.unsolved.failed else [])
    return found


def _warn(messages: Sequence[str | Warning]) -> None:
    """Warn of each message, Doubtful if it is a text, as from the line that called a function of this module."""
    from scene import Doubtful

    frame: FrameType | None = sys._getframe()
    level = 1
    while frame is not None and frame.f_globals.get("__name__") in (__name__, documented.__module__):
        level, frame = level + 1, frame.f_back
    for each in messages:
        warnings.warn(each, Doubtful, stacklevel=level)


@documented
def run(
    scene: SceneFiles = None,
    output: Output = "crosscheck-report",
    models: Models = None,
    reference: Reference = None,
    interval: Interval = None,
    **options: Unpack[Options],
) -> Report:
    """Solve a scene in 1D and in 3D, compare, and write a report.

    interval : wanted half-width of the intervals of 95 %, relative, as 2%; 5 % of a scene that states no numbers
        of surfaces and profiles, whose place it takes: many are solved on coarse grids, few on finer ones, until
        the intervals of the scene's own friction, depth or force are so narrow. That contact is solved before the
        curves around it; a claim on these that stays open says how many surfaces would decide it
    """
    from .studies.comparison import asked

    return solve(asked.run(scene, models, reference, interval), output, **options)


@documented
def study(
    name: StudyName = None,
    size: StudySize = "quick",
    output: Output = "crosscheck-study",
    models: Models = None,
    reference: Reference = None,
    interval: Interval = None,
    **options: Unpack[Options],
) -> Report | Listing:
    """Test the paper's claims on many contacts in 1D and 3D."""
    if name is None:
        from .library.ready import studies

        return studies()
    from .studies.comparison import asked

    return solve(asked.study(str(name), size, models, reference, interval), output, **options)


@documented
def paper(size: PaperSize = "full", output: Output = "crosscheck-paper", **options: Unpack[Options]) -> Report:
    """Repeat the paper in 1D: figures, parameter studies, claims."""
    from .studies.paper.study import Paper

    return solve(Paper.of(size), output, **options)


@documented
def workprecision(
    scene: SceneFiles = None,
    output: Output = "crosscheck-workprecision",
    models: Models = None,
    **options: Unpack[Options],
) -> Report:
    """Measure what accuracy costs: error against processor time of every model on a scene.

    Timed contacts are solved one by one on this machine.

    models : if absent, 1D as it is and corrected, the 3D law, Persson's theory and 3D, each on its own grids
    """
    from .studies.workprecision.study import WorkPrecision

    return solve(WorkPrecision.of(scene, models), output, **options)


@documented
def stability(
    size: CaseSize = "quick", output: Output = "crosscheck-stability", **options: Unpack[Options]
) -> Report:
    """Solve hard cases and check the law of each. The status is 1 if any case breaks its law."""
    from .studies.checks.study import Checks

    return solve(Checks.stability(size), output, **options)


@documented
def verify(model: Model, output: Output = "crosscheck-verify", **options: Unpack[Options]) -> Report:
    """Check a code of contact against what it must hold. The status is 1 if any law fails."""
    from .studies.checks.study import Checks

    return solve(Checks.verify(model), output, **options)


@documented
def regress(
    baseline: Baseline = None,
    update: Update = False,
    scene: OwnScene = None,
    output: Output = "crosscheck-regress",
    **options: Unpack[Options],
) -> Report:
    """Compare the accuracy of 1D with stored values. The status is 1 if any value has changed."""
    from .studies.checks.accuracy import OwnScene
    from .studies.checks.study import Regress

    asked = Regress.of(baseline, update) if scene is None else OwnScene.stored(scene, baseline, update)
    report = solve(asked, output, **options)
    if update:
        asked.store(report.judged)
    return report


@documented
def mastercurve(
    table: Table,
    output: Output = "mastercurve",
    tolerance: Tolerance = 0.05,
    c1: ShiftC1 = None,
    c2: ShiftC2 = None,
    reference: ShiftReference = None,
    columns: TableColumns = None,
    units: TableUnits = None,
    where: TableRows = None,
    separator: TableSeparator = None,
    decimal: TableDecimal = None,
    encoding: TableEncoding = None,
    skip: LinesAbove = None,
    rows: LinesBelow = None,
    **options: Unpack[Options],
) -> Report:
    """Shift measured friction curves onto one, if they allow it. The curves are friction against load."""
    from .studies.mastercurve.study import Mastercurve

    form = table_form(
        columns=columns,
        units=units,
        where=where,
        separator=separator,
        decimal=decimal,
        encoding=encoding,
        skip=skip,
        rows=rows,
    )
    study = Mastercurve.of(table, tolerance, c1, c2, reference, **form)
    return solve(study, output, **options)


@documented
def topography(
    file: HeightMap,
    pixel: Pixel = None,
    unit: LengthUnit = None,
    channel: Channel = None,
    missing: Missing = "refuse",
    level: Level = None,
    shortest_kept: ShortestKept = None,
    repeat: Repeat = "mirror",
    peaks: Peaks = "up",
    columns: TableColumns = None,
    units: TableUnits = None,
    where: TableRows = None,
    separator: TableSeparator = None,
    decimal: TableDecimal = None,
    encoding: TableEncoding = None,
    skip: LinesAbove = None,
    rows: LinesBelow = None,
    output: Output = "topography",
    **options: Unpack[Options],
) -> Report:
    """Describe a measured surface: slopes, spectra, exponent H."""
    from .studies.topography.study import Map

    form = table_form(
        columns=columns,
        units=units,
        where=where,
        separator=separator,
        decimal=decimal,
        encoding=encoding,
        skip=skip,
        rows=rows,
    )
    study = Map.of(
        file,
        pixel=pixel,
        unit=unit,
        channel=channel,
        missing=missing,
        level=level,
        shortest_kept=shortest_kept,
        repeat=repeat,
        peaks=peaks,
        **form,
    )
    return solve(study, output, **options)


@documented
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
    **options: Unpack[Options],
) -> xarray.Dataset:
    """Solve a scene at many speeds and loads, in 1D and 3D.

    Returns a Dataset with the dimensions model, level, speed, load or depth, and surface: every single draw with
    its `status` and `reason`, and the means over draws on the fine grid, `friction_coefficient_mean`,
    `normal_force_mean` and `depth_reached_mean`, each with `_low` and `_high` in place of `_mean`: the interval of
    95 % with the scatter of draws and the change on halving the grid.
    `friction_error` bounds what the grid leaves of friction in 95 % of draws; above a tenth UncertainFriction is
    warned.

    interval : in place of draws, the half-width that is wanted of the interval of 95 % of each mean, relative:
        0.02 or "2%". Many surfaces are then solved on coarse grids and few on finer ones, until every interval is
        so narrow; `stratum` tells on which grids. An error of the grid above half of it keeps an interval wider
    """
    from .statistics import griderror

    report = swept(
        output,
        scene=scene,
        speed=speed,
        load=load,
        depth=depth,
        draws=draws,
        models=models,
        reference=reference,
        interval=interval,
        **options,
    )
    _warn(griderror.warnings_of(report.answers))
    return cast("SweepSeries", cast("Comparison", report.study).series[0]).dataset(report.answers)


@documented
def swept(output: Output = "crosscheck-sweep", **given: Any) -> Report:
    """Report of a sweep, of the arguments of `sweep`: the command prints it."""
    from .studies.comparison import asked

    options: Any = {name: given.pop(name) for name in Options.__annotations__ if name in given}
    return solve(asked.sweep(**given), output, **options)


@documented
def friction_plot(dataset: xarray.Dataset) -> Figure:
    """Friction of a sweep against speed, or against load, both models with error bars: a matplotlib Figure."""
    from .studies.comparison.plots import figure_of

    return figure_of(dataset)


@documented
def trust(scene: SceneFile) -> Advice:
    """Say which cheap answer to use, or to solve in 3D. It takes about a second, as nothing rough is solved."""
    from .library.lookup import case_of
    from .trustmap.verdict import trust

    found = trust(case_of(scene).scene)
    _warn([str(each) for each in found.doubts])
    return found


@documented
def plan(scene: SceneFile) -> Plans:
    """Say what a scene costs and what is simulated of it. The status is 2 if no solver can solve it."""
    from .studies.plan import plans

    found = plans(scene)
    _warn(found.doubts)
    return found


@documented
def load(folder: Folder) -> xarray.DataTree:
    """Everything that a command solved, with each single draw: a Dataset for each parameter grid and solver."""
    from .solving import netcdf

    return netcdf.load(folder)


def scenes() -> Listing:
    """List the scenes and studies that come with the package."""
    from .library.ready import offered

    return offered()


@documented
def new(name: ReadyName, file: NewFile = None) -> Path:
    """Copy a ready scene or study into a file of your own."""
    from .library.ready import write

    return write(name, file or f"{name}.toml")


@documented
def schema(kind: Kind = "scene", output: SchemaFile = None) -> dict[str, Any]:
    """Print the JSON schema of scenes, studies or answers."""
    from .studies.schema import schema

    return schema(kind, output)


def as_json(found: Any) -> str:
    """JSON of what a command returns, as its option --json prints it: see `schema` of answers."""
    from .studies.answers import written

    return written(found)


@documented
def export(
    folder: Folder,
    format: ExportFormat = None,
    journal: Journal = None,
    style: Style = None,
    width: Width = None,
    output: FilesFolder = None,
) -> list[Path]:
    """Write surfaces for ParaView, figures for a journal. Nothing is solved."""
    from .report.export import export

    return export(folder, format, journal, style, width, output)


@documented
def draw(scene: SceneFile, output: Output = "crosscheck-draw", **options: Unpack[Options]) -> Report:
    """Draw the contact in 3D and the row of elements in 1D.

    A map of the pressure in 3D, the force per length of both models, and a section of each with its wake. Of a
    program also forces and depth in time.
    """
    from .studies.draw import Drawing

    return solve(Drawing.of(scene), output, **options)
