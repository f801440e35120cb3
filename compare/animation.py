"""A march through a program as a picture that moves: both dimensionalities side by side, GIF or MP4."""

import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from bem3d import BEM
from mdr1d import MDR
from scene import Refused, Scene, SolveError, Solver

from .cases import Case
from .figures import marching
from .plots import style
from .film import Film, started
from .progress import Progress
from .store import Store, write
from .study import Task

DOTS_PER_INCH = 100
FASTEST = 50  # frames a second: players show a GIF of more with delays of their own
TICK = 10  # of a GIF [ms]
COLOURS, PALETTE_FRAMES = 255, 6  # of a GIF, and the frames that they are chosen from


def animate(
    scene: Case | Scene,
    path: str | Path,
    mdr: MDR | None = None,
    bem: BEM | None = None,
    frames: int = 60,
    seconds: float = 6.0,
    store: Store | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Path:
    """March through the program of a scene in one and in three dimensions, and write what is seen.

    scene : one that slides steadily or is pressed in is begun from an undisturbed elastomer, see `film.started`
    path : of a .gif, or of an .mp4 where ffmpeg is on the path
    mdr, bem : settings of the solvers, by default those of a Case; who refuses the scene is left out
    frames, seconds : instants that are shown, and how long the picture lasts
    store : where answers are kept and found again: nothing is solved twice; workers, progress as of `sweep`

    Raises Refused where both solvers do or the file cannot be written so, SolveError where a march fails.
    """
    path = Path(path)
    check(path, frames, seconds)
    if isinstance(scene, Case):
        mdr, bem = mdr or scene.mdr, bem or scene.bem
        scene = scene.scene
    seen = filmed(scene, mdr or MDR(), bem or BEM(points=128), frames, store, workers, progress)
    record(seen, path, seconds)
    return path


def filmed(
    scene: Scene,
    mdr: MDR,
    bem: BEM,
    frames: int,
    store: Store | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Film:
    """What `animate` shows, solved or found in the store; arguments and errors as there."""
    scene = started(scene)
    mdr, bem = replace(mdr, frames=frames), replace(bem, frames=frames)
    solvers: tuple[Solver, Solver] = mdr, bem
    refused = [reason for solver in solvers for reason in solver.refusals(scene)]
    tasks = [Task(each, (scene,), keeps_fields=True) for each in solvers if not each.refusals(scene)]
    if not tasks:
        raise Refused("neither solver can march through this scene: " + "; ".join(refused))
    fields = {}
    for task, outcome in _outcomes(tasks, store, workers, progress).items():
        if outcome.rows[0].reason:
            raise SolveError(f"{task.solver.name}: {outcome.rows[0].reason}")
        if not outcome.fields:
            raise SolveError(f"{task.solver.name}: nothing touches in the whole program; press deeper")
        fields[task.solver.name] = outcome.fields
    return Film(scene, bem, fields)


def record(film: Film, path: Path, seconds: float) -> None:
    """Draw every instant of a film in the current look and write the file, whole or not at all.

    Raises Refused as `check`.
    """
    check(path, len(film.times), seconds)
    write_as = _gif if path.suffix.lower() == ".gif" else _mp4
    with style.applied():
        write_as(path, drawn(film), seconds)


def check(path: Path, frames: int, seconds: float) -> None:
    """Raise Refused where nothing could write such a file, FileNotFoundError where its folder is not there."""
    if path.suffix.lower() not in (".gif", ".mp4"):
        raise Refused(f"{path.name}: a name that ends in .gif, or in .mp4 where ffmpeg is on the path")
    if path.suffix.lower() == ".mp4" and _ffmpeg() is None:
        raise Refused(f"{path.name}: an .mp4 takes ffmpeg, which is not on the path; install it, or name a .gif")
    if frames < 1 or not (seconds > 0 and frames / seconds <= FASTEST):
        raise Refused(
            f"frames = {frames} in seconds = {seconds:g}: at least one frame, and at most {FASTEST} in a second"
        )
    if not path.resolve().parent.is_dir():
        raise FileNotFoundError(f"{path.parent}: no such folder")


def drawn(film: Film) -> Iterator[np.ndarray]:
    """Every instant as it is drawn: red, green, blue (height, width, 3), whole numbers to 255, both sizes even."""
    reel = marching.Reel(film)
    canvas = FigureCanvasAgg(reel.drawing)
    reel.drawing.set_dpi(DOTS_PER_INCH)
    reel.show(len(film.times) - 1)
    # Laid out once, in two passes: panels stay where they are, and that takes as long as all else.
    reel.drawing.draw_without_rendering()
    canvas.draw()
    reel.drawing.set_layout_engine("none")
    for k in range(len(film.times)):
        reel.show(k)
        canvas.draw()
        pixels = np.asarray(canvas.buffer_rgba())[..., :3]
        height, width = (size // 2 * 2 for size in pixels.shape[:2])
        yield pixels[:height, :width].copy()


def _outcomes(tasks, store, workers, progress):
    if store is None:
        return {task: task.solve() for task in tasks}
    from .runner import sweep

    return sweep(tasks, store, workers, progress).outcomes


def _gif(path: Path, pictures: Iterator[np.ndarray], seconds: float) -> None:
    images = [Image.fromarray(picture) for picture in pictures]
    ends = np.rint(np.arange(len(images) + 1) * 1000 * seconds / len(images) / TICK) * TICK
    palette = _palette(images)
    plain = [_reduced(image, palette) for image in images]
    durations = np.diff(ends).astype(int).tolist()
    write(
        path,
        lambda file: plain[0].save(
            file, "GIF", save_all=True, append_images=plain[1:], duration=durations, loop=0, optimize=False
        ),
    )


def _palette(images: Sequence[Image.Image]) -> Image.Image:
    """One for all frames, so that what stands still stays as it is."""
    chosen = images[:: max(1, len(images) // PALETTE_FRAMES)]
    width, height = chosen[0].size
    sheet = Image.new("RGB", (width, height * len(chosen)))
    for k, image in enumerate(chosen):
        sheet.paste(image, (0, k * height))
    return sheet.quantize(COLOURS, Image.Quantize.MEDIANCUT)


def _reduced(image: Image.Image, palette: Image.Image) -> Image.Image:
    """With the ground, one colour in all frames, as it was: the palette has a mean with its neighbours."""
    reduced = image.quantize(palette=palette, dither=Image.Dither.NONE)
    colours = np.array(reduced.getpalette(), int).reshape(-1, 3)
    colours[np.asarray(reduced)[0, 0]] = np.asarray(image)[0, 0]
    reduced.putpalette(colours.ravel().tolist())
    return reduced


def _mp4(path: Path, pictures: Iterator[np.ndarray], seconds: float) -> None:
    """Through ffmpeg. Raises SolveError with what it says where it fails."""
    shown = list(pictures)
    height, width = shown[0].shape[:2]
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "film.mp4"
        given = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}"]
        asked = ["-r", f"{len(shown) / seconds:.6g}", "-i", "-", "-pix_fmt", "yuv420p", "-movflags", "+faststart"]
        command = [str(_ffmpeg()), "-y", "-loglevel", "error", *given, *asked, str(made)]
        ended = subprocess.run(command, input=b"".join(map(bytes, shown)), capture_output=True, check=False)
        if ended.returncode or not made.is_file():
            said = ended.stderr.decode(errors="replace").strip() or f"it ended with {ended.returncode}"
            raise SolveError(f"ffmpeg wrote no {path.name}: {said}")
        write(path, lambda file: file.write(made.read_bytes()))


def _ffmpeg() -> str | None:
    return shutil.which("ffmpeg")
