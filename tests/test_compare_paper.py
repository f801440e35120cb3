"""The paper simulated again: its campaign, its law, its shifts, and what is said of its claims."""

from dataclasses import replace

import numpy as np
import pytest

from compare.paper import campaign, law, parameters, shifts
from compare.paper.campaign import Campaign
from compare.paper.claims import Claim
from compare.paper.measured import read_measured
from compare.store import Store
from compare.sweep import sweep
from mdr1d import equations
from scene.reading import InvalidInput

SMALL = Campaign(values=4, hurst=(0.0, 0.3, 1.0), profiles=20)
# Sampling of a smaller campaign; at full size the demand is 2 %.
SLOPE = 0.02


@pytest.fixture(scope="module")
def collapse():
    return campaign.collect(SMALL, {block: block.solve() for block in campaign.blocks(SMALL)})


def test_the_campaign_is_that_of_the_paper():
    found = campaign.places(Campaign())
    assert len(found) == 6 * 20 * 11
    assert sum(len(block.seeds) for block in campaign.blocks(Campaign())) == 200
    for number, (least, most) in enumerate(
        [(0.1, 10), (1e5, 1e7), (1e-6, 1e-4), (1e-7, 1e-5), np.radians((5, 75)), (1e-4, 1e-2)]
    ):
        values = sorted({place.value for place in found if place.study == number})
        assert len(values) == 20
        assert (values[0], values[-1]) == pytest.approx((least, most), rel=1e-12)
    base = {
        (p.points, p.scene.motion, p.scene.elastomer) for p in found if parameters.STUDIES[p.study].name == "angle"
    }
    assert base == {(5000, parameters.base("cone").motion, parameters.SOLID)}


def test_one_parameter_varies_at_a_time():
    for place in campaign.places(SMALL):
        reference = parameters.base("cone")
        scene = replace(place.scene, roughness=replace(place.scene.roughness, hurst=reference.roughness.hurst))
        same = [
            scene.motion == reference.motion,
            scene.elastomer.modulus == reference.elastomer.modulus,
            scene.roughness.rms_height == reference.roughness.rms_height,
            place.points == parameters.POINTS,
            scene.indenter == reference.indenter,
            scene.elastomer.relaxation_time == reference.elastomer.relaxation_time,
        ]
        assert [name for name, is_same in enumerate(same) if not is_same] in ([place.study], [])


def test_friction_at_low_speed_collapses_on_slope_one_where_the_conditions_hold(collapse):
    fit = campaign.line(collapse, collapse.holds)
    assert fit.points >= 10
    assert fit.slope == pytest.approx(1.0, abs=SLOPE)
    assert fit.slope_interval[0] < fit.slope < fit.slope_interval[1]


def test_what_does_not_collapse_is_the_macroscopic_slope(collapse):
    slow = collapse.flags["xi << 1"] & collapse.flags["2a < L"] & collapse.flags["h0 << d"]
    printed = collapse.friction / collapse.xi
    assert printed[slow].max() > 100
    kept = printed / collapse.with_macro_slope
    np.testing.assert_allclose(kept[slow], 1.0, atol=0.1)


def test_the_same_numbers_come_from_one_worker_and_from_two(tmp_path):
    tiny = Campaign(values=2, hurst=(0.5,), profiles=30)
    blocks = campaign.blocks(tiny)
    one = sweep(blocks, Store(tmp_path / "one"), workers=1)
    two = sweep(blocks, Store(tmp_path / "two"), workers=2)
    first, second = (campaign.collect(tiny, swept.outcomes).samples for swept in (one, two))
    np.testing.assert_array_equal(first, second)


def test_a_stopped_campaign_resumes_with_what_it_has(tmp_path):
    tiny = Campaign(values=2, hurst=(0.5,), profiles=30)
    blocks = campaign.blocks(tiny)
    sweep(blocks[:2], Store(tmp_path), workers=1)
    rest = sweep(blocks, Store(tmp_path), workers=1)
    assert (rest.solved, rest.reused) == (1, 2)
    # A larger one has these profiles already, as they stand in whole blocks.
    more = campaign.blocks(replace(tiny, profiles=40))
    assert sweep(more, Store(tmp_path), workers=1).reused == 3
    damaged = next(tmp_path.glob("*.npz"))
    damaged.write_bytes(damaged.read_bytes()[:-30])
    assert sweep(blocks, Store(tmp_path), workers=1).solved == 1


def test_a_solve_without_an_answer_is_counted_and_left_out():
    blocks = campaign.blocks(SMALL)
    outcomes = {block: block.solve() for block in blocks}
    outcomes[blocks[0]].fields["friction"][5, 2] = np.nan
    found = campaign.collect(SMALL, outcomes)
    assert found.failed == 1
    assert np.isfinite(found.friction).all()
    everywhere = np.ones(found.xi.size, bool)
    assert campaign.line(found, everywhere).points == found.xi.size - 1


