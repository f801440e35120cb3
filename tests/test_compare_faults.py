"""A task that broke is left out with its reason, and no number is made of it."""

import numpy as np
import pytest
from compare.paper import campaign, law, parameters, shifts
from compare.paper.campaign import Campaign
from compare.paper.planes import Planes
from compare.workprecision.promises import asked

from compare.outcome import Outcome, Row
from mdr1d import equations
from scene import SolveError

REASON = "ZeroDivisionError: a fault"
TWO_BLOCKS = Campaign(values=2, hurst=(0.5,), profiles=22)


def broken(tasks):
    return {task: task.failed(REASON) for task in tasks}


@pytest.mark.parametrize(
    "task",
    [
        law.tasks("cone", 3)[0],
        law.tasks("cone", 3)[-1],
        campaign.blocks(TWO_BLOCKS)[1],
        asked()[0],
    ],
    ids=lambda task: type(task).__name__,
)
def test_what_stands_for_an_answer_is_as_large_is_nan_and_has_the_reason(task):
    outcome = task.failed(REASON)
    assert task.fits(outcome)
    assert {row.reason for row in outcome.rows} == {REASON}
    assert all(np.isnan(row.normal_force) for row in outcome.rows)
    assert all(np.isnan(values).all() for values in outcome.fields.values())


def test_a_block_of_the_campaign_that_broke_is_left_out():
    first, second = campaign.blocks(TWO_BLOCKS)
    whole = {first: first.solve(), second: second.solve()}
    found = campaign.collect(TWO_BLOCKS, whole | broken([second]))
    of_both = campaign.collect(TWO_BLOCKS, whole)
    np.testing.assert_array_equal(found.samples, of_both.samples[:, : len(first.seeds)])
    assert found.failed == of_both.failed + found.samples.shape[0] * len(second.seeds)
    with pytest.raises(SolveError, match=REASON):
        campaign.collect(TWO_BLOCKS, broken([first, second]))


def followed(tasks):
    """Answers that follow Eq. 19 with alpha = 1.5, each profile a little off, and the planes exactly."""
    found, scatter = {}, 1 + 1e-3 * np.array([-1.0, 0.0, 1.0])
    level = equations.plateau(law._slope()) * equations.interpolation(np.array(law.VARIABLES))
    for task, friction in zip(tasks, level, strict=False):
        found[task] = Outcome(tuple(Row(1.0, 1e-4, friction * factor) for factor in scatter))
    return found | {tasks[-1]: Outcome((), {"friction": level})}


def test_a_point_of_the_law_that_broke_is_left_out():
    tasks = law.tasks("sphere", 3)
    assert isinstance(tasks[-1], Planes)
    whole = followed(tasks)
    found = law.collect("sphere", tasks, whole | broken(tasks[4:5]))
    np.testing.assert_array_equal(found.xi, np.delete(law.collect("sphere", tasks, whole).xi, 4))
    # The fit's own tolerance is 1e-6; noise of 1e-3 that is the same at all points moves alpha by less.
    assert found.alpha == pytest.approx(1.5, abs=5e-3)
    assert found.planes_alpha == pytest.approx(1.5, abs=1e-4)
    assert found.failed == 3
    without = law.collect("sphere", tasks, whole | broken(tasks[-1:]))
    assert np.isnan(without.planes_alpha)
    assert without.alpha == pytest.approx(1.5, abs=5e-3)
    with pytest.raises(SolveError, match=REASON):
        law.collect("sphere", tasks, broken(tasks))


def test_curves_that_share_their_profiles_are_not_shifted_without_one_of_them():
    loss = parameters.LOSSES[0]
    tasks = shifts.tasks(loss, 2)
    with pytest.raises(SolveError, match=REASON):
        shifts.collect(loss, tasks, broken(tasks[:1]) | dict.fromkeys(tasks[1:], Outcome((Row(1.0),) * 2)))
