"""The master curve in three dimensions beside the paper's in one."""

from collections.abc import Sequence
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from pandas import DataFrame, concat

from ....figures import shades, style
from ....figures.curves import intervals
from ....figures.lettering import clear, lettered, literal
from ....report.page import Plot, Tables
from ....solving.words import number
from ....statistics.finding import Finding
from ....statistics.means import Interval
from ..claims_law import PLOT, SHALLOW, LawPoints
from ..points import friction_at, interval_columns, place_columns
from .friction import MARKERS

# Columns of the panels in one dimension: of one series, and of several.
ONE, SEVERAL = ("shifted_force", "friction_coefficient"), ("xi", "friction_over_plateau")
LABELS = {
    "shifted_force": "shifted normal force [N]",
    "friction_coefficient": "friction coefficient [1]",
    "xi": r"$\xi$ [1]",
    "friction_over_plateau": r"friction / plateau, $\tilde{\mu}$ [1]",
}
TITLES = {"shifted_force": "1D: shifted, Eq. 23", "xi": "1D: over the plateau"}
MARK: dict[str, Any] = {"linestyle": "none", "capsize": 0}


def plot(
    members: Sequence[LawPoints],
    paper: DataFrame,
    curve: DataFrame,
    findings: Sequence[Finding],
    folder: str = "",
    fitted: str = "",
) -> Plot:
    """Plot of the master curve, of one series or of several.

    paper, curve : points in one dimension with the title of their series, and the curve that they are to fall on
    findings : on these points
    folder : of the figure of one series
    fitted : misfit in words, of a curve that is fitted to the points in one dimension
    """
    points = concat([_measured(each) for each in members], ignore_index=True)
    x = np.geomspace(points["pressure_ratio"].min(), points["pressure_ratio"].max(), 101)
    shares = np.array([share(x) for each in members for share in each.curves])
    ends = {"share_of_full_contact_low": shares.min(axis=0), "share_of_full_contact_high": shares.max(axis=0)}
    left = (
        "friction shifted along the load (Eq. 23)"
        if folder
        else "friction over its plateau against ξ (Eqs. 18, 19)"
    )
    return Plot(
        f"{folder}{PLOT}",
        master_curve,
        {
            "law-1d": paper,
            "law-1d-curve": curve,
            "law-3d": points,
            "law-share": DataFrame({"pressure_ratio": x} | ends),
        },
        f"(a) In 1D: {left}. (b) In 3D: what roughness adds to friction, over that in full contact; band, S(x) at "
        "all speeds; roughness below 0.3 of the friction left out. (c), (d) Off the curve, 5 % in grey; numbers, "
        "without hollow points. Bars: 95 %, cut at the frame.",
        "The master curve in three dimensions beside the paper's in one",
        {"fitted": fitted, "missed": _missed(findings), "claimed": SHALLOW},
    )


def _measured(points: LawPoints) -> DataFrame:
    """Share measured at each point where the roughness has enough of friction."""
    series, place = points.contacts.series, points.law
    measured = Interval(*map(place.measured, friction_at(points.contacts, points.solver)))
    columns = {"series": series.title} | place_columns(series) | {"pressure_ratio": place.x.ravel()}
    columns |= interval_columns("measured_share", measured)
    columns |= {"share_of_full_contact": place.share.ravel(), "height_over_depth": points.height.ravel()}
    return DataFrame(columns)[points.counted.ravel()].reset_index(drop=True)


