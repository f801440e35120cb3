"""A march through a program as a picture that moves: both dimensionalities side by side, GIF or MP4."""

import errno
import os
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from matplotlib.animation import AbstractMovieWriter, FFMpegWriter, PillowWriter

from bem3d import BEM
from mdr1d import MDR
from scene import Refused, Scene, SolveError
from scene.protocol import refuse
from scene.quantities import SECOND, WHOLE, takes

from ...library.lookup import SceneLike, case_of
from ...report.plots import style
from ...solving.cost import SECONDS
from ...solving.hold import hold
from ...solving.runner import Progress, SweepProgress, sweep
from ...solving.store import Store, make, refuse_impossible, write
from ...solving.task import SceneTask
from ...solving.workers import counted
from ..report import SOLVED
from .figure import MarchFigure
from .film import Film, started

DOTS_PER_INCH = 100
MOST_FRAMES, LONGEST = 10_000, 3600  # frames, and seconds
FASTEST = 50  # frames a second: players show a GIF of more with delays of their own
# An even number of pixels a side, which these colours take, and a file that begins before all of it is loaded.
MP4 = ["-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "+faststart"]


@takes(frames=WHOLE, seconds=SECOND)
def animate(
    scene: SceneLike,
    output: str | Path | None = None,
    frames: int = 60,
    seconds: float = 6.0,
    folder: str | Path = "crosscheck-animation",
    workers: int | None = None,
    progress: Progress | None = None,
) -> Path:
    """March through the program of a scene in one and in three dimensions, write what is seen; returns the path.

    scene : one that slides steadily or is pressed in is begun from an undisturbed elastomer, see `film.started`;
        a solver that refuses it is left out
    output : a .gif, or an .mp4 where ffmpeg is on the path; the name of the scene with .gif if absent
    frames, seconds : instants that are shown, and how long the picture lasts
    folder : of what has been solved: the picture is made again from it

    Raises InvalidInput, Refused where both solvers refuse or no such file can be written, SolveError where a march
    fails.
    """
    path = Path(output or f"{Path(scene).stem if isinstance(scene, str | Path) else 'scene'}.gif")
    case = case_of(scene)
    check(path, frames, seconds)
    counted(workers)
    store, progress = Store(Path(folder) / SOLVED), progress or Progress()
    with hold([Path(folder)], progress.told):
        with progress.solving() as told:
            film = filmed(case.scene, case.mdr, case.bem, frames, store, workers, told)
        with progress.writing(len(film.times)) as drawn:
            record(film, path, seconds, drawn)
    return path


def filmed(
    scene: Scene,
    mdr: MDR,
    bem: BEM,
    frames: int,
    store: Store,
    workers: int | None = None,
    progress: SweepProgress | None = None,
) -> Film:
    """Film of a scene, solved or found in the store. Raises Refused, SolveError."""
    scene = started(scene)
    mdr, bem = replace(mdr, frames=frames), replace(bem, frames=frames)
    tasks, refused = [], []
    for each in (mdr, bem):
        try:
            refuse(each, scene)
            work = (each.plan(scene).seconds.value or 0.0) / SECONDS
            tasks.append(SceneTask(each, (scene,), keeps_fields=True, work=work))
        except Refused as error:
            refused.append(str(error))
    if not tasks:
        raise Refused("neither solver can march through this scene: " + "; ".join(refused))
    outcomes, fields = sweep(tasks, store, workers, progress).outcomes, {}
    for task in tasks:
        if outcomes[task].rows[0].reason:
            raise SolveError(f"{task.solver.name}: {outcomes[task].rows[0].reason}")
        if not outcomes[task].fields:
            raise SolveError(f"{task.solver.name}: nothing touches in the whole program; press deeper")
        fields[task.solver.name] = outcomes[task].fields
    return Film(scene, bem, fields)


def check(path: Path, frames: int, seconds: float) -> None:
    """Raise Refused where nothing could write such a file, OSError where its folder is not there or takes none."""
    if path.suffix.lower() not in (".gif", ".mp4"):
        raise Refused(f"{path.name}: the file needs a name that ends in .gif, or in .mp4 if ffmpeg is on the path")
    if path.suffix.lower() == ".mp4" and not FFMpegWriter.isAvailable():
        raise Refused(f"{path.name}: an .mp4 takes ffmpeg, which is not on the path; install it, or write a .gif")
    if not (1 <= frames <= MOST_FRAMES and 0 < seconds <= LONGEST and frames / seconds <= FASTEST):
        raise Refused(
            f"frames = {frames} in seconds = {seconds:g}: 1 to {MOST_FRAMES} frames in at most {LONGEST} seconds, "
            f"and at most {FASTEST} in a second"
        )
    refuse_impossible(path)
    if not path.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "no such folder", str(path.parent))
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    make(path.parent)


def record(film: Film, path: Path, seconds: float, told: Callable[[str], Any] = str) -> None:
    """Draw every instant of a film in the current look and write the file, whole or not at all.

    told : called with each frame, in words, once it is drawn

    Raises Refused as `check`, SolveError with the words of ffmpeg where it fails.
    """
    check(path, len(film.times), seconds)
    rate: Any = len(film.times) / seconds  # a float does, whatever the stubs say
    gif = path.suffix.lower() == ".gif"
    writer: AbstractMovieWriter = PillowWriter(rate) if gif else FFMpegWriter(rate, extra_args=MP4)
    with style.applied(), tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / path.name
        try:
            _draw(film, writer, made, told)
        except (subprocess.CalledProcessError, BrokenPipeError) as error:
            why = getattr(error, "stderr", None) or str(error)
            raise SolveError(f"ffmpeg wrote no {path.name}: {why.strip()}") from error
        content = made.read_bytes()
    write(path, lambda file: file.write(content))


def _draw(film, writer, path, told):
    """Frames of every instant. Panels are laid out once, as laying out takes as long as all else."""
    shown, last = MarchFigure(film), len(film.times) - 1
    shown.drawing.set_dpi(DOTS_PER_INCH)
    shown.show(last)
    shown.drawing.draw_without_rendering()
    shown.drawing.draw_without_rendering()
    shown.drawing.set_layout_engine("none")
    with writer.saving(shown.drawing, str(path), DOTS_PER_INCH):
        for k in range(last + 1):
            shown.show(k)
            writer.grab_frame()
            told(f"frame {k + 1} of {last + 1}")
