"""The uncertainty of friction due to grids, which every page states: first where it is large."""

from dataclasses import replace

import numpy as np
import pytest
import xarray

import compare
from bem3d import BEM
from compare.library.lookup import case_of
from compare.statistics import griderror
from mdr1d import MDR
from scene import Doubtful, Kelvin, PowerLaw, Scene, Slide


def answers(three, one=(1e-5, 2e-5)):
    """Answers with these errors on the fine grid, and greater ones on the coarse one."""

    def dataset(errors):
        both = np.array([errors, np.full(len(errors), 0.9)])
        return xarray.Dataset({"friction_error": (("level", "speed"), both)}, {"level": ["fine", "coarse"]})

    return xarray.DataTree.from_dict({"/contacts/BEM": dataset(three), "/contacts/MDR": dataset(one)})


def test_an_error_above_a_tenth_is_said_first():
    lines = griderror.with_grid_error(answers([0.01, 0.11, 0.23]), ["the answer"])
    assert lines[1:] == ["the answer"]
    assert lines[0] == "Friction may be wrong by up to 23 % in 3D by the grid: take more points (bounds of 95 %)."


def test_without_friction_nothing_is_said():
    still = xarray.DataTree.from_dict({"/contacts/BEM": xarray.Dataset({"depth": ((), 1.0)})})
    assert griderror.with_grid_error(still, ["the answer"]) == ["the answer"]
    assert griderror.with_grid_error(answers([np.nan], [np.nan]), ["the answer"]) == ["the answer"]


BODY = PowerLaw(coefficient=1e-4 / 1e-3**50, exponent=50)
BLUNT = replace(
    case_of(Scene(BODY, Kelvin(1e6, 1e-3), Slide(speed=0.3, load=1.0))), bem=BEM(points=64), mdr=MDR(points=500)
)


@pytest.mark.usefixtures("in_this_process")
def test_a_sweep_states_the_error_of_every_contact_and_warns_of_a_great_one(tmp_path):
    with pytest.warns(Doubtful) as warned:
        found = compare.sweep(BLUNT, speed=[0.3], report=False, output=tmp_path)
    assert (found["friction_error"].sel(model="BEM", level="fine") > griderror.MUCH).all()
    (uncertain,) = (each for each in warned if each.category is compare.UncertainFriction)
    assert "Friction may be wrong by up to" in str(uncertain.message)
    assert uncertain.filename == __file__
    messages = [str(each.message) for each in warned if each.category is Doubtful]
    assert messages[0].startswith("slope of the body at the edge of the contact")
    assert messages[-1].startswith("1 of 4 contacts have no answer")  # on half the points


@pytest.mark.usefixtures("in_this_process")
def test_a_drawing_of_an_uncertain_contact_says_so_first(tmp_path):
    with pytest.warns(Doubtful, match="slope of the body at the edge of the contact"):
        report = compare.draw(BLUNT, output=tmp_path)
    assert report.page.answer[0].startswith("Friction may be wrong by up to")


def test_of_surfaces_the_mean_is_uncertain_by_the_mean_of_their_bounds():
    bounds = xarray.Dataset({"friction_error": (("speed", "surface"), [[0.02, 0.2], [0.2, 0.4]])})
    found = griderror.stated(xarray.DataTree.from_dict({"/contacts/BEM": bounds}))
    np.testing.assert_allclose(found, [0.11, 0.3])
