"""Errors that are stated and wanted: the random contacts, the counts of what held, and the fit behind them."""

from math import nan
from pathlib import Path

import friction_errors as errors
import numpy as np
import pandas
import promised
import pytest
import random_contacts
from pandas import DataFrame

from bem3d import BEM
from bem3d.friction import bound as frictionerror
from bem3d.friction.bound import FITTED
from compare.solving.task import Outcome, Row
from scene.protocol import refuse

LEARNED = Path(__file__).parents[2] / "docs" / "results" / "accuracy" / "learned.csv.gz"


@pytest.mark.parametrize("kind", random_contacts.KINDS)
def test_random_contacts_are_of_every_solid_and_none_is_refused(kind):
    drawn = [random_contacts.drawn(kind, seed) for seed in range(40)]
    assert {type(scene.elastomer).__name__ for scene in drawn} == {
        "Kelvin",
        "StandardLinearSolid",
        "Prony",
        "KelvinChain",
        "Fractional",
    }
    for scene in drawn:
        refuse(BEM(points=512), scene)
    assert random_contacts.drawn(kind, 3) == drawn[3]


@pytest.mark.parametrize("order", [0.7, 1.0, 2.0])
def test_values_on_ever_finer_grids_are_brought_to_their_limit(order):
    values = [2.0 + 0.3 * points**-order for points in (128, 256, 512)]
    truth, unsure = errors.settled(values)
    assert truth == pytest.approx(2.0, rel=1e-6)
    assert unsure == pytest.approx(0.3 * 512**-order / 2, rel=1e-3)
    assert errors.settled(values[:1])[1] == np.inf


def row(friction, bound):
    return Row(1.0, 0.01, friction, measures={"friction_error": bound})


def test_an_answer_counts_where_it_has_friction_and_its_truth_is_known():
    (first,) = list(errors.judged(range(3, 4)))[:1]
    finer = [row(1 + 0.1 * points**-1.0, 1.0) for points in errors.REFERENCE]

    def rows(answer, finer=finer):
        solved = zip(first.finer, finer, strict=True)
        return errors.rows(
            [first], {first.task: Outcome((answer,))} | {task: Outcome((each,)) for task, each in solved}
        )

    assert rows(row(1.02, 0.05))[0]["error"] == pytest.approx(0.02, rel=1e-3)
    assert not rows(row(0.0, 0.05))
    assert not rows(Row(reason="friction is not determined"))
    # A truth that is not known to a third of the error gives no row.
    assert not rows(row(1.02, 0.05), [row(1 + each, 1.0) for each in (0.4, 0.3, 0.2)])


def held(count, inside):
    one = {"model": "BEM", "solid": "Kelvin", "speed": "slow", "body": "smooth", "bound": 0.1}
    return DataFrame([{**one, "error": 0.05 if k < inside else 0.2} for k in range(count)])


def test_coverage_is_counted_by_region_with_its_interval():
    every = {each["region"]: each for each in errors.regions(held(60, 50))}
    assert (every["Kelvin"]["answers"], every["Kelvin"]["held"]) == (60, 50)
    # Clopper and Pearson, 50 of 60: 0.7148 to 0.9171.
    assert (every["all"]["lower"], every["all"]["upper"]) == (
        pytest.approx(0.7148, abs=1e-4),
        pytest.approx(0.9171, abs=1e-4),
    )
    assert set(errors.regions(held(39, 39)).__next__()) == set(every["all"])
    assert [each["region"] for each in errors.regions(held(39, 39))] == ["all"]


@pytest.mark.slow
def test_the_fit_that_ships_is_that_of_the_table_that_ships():
    found, shipped = errors.refitted(pandas.read_csv(LEARNED)), frictionerror._fitted()
    for kind, weights in found.items():
        for name, weight in weights.items():
            assert shipped[kind][name] == pytest.approx(weight, rel=2e-2, abs=2e-3), (kind, name)
    assert FITTED.exists()


def test_the_fit_holds_what_it_is_to_hold():
    table, weights = pandas.read_csv(LEARNED), frictionerror._fitted()
    names, bounds = table.columns.difference(["scene", "kind", "error", "residual"]), []
    for kind, rows in table.groupby("kind"):
        of_signs = np.exp(weights[kind]["one"] + rows[names] @ [weights[kind][name] for name in names])
        bounds.append(of_signs + frictionerror.OF_TOLERANCE * rows["residual"])
    bounds = pandas.concat(bounds)
    # More than of those left out, by what a fit knows of its own scenes.
    assert errors.WIDENED < np.mean(table["error"] <= bounds[table.index]) < 0.985
    assert np.median(bounds) < 4 * np.median(table["error"])


def entry(**changed):
    whole = {"quantity": "friction", "wanted": 0.01, "error": 0.005, "shown": 0.008}
    return whole | changed


def test_promises_are_counted_by_what_became_of_them():
    made = [
        entry(),
        entry(error=0.02),  # broken, and confirmed
        entry(shown=0.05),  # kept, and not confirmed
        entry(error=nan),  # confirmed, and too fine to be checked
        entry(error=nan, shown=nan),  # without an answer
    ]
    (found,) = promised.kept(DataFrame(made)).to_dict("records")
    counts = {"asked": 5, "confirmed": 3, "checked": 2, "broken": 1}
    assert found == {"quantity": "friction", "wanted": 0.01} | counts
