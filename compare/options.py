"""Arguments and options of the commands, each with its type, its help and what Python takes besides.

At run time a type is what a command line gives; a type checker sees all that Python takes. The docstrings of the
functions get these texts by `solving.suggest.documented`.
"""

from collections.abc import Mapping
from glob import glob
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypedDict

from typer import Argument, BadParameter, Option

from .library import ready as library

if TYPE_CHECKING:
    from collections.abc import Sequence
    from concurrent.futures import Executor

    from .library.lookup import SceneLike, SeveralScenes
    from .models.table import ModelLike
    from .studies.comparison.sweep import Values
    from .studies.mastercurve.measurements import Measurements
    from .studies.topography.study import Surface

    File = str | Path
    Amount = str | float
    Sides = str | float | Sequence[str | float]
    SeveralModels = Sequence[ModelLike]
    StyleLike = str | PathLike | Mapping[str, Any]
    Named = Mapping[str, Any] | Sequence[str]
else:
    File = Path
    SceneLike = ModelLike = Measurements = Surface = Amount = StyleLike = str
    Values = Sides = SeveralModels = SeveralScenes = Named = list[str]


def scenes() -> list[str]:
    """Ready scenes, and files of this folder that may be scenes: a shell completes them."""
    return [*(name for name, each in library.ready().items() if each.kind == "scene"), *sorted(glob("*.toml"))]


def studies() -> list[str]:
    """Studies, and files of this folder that may be studies: a shell completes them."""
    return [*library.studies(), "all", *sorted(glob("*.toml"))]


def copies() -> list[str]:
    """Ready scenes and studies: a shell completes them."""
    return [*library.ready()]


def number(given: str | float) -> float:
    """Number of a text on the command line, or of a default; one without a point stays whole."""
    try:
        return int(given) if str(given).isdecimal() else float(given)
    except ValueError:
        raise BadParameter(f"{given!r} is not a number.") from None


def table_form(**options: Any) -> dict[str, Any]:
    """Options on the form of a table, lists of texts as mu=3 as a mapping. Raises InvalidInput."""
    from scene.files.reading import InvalidInput

    found: dict[str, Any] = {}
    for option, given in options.items():
        if not isinstance(given, list | tuple):
            found[option] = given
            continue
        pairs = [str(each).partition("=") for each in given]
        if wrong := next(("".join(each) for each in pairs if not (each[0] and each[1])), ""):
            raise InvalidInput(f"{option} = {wrong}: a name and a value are needed, as mu=3")
        found[option] = {name: int(value) if value.isdecimal() else value for name, _, value in pairs} or None
    return found


# All commands that solve.
Output = Annotated[File, Option(help="Folder for the page, the figures and the solved contacts.")]
Workers = Annotated[
    int | None, Option(help="Number of processes; if absent, one for each processor.", parser=number)
]
Scheduler = Annotated[
    str | None,
    Option(
        help="Address of a dask.distributed scheduler, as tcp://host:8786; its workers then solve the contacts."
    ),
]
WithReport = Annotated[
    bool,
    Option(help="Write the page and its figures. Findings, tables and results are written in any case."),
]
Yes = Annotated[
    bool, Option("--yes", help="Agree to a study of more than a day or of more than 300,000 contacts.")
]


class Options(TypedDict, total=False):
    """Options of every command that solves: those of `compare.solve`."""

    workers: Workers
    scheduler: Scheduler
    executor: "Executor | None"
    report: WithReport
    yes: Yes
    progress: bool | None


# Scenes and models.
SceneFile = Annotated[
    SceneLike,
    Argument(help="File of a scene (TOML), or name of a ready scene.", autocompletion=scenes),
    "From Python also a Scene or a Case.",
]
SceneFiles = Annotated[
    SeveralScenes | None,
    Argument(
        help="File of a scene (TOML), or name of a ready scene, or several, which the page then has side by side;"
        " if absent, the paper's sphere and cone.",
        autocompletion=scenes,
    ),
    "From Python also a Scene or a Case, or several by name.",
]
Model = Annotated[
    ModelLike,
    Argument(help="Name of a model, mdr or bem, or module:NAME of your own model."),
    "From Python also the model itself.",
]
Models = Annotated[
    SeveralModels | None,
    Option(
        help="Names of the models, separated by commas: mdr, bem, persson, law, extended, those of installed"
        " packages, MODULE:NAME; mdr,bem if absent."
    ),
    "From Python also objects, see `scene.Solver`.",
]
Reference = Annotated[
    str | None,
    Option(help="Name of the model against which the others are judged; bem, or the last, if absent."),
]