def test_the_law_of_fig_4_has_its_exponent_back():
    xi = np.array(law.VARIABLES)
    for alpha in (1.2, 1.5, 2.0):
        assert law._best(xi, equations.interpolation(xi, alpha)) == pytest.approx(alpha, abs=1e-4)


def test_fig_4_follows_the_law_and_reaches_its_plateau():
    found = law.tasks("sphere", 8)
    result = law.collect("sphere", found, {task: task.solve() for task in found})
    assert result.failed == 0
    assert result.alpha_interval[0] < result.alpha < result.alpha_interval[1]
    assert result.alpha == pytest.approx(1.5, abs=0.2)
    # Eight profiles: a standard error of 4 %.
    assert result.plateau == pytest.approx(1.0, abs=3 * result.plateau_error)
    np.testing.assert_allclose(result.deviation, 0.0, atol=0.15)


def test_without_what_the_smooth_body_has_friction_shifts_as_the_loss_does(monkeypatch):
    monkeypatch.setattr(parameters, "SPEEDS", parameters.SPEEDS[::9])
    monkeypatch.setattr(parameters, "FORCES", parameters.FORCES[::2])
    found = shifts.tasks(0.5, 4)
    result = shifts.collect(0.5, found, {task: task.solve() for task in found})
    assert result.whole.expected == -0.75
    assert result.rough.collapse.exponent == pytest.approx(-0.75, rel=0.05)
    # The macroscopic shape has a friction of its own, of long waves.
    assert abs(result.whole.collapse.exponent + 0.75) > 0.1
    assert result.whole.collapse.verdict != "holds"
    assert np.all(result.spectral > result.one_frequency)
    assert np.all(np.diff(result.smooth, axis=1) > 0)


def claim(low, high):
    return Claim("x", "figure", 1.0, 0.1, (low + high) / 2, low, high, "")


@pytest.mark.parametrize(
    ("low", "high", "verdict"),
    [
        (0.95, 1.05, "holds"),
        (0.9, 1.1, "holds"),
        (0.85, 1.0, "undecided"),
        (0.5, 1.5, "undecided"),
        (1.11, 1.2, "fails"),
        (0.2, 0.8, "fails"),
        (np.nan, np.nan, "undecided"),
    ],
)
def test_a_claim_holds_only_with_its_whole_interval(low, high, verdict):
    assert claim(low, high).verdict == verdict


def write(path, rows, heading=""):
    path.write_text(heading + "".join(",".join(f"{cell:.17g}" for cell in row) + "\n" for row in rows))
    return path


def rows(order=(0, 1, 2), repeats=3):
    rng = np.random.default_rng(4)
    found = []
    for speed in np.geomspace(3e-3, 2e-2, 4):
        for load in np.geomspace(1.0, 100.0, 8):
            for _ in range(repeats):
                friction = (1 + (3e-4 * load * speed**-1.5) ** 1.0) ** -0.6 * (1 + 0.01 * rng.normal())
                found.append([(friction, load, speed)[i] for i in order])
    return found


def test_a_users_table_takes_the_same_way(tmp_path):
    shifted = read_measured(write(tmp_path / "ball.csv", rows()))
    assert shifted.title == "ball"
    assert shifted.collapse.exponent == pytest.approx(-1.5, abs=4 * shifted.collapse.exponent_error)
    assert shifted.expected is None
    assert shifted.predicted is None


def test_a_heading_says_what_the_columns_are(tmp_path):
    plain = read_measured(write(tmp_path / "ball.csv", rows()))
    named = read_measured(write(tmp_path / "named.csv", rows((2, 0, 1)), "speed, mu, F_N\n"))
    assert named.collapse.exponent == plain.collapse.exponent


def test_single_measurements_leave_the_verdict_open(tmp_path):
    assert read_measured(write(tmp_path / "ball.csv", rows(repeats=1))).collapse.verdict == "undecided"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("mu,F,w\n1,2,3\n", "must name each of mu, F_N, v once"),
        ("1,2\n", "line 1: 2 columns; mu, F_N and v are needed"),
        ("1,2,3\n1,2,-3\n", "line 2: v = -3 must be finite and greater than 0"),
        ("1,2,3\n1,x,3\n", "line 2: F_N = 'x' is not a number"),
        ("1,2,3\n1,3,3\n", "1 speeds: at least 2"),
        ("1,2,3\n1,3,3\n1,3,4\n", "v = 4 has 1 load: at least 2"),
        ("", "0 speeds"),
        ("1,2,3\n1,3,3\n1,3,4\n1,5,4\n", "too few points"),
    ],
)
def test_a_table_that_says_too_little_is_refused_with_its_line(tmp_path, text, said):
    path = tmp_path / "ball.csv"
    path.write_text(text)
    with pytest.raises(InvalidInput, match=said) as refused:
        read_measured(path)
    assert str(path) in str(refused.value)
    with pytest.raises(InvalidInput, match="No such file"):
        read_measured(tmp_path / "none.csv")
