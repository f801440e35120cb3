"""Friction of the smooth body from slow to fast, and the ratio of one dimension to three, which tends to 2."""

from matplotlib.figure import Figure
from pandas import DataFrame

from .curves import tables_of
from .friction_speed import LINES, RATIOS, against
from .plot import Plot, Tables

NAME, KIND = "smooth-limit", "slow limit"
# v tau / a up to which the first order in the speed is drawn.
SLOW = 0.5
LABELS = r"$v\tau / a$ [1]", r"$\mu$ / slope at the edge [1]"


def plot(points: DataFrame, ratios: DataFrame, limits: DataFrame, folder: str = "") -> Plot | None:
    """Plot of friction of the smooth body over its slope at the edge of the contact; None unless it slides.

    points : model, v_tau_over_a, friction_over_slope_mean, _low and _high
    ratios : model, v_tau_over_a, ratio, ratio_low and ratio_high: friction over that of the reference
    limits : model, and friction_over_slope at v tau / a = 1 by the closed form of low speed
    """
    if points.empty:
        return None
    ends = DataFrame({"v_tau_over_a": [points["v_tau_over_a"].min(), SLOW]})
    lines = limits.merge(ends, how="cross").assign(kind=KIND)
    lines["friction_over_slope"] *= lines["v_tau_over_a"]
    caption = (
        "The smooth body at the scene's load or depth: friction over the slope of the body at the edge of the "
        "smooth relaxed contact of radius a. Lines: closed forms of first order in the speed. At low speed 1D "
        "over 3D tends to 2. Bars: change on halving the grid."
    )
    alternative = "Friction of both models against speed on logarithmic axes; below, their ratio falls from 2."
    tables = {NAME: points, f"{NAME}{RATIOS}": ratios.assign(body="smooth"), f"{NAME}{LINES}": lines}
    return Plot(f"{folder}{NAME}", figure, tables_of(tables), caption, alternative)


def figure(tables: Tables) -> Figure:
    """Above: friction over slope. Below: 1D over 3D."""
    slow = tables[NAME]["v_tau_over_a"].min(), SLOW
    return against(NAME, tables, "v_tau_over_a", LABELS, "friction_over_slope", slow)
