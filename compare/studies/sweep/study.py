"""A rectangle of a scene of one's own in both dimensionalities: `compare.sweep`."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from math import isfinite
from typing import Any

import xarray
from matplotlib.figure import Figure
from pandas import DataFrame

from scene import Indent, Scene, Slide, notes
from scene.motion import PRESSES, UNITS
from scene.plain import one_by_one
from scene.printable import brief
from scene.quantities import SPEED
from scene.reading import InvalidInput, whole

from ...library.case import Case, doubted
from ...library.lookup import Asked, case_of
from ...report.page import Block, Plot, Table
from ...solving.cost import MOST_DRAWS, MOST_VALUES
from ...solving.parameter_grid import Rectangle, on_two_grids
from ...solving.vocabulary import attributes
from ...statistics.finding import Claim, Finding
from ...statistics.jackknife import judge, mean
from ...statistics.means import interval
from ..study import Study
from . import figure as plots

SOLVERS = ("MDR", "BEM")
# Means over draws, by the names of a sweep: of a variable, or of one over another.
MEANS = {
    "friction": ("friction_force", "normal_force"),
    "force": ("normal_force", None),
    "reached": ("depth_reached", None),
}


@dataclass(frozen=True)
class Sweep(Study):
    """Contacts of one scene at every speed and every load or depth.

    case : the scene with the settings of both solvers; its motion says whether a load or a depth is prescribed
    speeds, values : [m/s]; [N] or [m]
    draws : rough surfaces, and as many profiles
    """

    case: Case
    speeds: tuple[float, ...]
    values: tuple[float, ...]
    draws: int

    command, title = "sweep", "A sweep in one and in three dimensions"

    @classmethod
    def of(
        cls,
        scene: Asked,
        speed: Sequence[float],
        load: Sequence[float] | None = None,
        depth: Sequence[float] | None = None,
        draws: int = 8,
    ) -> "Sweep":
        """The sweep of a scene, a case, a file or a ready scene. Raises InvalidInput, Refused."""
        case = case_of(scene)
        if load is not None and depth is not None:
            raise InvalidInput("load, depth: both given, give one of them")
        name, values = ("load", load) if depth is None else ("depth", depth)
        if values is None:
            name, values = case.motion.pressed_by, [case.motion.greatest]
        speeds = _numbers("speed", speed, least=0.0)
        prescribed = _numbers(name, values)
        draws = whole("draws", draws, MOST_DRAWS)
        pressed: dict[str, Any] = {name: prescribed[0]}
        moving = max(speeds)
        motion = Slide(speed=moving, **pressed) if moving else Indent(**pressed)
        asked = cls(replace(case, motion=motion), speeds, prescribed, draws)
        asked.rectangles()["contacts"].refuse()
        return asked

    @property
    def inputs(self) -> Mapping[str, Any]:
        return {"speed": self.speeds, self.case.motion.pressed_by: self.values, "draws": self.draws}

    @property
    def notes(self) -> tuple[str, ...]:
        return notes(self.case.scene)

    @property
    def doubts(self) -> tuple[str, ...]:
        """Doubts about the contacts at the corners of the sweep, each number and limit once."""
        scenes = [each for rectangle in self.rectangles().values() for each in rectangle.corners]
        return doubted(*(replace(self.case, motion=each.motion) for each in scenes))

    def rectangles(self) -> Mapping[str, Rectangle]:
        scene: Scene = self.case.scene
        return {
            "contacts": Rectangle(
                scene=scene,
                speeds=self.speeds,
                values=self.values,
                grids=on_two_grids(self.case.mdr, self.case.bem),
                draws={self.case.mdr.name: self.draws, self.case.bem.name: self.draws},
            )
        }

    def findings(self, answers: xarray.DataTree) -> list[Finding]:
        """Friction, or force, of 1D over 3D at every contact, reported without a claim."""
        prescribed = self.case.motion.pressed_by
        name = "friction" if max(self.speeds) > 0 else "force" if prescribed == "depth" else "reached"
        above, below = MEANS[name]
        found = []
        for i, speed in enumerate(self.speeds):
            for j, value in enumerate(self.values):

                def ratio(sample, i=i, j=j):
                    one, three = (mean(sample[f"contacts/{solver}"], above, below) for solver in SOLVERS)
                    return float(one[i, j] / three[i, j])

                claim = Claim(
                    f"sweep.{name}",
                    f"The {name.replace('reached', 'depth')} in 1D over that in 3D",
                    meaning="Ratio of the means over draws.",
                    curves=("contacts",),
                    measure=ratio,
                )
                found.append(judge(claim, answers, f"{speed:g} m/s, {value:g} {UNITS[prescribed]}"))
        return found

    def dataset(self, answers: xarray.DataTree) -> xarray.Dataset:
        """Everything solved as one Dataset with the dimension solver, and means with intervals of 95 %."""
        parts = [
            self._with_means(answers.children["contacts"].children[solver].to_dataset()) for solver in SOLVERS
        ]
        joined = xarray.concat(
            parts, xarray.Variable("solver", list(SOLVERS), attributes("solver")), data_vars="all", join="outer"
        )
        return joined.assign_attrs(prescribed=self.case.motion.pressed_by)

    def _with_means(self, dataset):
        """One solver with its means; the points of a grid, which differ between solvers, as a variable."""
        for name, (above, below) in MEANS.items():
            for end, values in interval(dataset, above, below)._asdict().items():
                label = name if end == "value" else f"{name}_{end}"
                dataset[label] = ("speed", self.case.motion.pressed_by), values, attributes(label)
        return dataset.reset_coords("points").drop_attrs(deep=False)

    def plots(self, answers: xarray.DataTree, findings: Sequence[Finding]) -> list[Plot]:
        return [plots.plot(means(self.dataset(answers)))] if max(self.speeds) > 0 else []

    def blocks(
        self, answers: xarray.DataTree, findings: Sequence[Finding], plots: Sequence[Plot]
    ) -> Sequence[Block]:
        return [
            *super().blocks(answers, findings, plots),
            Table("means", means(self.dataset(answers)), "Means over draws with intervals of 95 %."),
        ]


def means(dataset: xarray.Dataset) -> DataFrame:
    """Means of a sweep with their intervals of 95 %: a row for each solver, speed, and load or depth."""
    names = [f"{name}{end}" for name in MEANS for end in ("", "_low", "_high")]
    return dataset[names].to_dataframe().reset_index()


def figure_of(dataset: xarray.Dataset) -> Figure:
    """Friction of a sweep against speed, or against load if there is one speed: a matplotlib Figure."""
    return plots.plot(means(dataset)).figure()


def _numbers(name, values, least=None):
    """Distinct finite numbers in SI as a tuple. Raises InvalidInput."""
    unit = SPEED if name == "speed" else PRESSES[name]
    single = isinstance(values, str) or getattr(values, "ndim", None) == 0 or not isinstance(values, Iterable)
    try:
        given = [values] if single else list(islice(one_by_one(values), MOST_VALUES + 1))
    except ValueError as error:
        raise InvalidInput(f"{name}: {error}") from None
    if len(given) > MOST_VALUES:
        raise InvalidInput(f"{name}: more than {MOST_VALUES:,} values: at most so many are solved at")
    found = [_number(name, value, unit, least) for value in given]
    if not found or len(set(found)) < len(found):
        raise InvalidInput(f"{name} = {brief(repr(given))}: at least one, and each once")
    return tuple(sorted(found))


def _number(name, given, unit, least):
    """One of them. Raises InvalidInput."""
    allowed = "finite numbers of zero or more" if least == 0 else "finite numbers above zero"
    try:
        value = float(unit.value(given))
        wrong = "" if isfinite(value) and (value > 0 or value == least) else allowed
    except OverflowError:  # of a whole number beyond those of floating point
        wrong = allowed
    except ValueError as error:
        wrong = f"{allowed}, {str(error).removeprefix('Input should be ')}"
    if wrong:
        raise InvalidInput(f"{name} = {brief(repr(given))}: {wrong}")
    return value
