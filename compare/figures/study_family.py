"""Friction over its plateau against the one variable of Eq. 18, all series of a shape together."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mdr1d.equations import interpolation

from ..studies.families import families, reduced
from ..studies.judgement import JudgedStudy
from ..studies.points import mean_of, mean_ratio
from ..studies.series import ROUGH
from ..verdict import DIMENSIONS
from ..plots import shades, style

NAME = "study-family"


def figure(judged: JudgedStudy) -> Figure | None:
    """Rows: shapes. Columns: 1D, 3D. None unless several series of a shape slide."""
    found = families(judged.series)
    if not found:
        return None
    most = max(map(len, found.values()))
    drawing = style.canvas("double", 0.3 + len(found) * (2.6 + 0.16 * -(-most // 2)))
    bands = drawing.subfigures(len(found), 1, squeeze=False)[:, 0]
    for band, (shape, members) in zip(bands, found.items(), strict=True):
        panels = band.subplots(1, 2, sharex=True, sharey=True)
        for axes, solver in zip(panels, DIMENSIONS, strict=True):
            _points(axes, members, solver)
            axes.set(xlabel=r"$\xi$ [1]", title=f"{style.LABEL[solver]}, {shape}")
            style.decades(axes)
        panels[0].set_ylabel(r"friction over its plateau [1]")
        style.legend(band, panels[0].get_legend_handles_labels()[0], "outside lower center", 2)
    return drawing


def sheets(judged: JudgedStudy) -> dict[str, list[dict]]:
    """Every point."""
    rows: list[dict] = []
    for members in families(judged.series).values():
        for solver, dimension in DIMENSIONS.items():
            for each, xi, mu, error in _reduced(members, solver):
                rows.extend(
                    {
                        "series": each.solved.series.name,
                        "dimension": dimension,
                        "xi": x,
                        "friction_over_plateau": y,
                        "friction_over_plateau_error": bar,
                    }
                    for x, y, bar in zip(xi, mu, error, strict=True)
                )
    return {NAME: rows} if rows else {}


def caption(judged: JudgedStudy) -> str:
    """What the figure shows."""
    return (
        "Friction over that of the plateau, Eq. 14, against ξ of Eq. 18 with the loss at the shortest wave and "
        "the rms slope as each dimensionality has it: means over surfaces with standard errors, a marker for "
        "each series. Line: Eq. 19 with α = 1.5. If roughness and solid count through ξ alone, all markers lie "
        "on one curve."
    )


def _reduced(members, solver):
    """Each series with xi, friction over the plateau, and its standard error, (points,)."""
    samples = reduced(members, solver)
    for each, load, friction in zip(members, samples.load, samples.friction_force, strict=True):
        answers = mean_of(each.solved(solver), ROUGH, "normal_force")
        mu, count = mean_ratio(friction, load), answers.value.size
        yield each, 1 / mean_ratio(load).value[:count], mu.value[:count], mu.error[:count]


def _points(axes: Axes, members, solver):
    everywhere = []
    for index, (each, xi, mu, error) in enumerate(_reduced(members, solver)):
        axes.errorbar(
            xi,
            mu,
            yerr=np.nan_to_num(error),
            color=shades.PRESS(index / max(1, len(members) - 1)),
            marker=style.SERIES_MARKERS[index % len(style.SERIES_MARKERS)],
            markersize=style.mark(0.75),
            markerfacecolor="none" if index >= len(style.SERIES_MARKERS) else None,
            linestyle="none",
            elinewidth=style.width(0.55),
            capsize=0,
            label=each.solved.series.title,
        )
        everywhere.append(xi[np.isfinite(xi)])
    found = np.concatenate(everywhere)
    if found.size:
        xi = np.geomspace(found.min(), found.max(), 101)
        axes.plot(
            xi, interpolation(xi), "-", color=style.ink(), linewidth=style.width(0.8), zorder=1, label="Eq. 19"
        )
    axes.set(xscale="log", yscale="log")
