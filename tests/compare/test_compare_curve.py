"""Everything that was solved is a Dataset with named dimensions, units, and a status of each contact."""

import re
from dataclasses import replace
from math import nan

import numpy as np
import pytest
from small_cases import SLIDING

from bem3d import BEM
from compare.solving.cost import MOST_DRAWS
from compare.solving.curve import (
    LEVELS,
    Curve,
    contacts_of,
    of_model,
    on_levels,
    on_two_levels,
    refuse,
    tasks_of,
    tree,
)
from compare.solving.task import Outcome, Row
from compare.solving.words import basis
from compare.statistics.finding import Claim
from compare.statistics.jackknife import DrawSet, mean, measured
from mdr1d import MDR
from scene import Refused
from scene.quantities import MOST_WHOLE

ROUGH = Curve(
    scene=SLIDING,
    speeds=(0.0, 0.1),
    values=(0.5, 1.0, 2.0),
    levels=on_two_levels(MDR(points=200), BEM(points=32)),
    draws={"MDR": 4, "BEM": 2},
)
SMOOTH = replace(ROUGH, scene=replace(SLIDING, roughness=None))


def outcome_of(task):
    """Numbers that tell where they belong: the speed, the load, the seed."""
    rows = []
    for scene in (scene for each in getattr(task, "contacts", (task,)) for scene in each.scenes):
        seed, speed, load = getattr(scene.roughness, "seed", 0), scene.motion.speed, scene.motion.load
        rows.append(Row(load, 1e-4 * load, 0.1 * load * speed, measures={"seed_seen": float(seed)}))
    return Outcome(tuple(rows))


@pytest.fixture(scope="module")
def answers():
    both = {"rough": ROUGH, "smooth": SMOOTH}
    return tree(both, {task: outcome_of(task) for task in tasks_of(both)})


def of(tree, curve, model):
    return of_model(tree[curve].to_dataset(), model)


def test_a_curve_is_one_dataset_and_each_model_has_its_own_part_of_it(answers):
    whole = {"model": 2, "level": 2, "speed": 2, "load": 3}
    assert dict(answers["rough"].sizes) == whole | {"surface": 4}
    assert dict(answers["smooth"].sizes) == whole
    assert dict(of(answers, "rough", "BEM").sizes) == {"level": 2, "speed": 2, "load": 3, "surface": 2}
    assert of(answers, "rough", "BEM").points.values.tolist() == [32, 16]
    assert of(answers, "rough", "BEM").surface.values.tolist() == [5, 6]
    asked = answers["rough"].status.sel(model="BEM", surface=[7, 8])
    assert set(asked.values.ravel()) == {"not asked"}


COARSER = {"fine": MDR(points=400), "coarse": MDR(points=200), "coarser": MDR(points=100)}


def test_draws_of_a_stratum_are_solved_on_their_grid_and_on_the_next_coarser_one():
    few = replace(ROUGH, levels={"MDR": COARSER}, draws={"MDR": (1, 2, 9)})
    found = few.dataset({task: outcome_of(task) for task in few.tasks()}).sel(model="MDR")
    assert found["stratum"].values.tolist() == [0] + [1] * 2 + [2] * 9
    assert np.unique(found["surface"]).size == found.sizes["surface"]
    asked = (found["status"] != "not asked").sel(speed=0.1, load=1.0)
    assert {name: asked.sel(level=name).sum().item() for name in COARSER} == {
        "fine": 1,
        "coarse": 3,
        "coarser": 11,
    }
    assert (found["seed_seen"] == found["surface"]).where(asked, True).all()
    assert found["normal_force"].where(~asked).isnull().all()
    assert few.cost.contacts == asked.sum() * 6
    assert refuse([few]) is None


def test_coarser_grids_end_where_they_pay_no_more_but_half_the_points_are_kept():
    assert [each.points for each in on_levels(BEM(points=128), [SLIDING]).values()] == [128, 64, 32]
    assert [each.points for each in on_levels(BEM(points=32), [SLIDING]).values()] == [32, 16]


