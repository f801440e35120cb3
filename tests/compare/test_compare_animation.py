"""A march as a picture that moves: instants cost nothing unasked, and what is drawn is what was solved."""

import os
import stat
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from drawn_scenes import CELL, DIP, KELVIN, LIFT, LOAD, ROUGH, SCENES, STANDARD, TAU, A, R
from PIL import Image, ImageSequence

from bem3d import BEM
from compare.library.lookup import case_of
from compare.report.plots import style
from compare.solving.store import Store
from compare.studies.animate import animation
from compare.studies.animate.figure import MarchFigure
from compare.studies.animate.film import started
from mdr1d import MDR
from scene import (
    Coulomb,
    Plane,
    Program,
    Refused,
    Scene,
    Shear,
    Slide,
    SolveError,
    Sphere,
    Stage,
)

pytestmark = pytest.mark.usefixtures("in_this_process")

RUN = Program(stages=(Stage(duration=2 * TAU, load=LOAD), Stage(duration=4 * TAU, speed=0.2)))
LINE, SPACE = MDR(points=200, steps=20), BEM(points=32, steps=20)
RUNNING = Scene(Sphere(R), KELVIN, RUN, ROUGH)


@cache
def film(scene, frames=4):
    with TemporaryDirectory() as folder:
        return animation.filmed(scene, LINE, SPACE, frames, Store(Path(folder)), workers=1)


def case(scene=RUNNING, line=LINE, space=SPACE):
    return replace(case_of(scene), mdr=line, bem=space)


@pytest.fixture
def solved(tmp_path_factory):
    return tmp_path_factory.mktemp("solved")


@pytest.mark.parametrize("solver", [LINE, SPACE])
@pytest.mark.parametrize("motion", [RUN, DIP, pytest.param(LIFT, marks=pytest.mark.slow)])
def test_instants_are_kept_of_the_same_march_to_the_last_digit(solver, motion):
    scene = replace(RUNNING, motion=motion)
    plain, kept = (each.solve(scene) for each in (solver, replace(solver, frames=5)))
    assert not [name for name in plain.fields if name.startswith("frame")]
    for name, values in plain.fields.items():
        np.testing.assert_array_equal(kept.fields[name], values)
    times = kept.fields["frame_time"]
    assert len(times) == 5
    steps = plain.fields["time"]
    # as near as the steps are to each other, where the longest is a twentieth of a stage
    wanted = motion.duration * np.arange(1, 6) / 5
    assert np.abs(times - wanted).max() <= np.diff(steps, prepend=0).max()


def test_instants_in_three_dimensions_are_the_contact_then():
    kept = replace(SPACE, frames=6).solve(RUNNING).fields
    patch = (kept["x"][1] - kept["x"][0]) ** 2
    for k, time in enumerate(kept["frame_time"]):
        step = int(np.argmin(np.abs(kept["time"] - time)))
        force = kept["frame_pressure"][k].sum() * patch
        assert force == pytest.approx(kept["normal_force"][step], rel=1e-9)
    np.testing.assert_array_equal(kept["frame_pressure"][-1], kept["pressure"])
    assert np.abs(kept["frame_shift"]).max() <= 1.01 * (kept["x"][1] - kept["x"][0])
    surface = kept["frame_displacement"]
    assert (surface.max(axis=(1, 2)) > 0).all()
    # under the deepest point of the indenter the surface is as deep, whatever the roughness lifts
    assert surface[-1].max() == pytest.approx(kept["frame_depth"][-1], abs=3 * ROUGH.rms_height)


def test_instants_in_one_dimension_are_the_elements_then():
    kept = replace(LINE, frames=6).solve(RUNNING).fields
    touching = kept["frame_contact"]
    pressed = kept["frame_depth"][:, None] - kept["frame_profile"]
    np.testing.assert_allclose(kept["frame_displacement"][touching], pressed[touching], rtol=0, atol=1e-18)
    for name in ("x", "profile", "displacement", "contact"):
        np.testing.assert_array_equal(kept[f"frame_{name}"][-1], kept[name])


def test_a_gif_has_every_instant_for_its_share_of_the_time(tmp_path):
    path = tmp_path / "run.gif"
    animation.record(film(RUNNING), path, seconds=1.0)
    with Image.open(path) as gif:
        pictures = [(frame.info["duration"], frame.convert("RGB")) for frame in ImageSequence.Iterator(gif)]
    assert [duration for duration, _ in pictures] == [250] * 4
    assert {picture.getpixel((0, 0)) for _, picture in pictures} == {(255, 255, 255)}
    first, last = (np.asarray(pictures[k][1], int) for k in (0, -1))
    assert (np.abs(first - last).max(axis=2) > 60).mean() > 1e-3
    assert path.stat().st_size < 1e6


@pytest.mark.slow
def test_the_same_march_is_made_again_from_what_was_solved_with_the_settings_of_the_case(
    tmp_path, solved, monkeypatch
):
    options = {"frames": 2, "seconds": 1.0, "folder": solved, "workers": 1}
    first = animation.animate(case(), tmp_path / "first.gif", **options).read_bytes()
    for solver in (MDR, BEM):
        monkeypatch.setattr(solver, "solve", None)
    assert animation.animate(case(), tmp_path / "again.gif", **options).read_bytes() == first


def test_a_file_that_nothing_could_write_is_refused_before_anything_is_solved(tmp_path, solved, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    for name, said in (("run.avi", "ends in .gif"), ("run.mp4", "takes ffmpeg, which is not on the path")):
        with pytest.raises(Refused, match=said):
            animation.animate(RUNNING, tmp_path / name, folder=solved)
    with pytest.raises(FileNotFoundError, match="no such folder"):
        animation.animate(RUNNING, tmp_path / "absent" / "run.gif", folder=solved)
    for frames, seconds in ((0, 1.0), (100, 1.0), (10, 0.0), (10, -1.0), (10, float("nan"))):
        with pytest.raises(Refused, match="frames = "):
            animation.animate(RUNNING, tmp_path / "run.gif", frames, seconds, solved)
    assert not list(solved.iterdir())


def fake_ffmpeg(folder, script):
    program = folder / "ffmpeg"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)


