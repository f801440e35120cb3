"""Pictures of a contact: what is in them is what was solved, from the lift of a program to full contact."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from drawn_scenes import KELVIN, LOAD, ROUGH, STANDARD, TAU, A, G, R
from drawn_scenes import SCENES as DRAWN

from bem3d import BEM
from compare.figures import contact_maps, style
from compare.report.views import view
from mdr1d import MDR
from scene import (
    WLF,
    Elastic,
    Heating,
    Indent,
    Layer,
    Program,
    Prony,
    Scene,
    Slide,
    Sphere,
    Stage,
)

LIFT = Program(stages=(Stage(duration=5 * TAU, load=LOAD), Stage(duration=TAU, load=0.0), Stage(duration=TAU)))
BACK = Program(stages=(Stage(duration=TAU, depth=1e-4, speed=0.5), Stage(duration=TAU, speed=-0.5)))
SLIDING = Slide(speed=0.1, load=LOAD)
SCENES = {name: DRAWN[name] for name in ("rest", "line", "plane", "full")} | {
    "rough": Scene(Sphere(R), KELVIN, SLIDING, ROUGH),
    "smooth": Scene(Sphere(R), KELVIN, Slide(speed=A / TAU, load=LOAD)),
    "elastic": Scene(Sphere(R), Elastic(G), SLIDING, ROUGH),
    "prony": Scene(Sphere(R), Prony(G, (G, 2 * G), (TAU, 10 * TAU)), SLIDING),
    "layer": Scene(Sphere(R), KELVIN, SLIDING, layer=Layer(thickness=2e-3)),
    "lifted": Scene(Sphere(R), KELVIN, LIFT),
    "back": Scene(Sphere(R), STANDARD, BACK, ROUGH),
    "tiny": Scene(Sphere(1e-9), KELVIN, Indent(depth=1e-12)),
}
OFTEN = {"rough", "line", "lifted", "full"}  # drawn in each run: with a wake, without maps, without contact or gap
LINE, SPACE = MDR(points=500, steps=20), BEM(points=48, steps=20)


@cache
def answered(name):
    scene = SCENES[name]
    solvers = [solver for solver in (LINE, SPACE) if not solver.refusals(scene)]
    return {solver.name: solver.solve(scene).fields for solver in solvers}


@cache
def seen(name):
    return view(SCENES[name], SPACE, answered(name))


def drawn(found):
    with style.applied():
        drawing = contact_maps.plot(found).figure()
        drawing.draw_without_rendering()
    return drawing


@cache
def picture(name):
    """A figure, only to be looked at."""
    return drawn(seen(name))


def texts(drawing):
    return [text.get_text() for axes in drawing.get_axes() for text in axes.texts]


def axes_of(drawing, title):
    return next(axes for axes in drawing.get_axes() if axes.get_title(loc="left")[4:].startswith(title))


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name in OFTEN else pytest.mark.slow) for name in SCENES],
)
def test_every_contact_has_a_picture_with_units_and_words_and_its_data(name):
    drawing = picture(name)
    for axes in drawing.get_axes():
        for label in (axes.get_xlabel(), axes.get_ylabel()):
            assert not label or label.endswith("]"), label
    titles = " ".join(axes.get_title(loc="left") for axes in drawing.get_axes())
    assert ("1D" in titles) == (not LINE.refusals(SCENES[name]))
    assert ("gap" in titles) == (name != "line")
    plot = contact_maps.plot(seen(name))
    assert len(plot.caption.split()) <= 60
    assert all(len(table) for name, table in plot.tables.items() if name != contact_maps.PRESSURE)


def test_maps_are_the_pressure_and_the_gap_of_the_answer_to_one_scale():
    found, drawing = seen("rough"), picture("rough")
    pressure, gap, contact = (axes_of(drawing, f"3D: {what}") for what in ("pressure", "gap", "real contact"))
    assert pressure.get_xlim() == gap.get_xlim() == contact.get_xlim()
    assert pressure.get_ylim() == gap.get_ylim() == contact.get_ylim()
    shown = pressure.images[0].get_array()
    assert shown.sum() == pytest.approx(1e-6 * answered("rough")["BEM"]["pressure"].sum(), rel=1e-12)
    assert (~shown.mask).sum() == (contact.images[1].get_array() > 0).sum() == found.space.touching.sum()
    assert np.asarray(gap.images[0].get_array()).min() == pytest.approx(0.0, abs=1e-3)  # of 100 um: the residual
    (circle,) = pressure.lines
    assert np.hypot(*circle.get_data()) == pytest.approx(1e3 * A, rel=1e-9)
    assert "← indenter slides" in [text.get_text() for text in pressure.texts]


def test_the_wake_is_seen_behind_a_contact_that_slides_and_none_at_rest():
    sliding, rest = seen("smooth"), seen("rest")
    for found in (sliding, rest):
        section = found.space.section
        ahead = np.interp(-1.9 * A, section.x, section.surface)
        behind = np.interp(1.9 * A, section.x, section.surface)
        # far from both edges alike at rest, to the digits of the interpolation; the wake is deeper by half
        assert behind < 1.5 * ahead if found is sliding else behind == pytest.approx(ahead, rel=1e-3)
    assert sliding.span[1] > -sliding.span[0]
    assert rest.span[1] == pytest.approx(-rest.span[0], rel=0.1)
    assert sliding.space.around.x[-1] >= sliding.span[1] - A / 10


@pytest.mark.parametrize("solid", [KELVIN, STANDARD, Prony(G, (3 * G, 2 * G, G), (TAU / 10, TAU, 10 * TAU))])
def test_in_one_dimension_the_wake_behind_the_grid_recovers_as_it_does_on_it(solid):
    scene = replace(SCENES["smooth"], elastomer=solid, motion=Slide(speed=3 * A / TAU, load=LOAD))
    narrow, wide = (
        view(scene, SPACE, {"MDR": MDR(points=1000, extent=extent).solve(scene).fields})
        for extent in (3 * A, 24 * A)
    )
    x = np.linspace(2 * A, min(narrow.span[1], wide.span[1]), 20)
    assert x[-1] > 4 * A
    near, far = (np.interp(x, each.line.x, each.line.surface) for each in (narrow, wide))
    # of the greatest depression; profiles on pixels of a 40th of the radius
    np.testing.assert_allclose(near, far, rtol=0, atol=1e-3 * np.ptp(wide.line.surface))


def test_bodies_touch_where_contact_is_bold_and_nowhere_overlap():
    for name in ("rough", "smooth", "layer", "line", "plane", "back"):
        found = seen(name)
        for section in filter(None, (found.line, found.space.section)):
            gap = section.indenter - section.surface
            deepest = np.ptp(section.surface)
            # residual of the contact, and in a program what the depth moves within half a step
            np.testing.assert_allclose(gap[section.touching], 0, atol=1e-4 * deepest)
            assert np.nanmin(gap) > -1e-4 * deepest


def test_full_contact_has_no_gap_of_rounding():
    gap = axes_of(picture("full"), "3D: gap")
    image = gap.images[0]
    assert np.max(image.get_array()) < 1e-6 * image.get_clim()[1]


def test_where_nothing_is_left_in_contact_that_is_said():
    assert not seen("lifted").space.touching.any()
    said = texts(picture("lifted"))
    assert said.count("nothing touches") == 3
    assert "at rest" in said


def test_a_contact_that_goes_backwards_meets_the_elastomer_from_the_other_side():
    assert "indenter slides →" in texts(picture("back"))


def test_what_has_no_fields_or_is_warmed_by_its_friction_has_no_picture():
    warm = WLF(temperature=300.0, reference=300.0, c1=8.86, c2=101.6)
    heated = replace(SCENES["rough"], temperature=warm, heating=Heating(conductivity=0.2, feedback="average"))
    for scene, fields in ((SCENES["rough"], {}), (heated, {"BEM": {}})):
        assert contact_maps.plot(view(scene, SPACE, fields)) is None