def test_more_draws_leave_the_tasks_of_those_before_as_they_are():
    few = replace(ROUGH, levels={"MDR": COARSER}, draws={"MDR": (8, 8, 16)})
    more = replace(few, draws={"MDR": (8, 16, 24)})
    assert set(few.tasks()) < set(more.tasks())


def test_every_number_stands_where_it_was_asked_for(answers):
    rough = of(answers, "rough", "MDR")
    assert (rough.normal_force == rough["load"]).all()
    assert (rough.seed_seen == rough.surface).all()
    assert rough.friction_force.sel(speed=0.1, load=2.0).values == pytest.approx(0.02)


def test_a_body_that_does_not_touch_has_no_force_and_no_friction():
    empty = {task: Outcome((Row(0.0, nan, 0.0),) * task.count) for task in ROUGH.tasks()}
    found = of_model(ROUGH.dataset(empty), "BEM")
    assert set(found.status.values.ravel()) == {"no contact"}
    assert (found.normal_force == 0).all()
    assert found.friction_force.isnull().all()


def test_curves_that_cross_share_their_contacts():
    line = replace(ROUGH, speeds=(0.1,), values=(1.0,))
    assert set(tasks_of({"a": ROUGH, "b": line})) == set(ROUGH.tasks())
    both = {"a": ROUGH, "b": replace(line, keeps_fields=True)}
    kept = contacts_of(both)
    assert set(kept) == set(contacts_of({"a": ROUGH}))
    assert sum(each.keeps_fields for each in kept) == 2
    assert {each for each in kept if each.keeps_fields} <= set(tasks_of(both))  # alone, not on a path


@pytest.mark.parametrize("points", [32, 64, 96])
def test_the_values_that_a_refusal_names_are_enough_for_the_coarser_grid_too(points):
    def refused(points=points, shortest=SLIDING.roughness.longest / 200):
        scene = replace(SLIDING, roughness=replace(SLIDING.roughness, shortest=float(shortest)))
        refuse([replace(ROUGH, scene=scene, levels=on_two_levels(BEM(points=int(points))), draws={"BEM": 1})])

    with pytest.raises(Refused) as error:
        refused()
    found = re.findall(r"(points|shortest) = ([\d.e-]+) would do", str(error.value))
    assert {name for name, _ in found} == {"points", "shortest"}
    for name, value in found:
        refused(**{name: value})


PARTS = "rough/MDR", "rough/BEM", "smooth/MDR"


def sample(answers, level="fine"):
    return DrawSet({name: of(answers, *name.split("/")).sel(level=level) for name in PARTS})


def test_a_claim_is_measured_with_scatter_and_with_the_change_on_halving(answers):
    def ratio(sample):
        one, three = (mean(sample[f"rough/{model}"], "normal_force") for model in ("MDR", "BEM"))
        return float((one / three)[0, 0])

    claim = Claim("force", "The force in 1D is that in 3D", 1.0, 0.01, measure=ratio)
    fine, coarse = sample(answers), sample(answers, "coarse")
    found = measured(claim, fine, coarse)
    assert (found.value, found.verdict, found.grid, found.draws) == (1.0, "holds", 0.0, 2)
    assert basis(found) == "4 profiles, 2 surfaces, grid 0"
    coarse["rough/BEM"] = coarse["rough/BEM"].assign(normal_force=1.25 * coarse["rough/BEM"].normal_force)
    assert measured(claim, fine, coarse).grid == pytest.approx(0.2)


def test_the_largest_seeds_are_told_apart():
    last = MOST_WHOLE - len(LEVELS) * MOST_DRAWS
    each = replace(ROUGH, scene=replace(SLIDING, roughness=replace(SLIDING.roughness, seed=last)))
    seeds = of_model(each.dataset({task: outcome_of(task) for task in each.tasks()}), "MDR").surface
    assert seeds.dtype == np.int64
    assert seeds.values.tolist() == [last + k for k in range(4)]