@pytest.mark.slow
def test_an_mp4_goes_through_ffmpeg_picture_by_picture(tmp_path, monkeypatch):
    tools = tmp_path / "tools"
    tools.mkdir()
    # keeps what it is given: its arguments, and every byte of the pictures
    fake_ffmpeg(tools, 'for last; do :; done; echo "$@" > "$last"; cat >> "$last"')
    monkeypatch.setenv("PATH", f"{tools}{os.pathsep}{os.environ['PATH']}")
    path = tmp_path / "run.mp4"
    animation.record(film(RUNNING), path, seconds=2.0)
    arguments, pixels = path.read_bytes().split(b"\n", 1)
    words = arguments.decode().split()
    width, height = map(int, words[words.index("-s") + 1].split("x"))
    assert len(pixels) == 4 * width * height * 4
    assert float(words[words.index("-framerate") + 1]) == 2.0


@pytest.mark.slow
def test_where_ffmpeg_fails_its_own_words_are_said_and_nothing_is_written(tmp_path, monkeypatch):
    fake_ffmpeg(tmp_path, 'cat > /dev/null; echo "no encoder" >&2; exit 1')
    monkeypatch.setenv("PATH", str(tmp_path) + os.pathsep + os.environ["PATH"])
    with pytest.raises(SolveError, match=r"ffmpeg wrote no run\.mp4: no encoder"):
        animation.record(film(RUNNING, 2), tmp_path / "run.mp4", seconds=1.0)
    assert [path.name for path in tmp_path.iterdir()] == ["ffmpeg"]


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name == "line" else pytest.mark.slow) for name in SCENES]
)
def test_every_instant_is_drawn_with_units_to_the_same_scales(name):
    found = film(SCENES[name])
    assert ("MDR" in found.fields) == (not LINE.refusals(SCENES[name]))
    with style.applied():
        reel = MarchFigure(found)
        limits = set()
        for k in range(len(found.times)):
            reel.show(k)
            reel.drawing.draw_without_rendering()
            axes = reel.drawing.get_axes()
            limits.add(tuple((each.get_xlim(), each.get_ylim()) for each in axes))
            for each in axes:
                for label in (each.get_xlabel(), each.get_ylabel()):
                    assert not label or label.endswith("]"), label
    assert len(limits) == 1


def test_an_instant_replaces_the_one_before_and_shows_its_pressure_and_its_past():
    found = film(RUNNING)
    with style.applied():
        reel = MarchFigure(found)
        for k in range(len(found.times)):
            reel.show(k)
            pressure, section, profile, load, friction = reel.drawing.get_axes()[:5]
            (image,) = pressure.images
            shown = 1e6 * image.get_array().sum()
            assert shown == pytest.approx(found.fields["BEM"]["frame_pressure"][k].sum(), rel=1e-12)
            # undisturbed level, surface, contact
            assert len(section.lines) == len(profile.lines) == 3
            three, one = load.lines
            assert three.get_xdata()[-1] == pytest.approx(1e3 * found.times[k], rel=0.1)
            assert len(friction.lines) == 2
            assert len(one.get_xdata()) == (found.fields["MDR"]["time"] <= found.times[k]).sum()


def test_a_steady_scene_is_begun_from_an_undisturbed_elastomer_and_ends_in_its_own_answer():
    steady = Scene(Sphere(R), STANDARD, Slide(speed=0.5 * A / TAU, load=LOAD))
    program = started(steady).motion
    assert program.duration == pytest.approx(1.2 * 4 * A / steady.motion.speed)
    assert program.prescribed(0.0) == 0
    mu = SPACE.solve(replace(steady, motion=program)).friction_coefficient
    # four radii of path at half a radius of memory; 32 points
    assert mu == pytest.approx(SPACE.solve(steady).friction_coefficient, rel=2e-2)
    assert started(RUNNING) is RUNNING


def test_what_has_no_beginning_in_time_is_refused():
    shear = Scene(Sphere(R), KELVIN, Shear(displacement=1e-5, load=LOAD), interface=Coulomb(coefficient=0.3))
    gap = Scene(Plane(), KELVIN, Slide(speed=0.1, gap=1e-6), CELL)
    for scene, said in ((shear, "Shear"), (gap, "gap")):
        with pytest.raises(Refused, match=f"a {said} has no beginning"):
            started(scene)


def test_a_scene_that_both_solvers_refuse_is_refused_with_both_reasons(tmp_path, solved):
    asked = case(replace(RUNNING, roughness=replace(ROUGH, shortest=1e-7)), space=BEM(points=32, extent=1e-3))
    with pytest.raises(Refused, match=r"neither solver.*points"):
        animation.animate(asked, tmp_path / "run.gif", folder=solved)


def test_a_march_in_which_nothing_touches_or_that_fails_is_no_picture(solved):
    barely = Scene(Sphere(R), KELVIN, Program(stages=(Stage(duration=TAU, depth=1e-9),)))
    for asked, said in (
        (case(barely, space=replace(SPACE, extent=4 * A)), "BEM: nothing touches"),
        (case(line=replace(LINE, extent=A)), "MDR: .* extent"),
    ):
        with pytest.raises(SolveError, match=said):
            animation.filmed(asked.scene, asked.mdr, asked.bem, 2, Store(solved), workers=1)