def master_curve(tables: Tables, fitted: str = "", missed: str = "", claimed: float = SHALLOW) -> Figure:
    """Left: the paper's curve in 1D. Right: S(x) in 3D. Below: off either.

    fitted, missed : misfit in 1D and in 3D, in words
    claimed : rms height over depth above which markers are hollow
    """
    paper, curve, points, share = (tables[name] for name in ("law-1d", "law-1d-curve", "law-3d", "law-share"))
    across, up = ONE if ONE[0] in paper else SEVERAL
    drawing = style.canvas("double", 5.0)
    panels = drawing.subplots(2, 2, sharex="col", height_ratios=(1.5, 1))
    (left, right), (below_left, below_right) = panels
    scale = shades.between(np.concatenate([paper["speed"], points["speed"]]))
    paper, points = (table.assign(body=table["series"].str.partition(", ")[0]) for table in (paper, points))
    names = list(dict.fromkeys([*paper["body"], *points["body"]]))
    markers = dict(zip(names, cycle(MARKERS), strict=False))
    line = style.line(0, 0.8, zorder=1)
    label = f"{curve['curve'].iloc[0]}, {'' if fitted else 'not '}fitted"
    left.plot(curve[across], curve[up], "-", label=label, **line)
    ends = (share[f"share_of_full_contact_{end}"] for end in ("low", "high"))
    right.fill_between(share["pressure_ratio"], *ends, color=style.grey(0.65), linewidth=0, zorder=1, label="S(x)")
    known = np.interp(np.log(paper[across]), np.log(curve[across]), np.log(curve[up]))
    for axes, below, table, name, value, expected in (
        (left, below_left, paper, across, up, np.exp(known)),
        (right, below_right, points, "pressure_ratio", "measured_share", points["share_of_full_contact"]),
    ):
        off = _off(table, value, expected)
        heights = table["height_over_depth"] if "height_over_depth" in table else 0 * table["speed"]
        for (body, speed), own in table.groupby(["body", "speed"]):
            look: dict[str, Any] = {"color": shades.SPEED(scale(speed)), "marker": markers[body]}
            look |= MARK | {"markersize": style.mark(0.75), "elinewidth": style.width(0.65)}
            for chosen, inside in ((heights <= claimed, {}), (heights > claimed, _hollow())):
                shown = own[chosen[own.index]]
                intervals(axes, shown[name], shown, value, **look | inside)
                intervals(below, shown[name], off.loc[shown.index], "off_curve", 100, **look | inside)
        axes.set(xscale="log", yscale="log", ylim=_around(np.log(table[value].where(table[value] > 0)), np.exp))
        below.set(ylim=_around([*(100 * off["off_curve"]), -5, 5]))
        below.axhspan(-5, 5, color=style.grey(0.9), linewidth=0, zorder=0)
        below.axhline(0, **line)
        axes.legend(loc="best")
    below_left.set_title(fitted)
    below_right.set_title(missed)
    left.set(ylabel=LABELS[up], title=TITLES[across])
    right.set(ylabel="share of full contact [1]", title="3D: roughness alone")
    below_left.set(xlabel=LABELS[across], ylabel="off the curve [%]")
    below_right.set(xlabel=r"$x = p\,/\,p_\mathrm{rms}$ [1]", ylabel="off S(x) [%]")
    lettered(panels.flat)
    style.decades(left, right)
    place = {"location": "bottom", "aspect": 60, "shrink": 0.7, "fraction": 0.03, "pad": 0.02}
    shades.bar(drawing, panels, shades.SPEED, scale, "speed [m/s]", **place)
    grey: dict[str, Any] = {"linestyle": "none", "color": style.grey(0.3), "markersize": style.mark(0.75)}
    handles = [Line2D([], [], marker=markers[name], label=literal(name), **grey) for name in names[1:] and names]
    if (points["height_over_depth"] > claimed).any():
        handles.append(
            Line2D([], [], marker="o", label=f"h$_0$ > {claimed:g} d", **grey, markerfacecolor=style.paper())
        )
    if handles:
        style.legend(drawing, handles, "outside lower center", 4)
    clear(drawing, (left, right))
    return drawing


def _hollow() -> dict[str, Any]:
    """Looks of points of which nothing is claimed."""
    return {"markerfacecolor": style.paper(), "elinewidth": style.width(0.35), "zorder": 1.5}


def _around(values, of=np.asarray) -> tuple[float, float]:
    """Ends of an axis around numbers, whatever their intervals, in which these may be cut off."""
    known = np.asarray(values, float)
    low, high = np.nanmin(known), np.nanmax(known)
    room = 0.12 * (high - low)
    return float(of(low - room)), float(of(high + room))


def _missed(findings) -> str:
    """Misfit from the law in words; empty where it is not known."""
    told = {"law3d.collapse": "median", "law3d.collapse-most": "nine in ten"}
    own = {each.claim.id: 100 * each.value for each in findings if np.isfinite(each.value)}
    return ", ".join(f"{word} {number(own[name], 2)} %" for name, word in told.items() if name in own)


def _off(points: DataFrame, name: str, expected) -> DataFrame:
    """ln of points and of the ends of their intervals over what is expected."""
    with np.errstate(invalid="ignore", divide="ignore"):
        columns = {
            f"off_curve{end}": np.log(points[f"{name}{end}"].where(lambda value: value > 0) / expected)
            for end in ("", "_low", "_high")
        }
    return DataFrame(columns)