# How much is solved.
Size = Literal["quick", "standard", "full"]
StudySize = Annotated[
    Size,
    Option(help="How much is solved: quick (minutes), standard (up to an hour) or full (up to a day)."),
]
PaperSize = Annotated[
    Size,
    Option(help="How many rough profiles are averaged: quick (20), standard (50) or full (200, as published)."),
]
CaseSize = Annotated[
    Size, Option(help="How much is solved: quick (half a minute), standard or full (some minutes).")
]
Interval = Annotated[
    Amount | None,
    Option(
        help="Wanted half-width of the intervals of 95 %, relative, as 2%. It takes the place of numbers of"
        " surfaces and profiles: many are solved on coarse grids, few on finer ones, until intervals are that"
        " narrow. In run these are of the scene's own contact, in study of every claim that is not decided before."
    ),
    "From Python also a number, as 0.02.",
]
Speeds = Annotated[
    Values | None,
    Option(
        help='Speeds, as "1mm/s,10mm/s", or a range of three to a decade, as "1mm/s..1m/s", or of seven in all, as'
        ' "1mm/s..1m/s:7"; "0 m/s" is rest. The speed of the scene if absent.'
    ),
    "From Python also numbers [m/s].",
]
LoadsOrDepths = Annotated[
    Values | None,
    Option(help='Likewise, as "0.1N..10N" or "10um..100um"; those of the scene if load and depth are absent.'),
    "From Python also numbers [N], [m].",
]
Draws = Annotated[int | None, Option(help="Rough surfaces, and as many profiles; 8 if absent.", parser=number)]

# Studies and stored values.
StudyName = Annotated[
    File | None,
    Argument(
        help="Name of a study, or file of your own study (TOML); if absent, a table of the studies is printed.",
        autocompletion=studies,
    ),
]
Baseline = Annotated[
    File | None,
    Option(help="File of stored values (TOML); if absent, the values that come with the package."),
]
OwnScene = Annotated[
    SceneLike | None,
    Argument(
        help="File of a scene (TOML) of your own, whose ratios --baseline has; if absent, those of the package."
    ),
    "From Python also a Scene or a Case.",
]
Update = Annotated[bool, Option("--update", help="Store the values that have changed.")]

