"""A measured spectrum in every model: a self-affine one as a table answers, and is drawn, as that one."""

from dataclasses import replace

import numpy as np
import pytest

from bem3d import BEM
from bem3d.surface import RoughSurface
from compare import trust
from compare.models.law.persson import Persson
from compare.trustmap.friction_law import FrictionLaw
from mdr1d import MDR
from mdr1d.lines import draw
from scene import Doubtful, Kelvin, Refused, Scene, SelfAffine, Slide, SolveError, Spectrum, Sphere

ROUGH = SelfAffine(hurst=0.8, rms_height=4e-6, longest=2e-3, rolloff=7e-4, shortest=2e-4, seed=3)
TOP = ROUGH.q_max(0.0)
SCENE = Scene(Sphere(radius=5e-3), Kelvin(modulus=1e6, relaxation_time=1e-3), Slide(speed=0.02, load=0.2), ROUGH)
# The corner lies between two of 200 points; measured at most 1.3e-4 of the rms height, and 5e-6 of forces.
AS_A_TABLE = 2e-4
MODELS = MDR(), MDR(spectrum="line-scan"), BEM(points=64), Persson(), FrictionLaw()


def as_table(rough, points, **stated):
    """The density of a self-affine surface as a table."""
    q = np.geomspace(rough.q_min, TOP, points)
    q[[0, -1]] = rough.q_min, TOP
    stated = {"seed": rough.seed, "amplitudes": rough.amplitudes} | stated
    return Spectrum(q=q, C2D=rough.density_2d(q, TOP), convention="persson", **stated)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: f"{model.name} {getattr(model, 'spectrum', '')}")
def test_a_self_affine_spectrum_as_a_table_has_the_friction_of_its_law(model):
    law = model.solve(SCENE).friction_coefficient
    table = model.solve(replace(SCENE, roughness=as_table(ROUGH, 200))).friction_coefficient
    # Of Persson and the law waves are in bands, of either kind its own.
    bands = 2e-3 if model.name in ("Persson", "FrictionLaw") else AS_A_TABLE
    assert table == pytest.approx(law, rel=bands)


@pytest.mark.parametrize("spectrum", ["mapped", "line-scan", "surface"])
@pytest.mark.parametrize("amplitudes", ["fixed", "gaussian"])
def test_a_table_draws_the_surface_of_its_seed_the_closer_the_more_points(spectrum, amplitudes):
    x = np.linspace(-1e-3, 1e-3, 21)

    def heights(rough):
        if spectrum == "surface":
            return RoughSurface.of(rough, TOP).heights(x, x)
        return draw(rough, 64, spectrum).heights

    law = replace(ROUGH, amplitudes=amplitudes)
    error = [np.abs(heights(as_table(law, count)) - heights(law)).max() / 4e-6 for count in (8, 40, 200)]
    assert error[0] > 4 * error[1] > 16 * error[2]
    assert error[2] < AS_A_TABLE
    # without a corner one power law is exact
    straight = replace(law, rolloff=None)
    np.testing.assert_allclose(heights(as_table(straight, 2)), heights(straight), atol=1e-9 * 4e-6)


def test_the_trust_map_judges_a_table_as_its_law_and_says_what_was_measured():
    law = trust(SCENE)
    with pytest.warns(Doubtful, match="share of the mean square slope"):
        table = trust(replace(SCENE, roughness=as_table(ROUGH, 200)))
    for name, worth in law.corrections.items():
        found = table.corrections[name]
        assert (found.ratio, found.low, found.high) == pytest.approx(
            (worth.ratio, worth.low, worth.high), rel=2e-3
        )
        assert "Self-affine spectra were measured" in found.reason
        assert "Self-affine spectra were measured" not in worth.reason


FINE = replace(ROUGH, shortest=2e-6)


@pytest.mark.parametrize("solver", [MDR(points=500), BEM(points=64)])
def test_a_grid_too_coarse_is_refused_and_what_the_message_states_is_solved(solver):
    q = np.geomspace(FINE.q_min, FINE.q_max(0.0), 30)
    scene = replace(
        SCENE,
        motion=Slide(speed=0.01, load=0.01),
        roughness=Spectrum(q=q, C2D=FINE.density_2d(q, q[-1]), convention="persson"),
    )
    reason = " ".join([*solver.refusals(scene), *getattr(solver, "foreseen", lambda _: [])(scene)])
    kept = float(reason.partition("shortest_kept = ")[2].split()[0])
    assert "points = " in reason
    with pytest.raises((Refused, SolveError)):
        solver.solve(scene)
    rough = replace(scene.roughness, shortest_kept=kept)
    assert solver.solve(replace(scene, roughness=rough)).friction_coefficient > 0
