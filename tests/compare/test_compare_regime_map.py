"""Regime map: its table says what `trust` says of each scene, and its figure shows the table."""

from dataclasses import replace
from math import inf, nan

import numpy as np
import pytest
from matplotlib.contour import QuadContourSet
from pandas import DataFrame

from compare.report.plots import style
from compare.studies.trust import figure as regime_map
from compare.studies.trust.map import ABOUT, COLUMNS, FAMILY, contacts_like, regime_table
from compare.trustmap import table as campaign
from compare.trustmap.verdict import WIDE, trust
from scene import Layer
from scene.scales import elastic_contact

# The first is off the map; at the last the rms height is below all that were measured, as flat as the limit.
PRESSURES, MEMORIES = (0.06, 0.3, 1.0, 30.0, 300.0), (0.01, 3.0, 1000.0)
# What the map may miss of the smooth body on roughness pressed flat, of one: its own errors beside the data.
FLAT = 0.03
ROUNDING = 1e-9
# Lines through cells of a hundredth of a decade, in which the law is no straight line.
CELL = 1e-3


@pytest.fixture(scope="module")
def table():
    return regime_table(pressures=PRESSURES, memories=MEMORIES)


def smooth(table):
    return table[np.isinf(table["pressure_over_slope"])].set_index("memory_over_shortest")


def scene_at(pressure, memory):
    """Scene of the family: v tau = memory / q_s, and a rms slope of p / (E* pressure)."""
    rest, rough, solid = elastic_contact(FAMILY), FAMILY.roughness, FAMILY.solid
    q_s = 2 * np.pi / rough.shortest
    mean = rest.load / (np.pi * rest.radius**2 * solid.indentation_modulus)
    height = rough.rms_height * mean / pressure / rough.rms_slope(q_s)
    motion = replace(FAMILY.motion, speed=memory / q_s / solid.relaxation_time)
    return replace(FAMILY, motion=motion, roughness=replace(rough, rms_height=height))


def of_law(law, half=0.01):
    """Table of a law ratio(pressure, memory), finite where the pressure is infinite."""
    rows = [(p, m, law(p, m)) for m in np.geomspace(0.01, 10, 201) for p in (*np.geomspace(0.1, 10, 201), inf)]
    found = DataFrame(rows, columns=["pressure_over_slope", "memory_over_shortest", "ratio"])
    return found.assign(ratio_low=found["ratio"] * np.exp(-half), ratio_high=found["ratio"] * np.exp(half))


def drawn(table, wide=WIDE):
    with style.applied():
        drawing = regime_map.plot(table, DataFrame(columns=COLUMNS, dtype=float), ABOUT, wide).figure()
    axes = drawing.axes[0]
    return axes, axes.child_axes[0]


def legend(axes):
    return [text.get_text() for text in axes.figure.legends[0].get_texts()]


def contours(axes):
    """Lines of a panel, None without any."""
    return next((each for each in axes.collections if isinstance(each, QuadContourSet) and not each.filled), None)


def lines(axes):
    """Points (N, 2) of the lines of a panel, by ratio to three digits."""
    found = contours(axes)
    if found is None:
        return {}
    paths = zip(found.levels, found.get_paths(), strict=True)
    return {float(f"{np.exp(level):.3g}"): path.vertices for level, path in paths}


@pytest.mark.parametrize(("pressure", "memory"), [(0.3, 0.01), (1.0, 3.0), (300.0, 1000.0)])
def test_a_row_is_what_is_said_of_its_scene(table, pressure, memory):
    row = table.set_index(["pressure_over_slope", "memory_over_shortest"]).loc[(pressure, memory)]
    said = trust(scene_at(pressure, memory)).friction
    assert tuple(row) == pytest.approx((said.ratio, said.low, said.high), rel=ROUNDING)


