"""A parameter grid of a scene of one's own in both dimensionalities: `compare.sweep`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure
from pandas import DataFrame

from scene import Indent, Slide, notes
from scene.motion import UNITS
from scene.printable import brief
from scene.reading import InvalidInput, whole
from scene.result import provenance

from ...figures import friction_load, friction_speed
from ...figures.rendering import finished
from ...library.case import Case, doubted, share_of
from ...library.lookup import SceneLike, case_of
from ...models.table import ModelLike, Models
from ...report.page import Plot, Table
from ...solving.control_variates import VARIATES
from ...solving.cost import MOST_DRAWS
from ...solving.parameter_grid import COARSE, FINE, LEVELS, ParameterGrid, on_two_grids
from ...solving.vocabulary import attributes
from ...solving.words import sentences
from ...statistics.finding import Claim, Finding, said_of
from ...statistics.jackknife import DrawSet, mean, measured
from ...statistics.means import interval
from ...statistics.multilevel import GROWTH, MEANS, WORDS, in_strata, needed, pooled, unreached, wanted
from ..run.curves import models_of
from ..study import Judgement, Study
from .values import Values, values_of

FEW = 8  # draws where nothing is asked


@dataclass(frozen=True)
class Sweep(Study):
    """Contacts of one scene at every speed and every load or depth.

    case : the scene with the settings of both solvers; its motion says whether a load or a depth is prescribed
    speeds, values : [m/s]; [N] or [m]
    draws : rough surfaces, and as many profiles
    models : of which each but the reference is compared with that
    interval : half-width of the intervals of 95 % that is wanted of each mean, relative; None of fixed draws
    strata : then numbers of surfaces on each grid by model, see `ParameterGrid`
    """

    case: Case
    speeds: tuple[float, ...]
    values: tuple[float, ...]
    draws: int
    models: Models
    interval: float | None = None
    strata: Mapping[str, tuple[int, ...]] = field(default_factory=dict)

    command, title = "sweep", "A sweep in one and in three dimensions"

    @classmethod
    def of(
        cls,
        scene: SceneLike,
        speed: Values | None = None,
        load: Values | None = None,
        depth: Values | None = None,
        draws: int | None = None,
        models: Sequence[ModelLike] | None = None,
        reference: str | None = None,
        interval: float | str | None = None,
    ) -> "Sweep":
        """The sweep of a scene, a case, a file or a ready scene. Raises InvalidInput, Refused."""
        case = case_of(scene)
        case.refuse()
        if load is not None and depth is not None:
            raise InvalidInput("load, depth: both given, give one of them")
        name, values = ("load", load) if depth is None else ("depth", depth)
        if values is None:
            name, values = case.motion.pressed_by, [case.motion.greatest]
        speeds = values_of("speed", case.motion.speed if speed is None else speed, least=0.0)
        prescribed = values_of(name, values)
        if draws is not None and interval is not None:
            raise InvalidInput("draws, interval: both given, give one of them")
        drawn = whole("draws", FEW if draws is None else draws, MOST_DRAWS)
        pressed: dict[str, Any] = {name: prescribed[0]}
        moving = max(speeds)
        motion = Slide(speed=moving, **pressed) if moving else Indent(**pressed)
        compared = models_of(case, models, reference)
        half = None if interval is None else share_of("interval", interval)
        asked = cls(replace(case, motion=motion), speeds, prescribed, drawn, compared, half)
        asked._grid.refuse()
        return asked

    @property
    def inputs(self) -> Mapping[str, Any]:
        wanted = {"draws": self.draws} if self.interval is None else {"interval": self.interval}
        return {"speed": self.speeds, self.case.motion.pressed_by: self.values, **wanted}

    @property
    def notes(self) -> tuple[str, ...]:
        return notes(self.case.scene)

    @property
    def doubts(self) -> tuple[str, ...]:
        """Doubts about the contacts at the corners of the sweep, each number and limit once."""
        scenes = [each for grid in self.grids().values() for each in grid.corners]
        return doubted(*(replace(self.case, motion=each.motion) for each in scenes))

    def grids(self) -> Mapping[str, ParameterGrid]:
        return {"contacts": self._grid}

    @cached_property
    def _grid(self) -> ParameterGrid:
        fixed = ParameterGrid(
            scene=self.case.scene,
            speeds=self.speeds,
            values=self.values,
            grids=on_two_grids(*(each.solver for each in self.models)),
            draws={each.name: each.count(self.draws, self.draws) for each in self.models},
        )
        if self.interval is None or not fixed.random:
            return fixed
        return in_strata([fixed], self.models, self.strata)[0]

    def more(
        self, answers: xarray.DataTree, findings: Sequence[Finding], growth: float = GROWTH
    ) -> "Sweep | None":
        """The sweep with the surfaces that the wanted interval asks for; None once it is reached."""
        if self.interval is None:
            return None
        had, asked = self._sampled, {}
        for name in had:
            costs = self._grid.costs[name]
            counts = [
                needed(points, *MEANS[quantity], costs, self.interval, growth)
                for quantity, points in self._wanted(name, answers)
            ]
            asked[name] = tuple(map(max, zip(*counts, strict=True)))
        return None if asked == had else replace(self, strata=asked)

    @property
    def _sampled(self):
        """Numbers of surfaces by model, of those in strata."""
        return {name: each for name, each in self._grid.draws.items() if isinstance(each, tuple)}

    def _wanted(self, name, answers):
        """Means that an interval is wanted of, each with its points of one model."""
        dataset = answers["contacts"].children[name].to_dataset(inherit=False)
        for quantity, speeds in wanted(self.case.motion.pressed_by, self.speeds, self.case.slides):
            yield quantity, dataset.sel(speed=list(speeds))

    def _unreached(self, answers):
        """Sentences on means whose intervals are wider than wanted."""
        for name in self._sampled:
            for quantity, points in self._wanted(name, answers):
                if why := unreached(points, *MEANS[quantity], self.interval):
                    yield f"The {WORDS[quantity]} in {self.models.labels[name]} {why}."

    def judge(self, answers: xarray.DataTree) -> Judgement:
        """Friction, else force or depth, of each model over the reference at every contact, without a claim."""
        findings, dataset = list(self._findings(answers)), self.dataset(answers)
        plot = plots_of(means(dataset), self._ratios(findings)) if max(self.speeds) > 0 else []
        answer = [*sentences(findings), *self._unreached(answers)]
        return Judgement(findings, answer, [*plot, *self._tables(dataset, findings)], self.setting)

    def _tables(self, dataset, findings) -> Iterator[Table]:
        """Friction, and depth or force, a row a contact and a column a model; what is judged also as a ratio."""
        prescribed = self.case.motion.pressed_by
        places = DataFrame(list(product(self.speeds, self.values)), columns=["speed", prescribed])
        for quantity, speeds in reversed([*wanted(prescribed, self.speeds, max(self.speeds) > 0)]):
            frame = places.copy()
            answering = [each for each in self.models if WORDS[quantity] in each.answers]
            for model, end in product(answering, ("_mean", "_low", "_high")):
                values = dataset[f"{quantity}{end}"].sel(solver=model.name).values.ravel()
                frame[f"{quantity} ({model.label}){end.removeprefix('_mean')}"] = values
            own = [each for each in findings if each.claim.id == f"sweep.{WORDS[quantity]}"]
            for beside in dict.fromkeys(each.dimension for each in own):
                rows = [(each.value, *each.interval) for each in own if each.dimension == beside]
                frame[[beside, f"{beside}_low", f"{beside}_high"]] = rows
            told = f"Mean {WORDS[quantity]} at every contact, with intervals of 95 %."
            yield Table(f"means-{WORDS[quantity]}", frame[frame["speed"].isin(speeds)], told)

    def _ratios(self, findings):
        """Friction of each model over that of the reference at every contact, from its findings."""
        names = {self.models.beside(each.name): each.name for each in self.models.judged}
        places, body = list(product(self.speeds, self.values)), "rough" if self.case.roughness else "smooth"
        rows = [
            (names[each.dimension], body, *place, each.value, *each.interval)
            for place, own in zip(places, np.array_split(np.array(findings, object), len(places)), strict=True)
            for each in own
        ]
        columns = ["solver", "body", "speed", self.case.motion.pressed_by, "ratio", "ratio_low", "ratio_high"]
        return DataFrame(rows, columns=columns)

    @property
    def _reference(self):
        return self.models[self.models.reference]

    def _findings(self, answers):
        prescribed = self.case.motion.pressed_by
        name = (
            "friction_coefficient"
            if max(self.speeds) > 0
            else "normal_force"
            if prescribed == "depth"
            else "depth_reached"
        )
        word = WORDS[name]
        above, below = MEANS[name]
        nodes = answers["contacts"].children
        drawn = {each: pooled(nodes[each].to_dataset(inherit=False)) for each in self.models.labels}
        both = [each for each in self.models.judged if {word} <= {*each.answers} & {*self._reference.answers}]
        for (i, speed), (j, value), model in product(enumerate(self.speeds), enumerate(self.values), both):
            solvers = model.name, self.models.reference

            def ratio(sample, i=i, j=j, solvers=solvers):
                one, three = (mean(sample[solver], above, below) for solver in solvers)
                return float(one[i, j] / three[i, j])

            beside = self.models.beside(model.name)
            claim = said_of(
                Claim(
                    f"sweep.{word}",
                    f"The {word} in 1D over that in 3D",
                    meaning="Ratio of the means over draws.",
                    measure=ratio,
                ),
                beside,
            )
            fine, coarse = (self._draws(drawn, grid, solvers) for grid in (FINE, COARSE))
            where = f"{speed:g} m/s, {value:g} {UNITS[prescribed]}"
            yield replace(measured(claim, fine, coarse, where), dimension=beside)

    @staticmethod
    def _draws(drawn, grid, solvers):
        return DrawSet(
            {each: drawn[each].sel(level=grid if grid in drawn[each]["level"] else FINE) for each in solvers}
        )

    def dataset(self, answers: xarray.DataTree) -> xarray.Dataset:
        """Everything solved as one Dataset with the dimension solver, and means with intervals of 95 %."""
        parts = [
            self._with_means(answers.children["contacts"].children[solver].to_dataset())
            for solver in self.models.labels
        ]
        joined = xarray.concat(
            parts,
            xarray.Variable("solver", list(self.models.labels), attributes("solver")),
            data_vars="all",
            coords="minimal",  # what answers for all surfaces at once has no seed
            compat="override",
            join="outer",
        )
        grids = [grid for grid in LEVELS if grid in joined["level"]]  # which joining may have sorted
        seeds = joined["surface"].values if "surface" in joined else ()
        about = provenance(self.case.scene, seeds)
        return joined.sel(level=grids).assign_attrs(about, prescribed=self.case.motion.pressed_by)

    def _with_means(self, dataset):
        """One solver with its means; the points of a grid, which differ between solvers, as a variable."""
        for name, (above, below) in MEANS.items():
            for end, values in interval(pooled(dataset), above, below)._asdict().items():
                label = f"{name}_{'mean' if end == 'value' else end}"
                dataset[label] = ("speed", self.case.motion.pressed_by), values, attributes(label)
        dataset = dataset.drop_vars(VARIATES, errors="ignore")
        return dataset.reset_coords("points").drop_attrs(deep=False)


def means(dataset: xarray.Dataset) -> DataFrame:
    """Means of a sweep with their intervals of 95 %: a row for each solver, speed, and load or depth."""
    names = [f"{name}{end}" for name in MEANS for end in ("_mean", "_low", "_high")]
    return dataset[names].to_dataframe().reset_index()


def figure_of(dataset: xarray.Dataset) -> Figure:
    """Friction of a sweep against speed, or against load if there is one speed: a matplotlib Figure."""
    if not isinstance(dataset, xarray.Dataset):
        raise InvalidInput(f"dataset = {brief(repr(dataset))}: the Dataset of a sweep is needed")
    return finished(plots_of(means(dataset))[0])


def plots_of(means: DataFrame, ratios: DataFrame | None = None) -> list[Plot]:
    """Friction against speed, and against load or depth, of the means of a sweep."""
    sliding, pressed = means[means["speed"] > 0], "load" if "load" in means else "depth"
    caption = (
        "Coefficient of friction of every model. Bars are intervals of 95 %: scatter of the draws, widened by the "
        "change on halving the grid."
    )
    plots = []
    if sliding["speed"].nunique() > 1 or means[pressed].nunique() == 1:
        plots.append(friction_speed.plot(sliding, ratios, caption=caption))
    if means[pressed].nunique() > 1:
        plots.append(friction_load.plot(sliding, caption=caption))
    return [each for each in plots if each]