# Measured tables and surfaces.
Table = Annotated[
    Measurements,
    Argument(
        help="Text file, a measurement a line below a heading with units: friction mu or friction force F_T [N],"
        " normal force F_N [N], speed v [m/s], and temperature T [degC] if there is one."
    ),
    "From Python also a DataFrame, a Dataset of xarray, or arrays by the names of the columns.",
]
Tolerance = Annotated[
    float,
    Option(
        help="Loads that differ by less, relative, are one load, and so are speeds; their lines are repeats.",
        parser=number,
    ),
]
ShiftC1 = Annotated[
    float | None,
    Option(
        help="Constant of WLF, by which temperatures are shifted along the speed; if absent, shifts are found.",
        parser=number,
    ),
]
ShiftC2 = Annotated[Amount | None, Option(help='Constant of WLF, as "101.6 K".')]
ShiftReference = Annotated[Amount | None, Option(help='Temperature at which c1 and c2 are stated, as "20 degC".')]
# What differs of a table from the documented form.
TableColumns = Annotated[
    Named | None,
    Option(
        help='Heading of a column by its name, as mu="Friction (mean)", or its number, as mu=3, of a table without'
        " a heading; once for each column."
    ),
    "From Python a mapping.",
]
TableUnits = Annotated[
    Named | None,
    Option(help="Unit of a column by its name, as v=mm/s, if the heading has none; once for each column."),
    "From Python a mapping.",
]
TableRows = Annotated[
    Named | None,
    Option(help='Value in a column, of the rows that are read, as sample=NR; "*" for rows of any value.'),
    "From Python a mapping.",
]
TableSeparator = Annotated[
    str | None, Option(help="What separates the cells of a table: tab, semicolon, comma or blanks.")
]
TableDecimal = Annotated[str | None, Option(help='Decimal mark of a table, "." or ",".')]
TableEncoding = Annotated[str | None, Option(help="Encoding of a table, as cp1252.")]
LinesAbove = Annotated[int | None, Option(help="Lines above the heading or the numbers.", parser=number)]
LinesBelow = Annotated[int | None, Option(help="Rows that are read below them.", parser=number)]
HeightMap = Annotated[
    Surface,
    Argument(
        help="Map of heights: .npy, .npz, .nc, .txt, .csv, .tsv, .xyz, or a format that SurfaceTopography reads."
    ),
    "From Python also heights [m] as rows, an array, a DataFrame or an object of xarray.",
]
Pixel = Annotated[
    Sides | None,
    Option(
        help='Side of a pixel with its unit, as "1 um". Give it twice, along x and along y, if the sides differ.'
        " Needed if the file states none."
    ),
    "From Python also a number [m].",
]
LengthUnit = Annotated[str | None, Option(help="Unit of the heights, as um. Needed if the file states none.")]
Channel = Annotated[str | None, Option(help="Name of the map to take, of a file that holds several.")]
Missing = Annotated[
    Literal["refuse", "fill"],
    Option(help="fill fills in missing heights, at most 5 % of the pixels; refuse makes them an error."),
]
Level = Annotated[
    Literal["mean", "tilt", "curvature", "cubic"] | None,
    Option(
        help="What is subtracted first: mean, tilt (a plane), curvature (a form of second degree) or cubic (of"
        " third); if absent, tilt, and mean of a periodic map."
    ),
]
ShortestKept = Annotated[Amount | None, Option(help='Leave out waves shorter than this, as "5 um".')]
Repeat = Annotated[
    Literal["mirror", "periodic"],
    Option(help="How the map continues beyond its sides."),
]
Peaks = Annotated[
    Literal["up", "down"],
    Option(help="up if the heights grow towards the elastomer, down if they grow away from it."),
]

# Files that are read and written.
Folder = Annotated[File, Argument(help="Folder that a command has written, or its results.nc for export.")]
ReadyName = Annotated[
    str,
    Argument(help="Ready scene or study, see crosscheck scenes.", autocompletion=copies),
]
NewFile = Annotated[
    File | None,
    Argument(help="File to write; if absent, NAME.toml. A file that exists is never overwritten."),
]
Kind = Annotated[
    Literal["scene", "study", "answers"],
    Argument(
        help="scene or study, by which editors complete and check TOML; answers, the form of what --json prints."
    ),
]
SchemaFile = Annotated[File | None, Option(help="File to write as well; if absent, none.")]
Journal = Annotated[
    Literal[
        "default",
        "acs",
        "aip",
        "aps",
        "elsevier",
        "ieee",
        "iop",
        "nature",
        "royal-society",
        "springer",
        "wiley",
    ]
    | None,
    Option(help="Journal or publisher that sets column widths, smallest text and thinnest lines."),
]
Style = Annotated[
    StyleLike | None,
    Option(help="Your own matplotlib style: a .mplstyle file or the name of a style."),
    "From Python also settings.",
]
Width = Annotated[
    Amount | None,
    Option(
        help="Width of a column, as 84mm, from 80 mm to 200 mm; figures across the page grow or shrink with it."
        " The width in the journal if absent."
    ),
    "From Python also a number [m].",
]
ExportFormat = Annotated[
    str | None,
    Option(
        help="File formats, separated by commas: png, pdf, svg (figures), vtk (surfaces for ParaView; it takes the"
        " extra vtk). If absent, png,pdf,svg."
    ),
]
FilesFolder = Annotated[File | None, Option(help="Folder for the files; if absent, `figures` in the folder.")]