def test_scenes_off_the_map_have_no_ratio(table):
    """The rms height is above the depth of the contact there."""
    off = table[table["pressure_over_slope"] == PRESSURES[0]]
    assert off[["ratio", "ratio_low", "ratio_high"]].isna().all(axis=None)
    assert np.isnan(trust(scene_at(PRESSURES[0], 3.0)).friction.ratio)
    assert table["ratio"].isna().sum() == len(off)


def test_the_strip_is_the_smooth_body(table):
    for memory, row in smooth(table).iterrows():
        body = replace(scene_at(1.0, memory), roughness=None)
        assert row["ratio"] == pytest.approx(trust(body).friction.ratio, rel=ROUNDING)


def test_the_map_tends_to_the_smooth_body_as_the_roughness_is_pressed_flat(table):
    ratios = table.pivot(index="memory_over_shortest", columns="pressure_over_slope", values="ratio")
    apart = np.abs(np.log(ratios.div(ratios[inf], axis=0)))
    assert (apart[[30.0, 300.0]] < FLAT).all(axis=None)
    assert (apart[0.3] > 3 * FLAT).all()


def test_a_family_that_was_not_measured_is_refused():
    layered = replace(FAMILY, layer=Layer(thickness=1e-3))
    with pytest.raises(ValueError, match="layer"):
        regime_table(layered, PRESSURES, MEMORIES)


def test_contacts_behind_the_map_are_those_of_its_family_and_agree_with_it():
    """Of other Hurst exponents and half to twice the waves, they differ by a factor."""
    rows = campaign.read(campaign.LEARNED)
    chosen = np.flatnonzero(rows["point"] < 400)
    found = contacts_like({name: values[chosen] for name, values in rows.items()})
    assert len(found) >= 3
    assert (found["ratio_low"] < found["ratio"]).all()
    said = [
        trust(scene_at(row.pressure_over_slope, row.memory_over_shortest)).friction.ratio
        for row in found.itertuples()
    ]
    assert np.nanmax(np.abs(np.log(found["ratio"] / said))) < np.log(2)


def test_lines_lie_where_the_ratio_has_their_value():
    axes, strip = drawn(of_law(lambda p, m: min(p, 20.0) ** 0.5))
    found = lines(axes)
    assert {0.5, 0.8, 1.0, 1.25, 2.0} <= set(found)
    for level, points in found.items():
        np.testing.assert_allclose(points[:, 0], level**2, rtol=CELL)
    assert not lines(strip)
    assert {"0.8", "1", "1.25", "2"} <= {text.get_text() for text in axes.texts}


def test_lines_go_on_in_the_strip():
    axes, strip = drawn(of_law(lambda p, m: m**0.5))
    for level, points in lines(strip).items():
        np.testing.assert_allclose(points[:, 1], lines(axes)[level][0, 1], rtol=CELL)
        assert points[0, 1] == pytest.approx(level**2, rel=0.05)


def test_what_is_to_be_solved_in_3d_is_hatched():
    """Where the interval is wide, where nothing is known, and nowhere else."""

    def hatched(axes):
        (found,) = [each for each in axes.collections if isinstance(each, QuadContourSet) and any(each.hatches)]
        (path,) = found.get_paths()
        return path.get_extents() if len(path.vertices) else None

    known = of_law(lambda p, m: min(p, 5.0))
    assert hatched(drawn(known)[0]) is None
    assert "solve in 3D" not in legend(drawn(known)[0])
    pressure = known["pressure_over_slope"]
    half = WIDE * 0.5 / pressure
    unsure = known.assign(ratio_low=known["ratio"] * np.exp(-half), ratio_high=known["ratio"] * np.exp(half))
    axes, _ = drawn(unsure)
    assert hatched(axes).x1 == pytest.approx(0.5, rel=CELL)
    assert "solve in 3D" in legend(axes)
    known.loc[pressure < 0.5, ["ratio", "ratio_low", "ratio_high"]] = nan
    assert hatched(drawn(known)[0]).x1 == pytest.approx(0.5, rel=0.05)
