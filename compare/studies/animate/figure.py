"""A program instant by instant: pressure from above, sections in both dimensionalities, and what came before."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from scene import Cylinder

from ...report.plots import shades, style, touching
from ...report.plots.contact_maps import TITLES
from ...report.plots.prefixes import prefixed
from .film import Film

HISTORIES = {"normal_force": "normal force", "friction_force": "friction"}
ROOM = 0.08  # above and below a history, of what it spans


class MarchFigure:
    """One figure that shows a film instant by instant, every scale the same throughout.

    Left: pressure in 3D. Right: its section y = 0, and the 1D contact. Below: forces.

    drawing : the matplotlib Figure
    """

    def __init__(self, film: Film):
        self.film = film
        self._solvers = [solver for solver in ("BEM", "MDR") if solver in film.fields]
        rows, maps = len(self._solvers), "BEM" in film.fields
        self.drawing = style.canvas("double", 2.6 + rows)
        above, below = self.drawing.subfigures(2, 1, squeeze=False, height_ratios=(1.1 * rows + 0.6, 1.1))[:, 0]
        columns = above.add_gridspec(rows, 1 + maps, width_ratios=(1, 1.5) if maps else (1,))
        self._map = above.add_subplot(columns[:, 0]) if maps else None
        self._sections = [above.add_subplot(columns[row, -1]) for row in range(rows)]
        histories = below.subplots(1, len(HISTORIES))
        instants = range(len(film.times))
        seen = [_section(film, solver, k) for solver in self._solvers for k in instants]
        self._heights = touching.heights(seen, film.span)
        self._highest = touching.highest_pressure(film.fields["BEM"]["frame_pressure"]) if maps else 1.0
        if self._map is not None:
            self._lay_out_map(self._map, above)
        self._past: list[tuple[Line2D, np.ndarray, np.ndarray]] = []
        for axes, name in zip(histories, HISTORIES, strict=True):
            self._lay_out_history(axes, name)
        histories[0].legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, borderaxespad=0.2)

    def show(self, k: int) -> None:
        """Draw the k-th instant in place of the one before."""
        film = self.film
        scale, unit = prefixed(film.times[-1], "s")
        when, passed = f"t = {scale * film.times[k]:.3g} {unit}", float(film.scene.motion.path(film.times[k]))
        if self._map is not None:
            self._show_pressure(self._map, k)
            self._map.set_title(f"3D: pressure, {when}")
        for axes, solver in zip(self._sections, self._solvers, strict=True):
            _clear(axes)
            seen, title = _section(film, solver, k), TITLES[solver]
            row = passed if solver == "MDR" else None
            touching.section(axes, seen, solver, film.span, self._heights, row)
            axes.set_title(title if self._map is not None else f"{title}, {when}")
            touching.exaggeration(axes, film.span, self._heights)
            if axes is not self._sections[-1]:
                axes.set_xlabel("")
            if not seen.touching.any():
                touching.remark(axes, "nothing touches here")
        for line, time, values in self._past:
            past = time <= scale * film.times[k] * (1 + 1e-9)
            line.set_data(time[past], values[past])

    def _lay_out_map(self, axes: Axes, drawing):
        """Axes of the pressure and the bar of its colours, of all instants."""
        film, y = self.film, self.film.fields["BEM"]["y"]
        (along, unit), (up, name) = prefixed(film.span, "m"), prefixed(self._highest, "Pa")
        if len(y) > 1:
            image = touching.pressure_map(axes, y, y, np.zeros((len(y), len(y))), up * self._highest)
            place = {"ax": axes, "location": "bottom", "extend": "max", "aspect": 30}
            shades.colours(drawing, image, f"pressure [{name}]", **place)
            half = (y[1] - y[0]) / 2
            axes.set(ylim=(along * (y[0] - half), along * (y[-1] + half)), ylabel=f"y [{unit}]")
        else:
            axes.set(ylim=(0, 1.05 * up * self._highest), ylabel=f"pressure [{name}]")
        axes.set(xlim=[along * end for end in film.span], xlabel=f"x [{unit}]")

    def _show_pressure(self, axes: Axes, k):
        seen, film = self.film.space(k), self.film
        _clear(axes)
        (along, _), (up, _) = prefixed(film.span, "m"), prefixed(self._highest, "Pa")
        limits = axes.get_xlim(), axes.get_ylim()
        if len(seen.y) > 1:
            touching.pressure_map(axes, along * seen.x, along * seen.y, up * seen.pressure, up * self._highest)
            touching.edge(axes, film.radius and along * film.radius, style.ink())
        else:
            axes.plot(along * seen.x, up * seen.pressure[0], color=style.COLOUR["BEM"])
            if isinstance(film.scene.indenter, Cylinder):
                touching.sides(axes, film.radius and along * film.radius)
        axes.set(xlim=limits[0], ylim=limits[1])
        stages = film.scene.motion.stages
        ends = np.cumsum([stage.duration for stage in stages])
        way = touching.flow(stages[min(int(np.searchsorted(ends, film.times[k])), len(ends) - 1)].speed)
        touching.remark(axes, way if (seen.pressure > 0).any() else f"{way}, nothing touches")

    def _lay_out_history(self, axes: Axes, name):
        """Axes of a force; its curves are kept, to show what is past."""
        film, limits = self.film, self.film.limits(name)
        (scale, seconds), (low, high) = prefixed(film.times[-1], "s"), limits
        up, unit = prefixed(limits, "N/m" if isinstance(film.scene.indenter, Cylinder) else "N")
        for solver in self._solvers:
            (line,) = axes.plot([], [], **style.look(solver, marker=""))
            self._past.append((line, scale * film.fields[solver]["time"], up * film.fields[solver][name]))
        room = ROOM * ((high - low) or 1.0)
        axes.set(xlim=(0, scale * film.scene.motion.duration), ylim=(up * (low - room), up * (high + room)))
        axes.set(xlabel=f"time [{seconds}]", ylabel=f"{HISTORIES[name]} [{unit}]")


def _clear(axes):
    """Remove the curves of an instant; axes and ticks stay, which take longest."""
    for artist in (*axes.lines, *axes.collections, *axes.images, *axes.texts):
        artist.remove()


def _section(film, solver, k):
    """Panel of a solver that the film has."""
    if solver == "MDR":
        return film.line(k)
    seen = film.space(k)
    return None if seen is None else seen.section
