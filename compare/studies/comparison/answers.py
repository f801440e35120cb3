"""Answers of a scene on its curves, by model, samples of them, and theories that accompany the models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from scene import SolveError, Solver
from scene.protocol import numeric_guard, why_not

from ...models.law.persson import Persson
from ...models.table import NONE, PROFILES, SURFACES, Model, Models
from ...solving.curve import COARSE, FINE, Curve, of_model
from ...statistics import means
from ...statistics.intervals import Estimated
from ...statistics.jackknife import DrawSet, compared
from ...statistics.multilevel import pooled
from ...trustmap.friction_law import FrictionLaw

if TYPE_CHECKING:
    import xarray
    from pandas import DataFrame

THEORY, LAW = THEORIES = Persson(), FrictionLaw()


def with_theory(curve: Curve, theories: Sequence[Solver] = (THEORY,)) -> Curve:
    """The curve with the models and all theories that answer all of it and are not among the models."""
    added = {
        each.name: {FINE: each} for each in theories if each.name not in curve.levels and _answers(each, curve)
    }
    return replace(curve, levels={**curve.levels, **added})


def _answers(theory, curve):
    """Whether a theory answers a curve; not where its numbers are too far apart, which others tell."""
    motion = curve.scene.motion
    if not Model.of(theory).tells(motion.pressed_by, motion.speed > 0):
        return False
    try:
        with numeric_guard():
            return not any(why_not(theory, scene) for scene in curve.corners)
    except SolveError:
        return False


# Variable of real contact by what is drawn [m], [m²].
CONTACT = {PROFILES: "contact_length", SURFACES: "contact_area", NONE: "contact_area"}
# Variables that claims are measured on; others are not copied for every surface that is left out.
MEASURED = (
    "normal_force",
    "friction_force",
    "depth_reached",
    "friction_spread",
    "curvature_by_pressure",
    "rms_slope_contact",
    "contact_length",
    "contact_area",
    *means.STATED,
)


@dataclass(frozen=True)
class Answers:
    """Answers of a scene.

    curves : Datasets of its curves by name
    models : that are compared; others, as theories, have answers too
    """

    curves: Mapping[str, xarray.Dataset]
    models: Models
    _kept: dict[Any, Any] = field(default_factory=dict, init=False, repr=False, compare=False)

    def has(self, curve: str, model: str) -> bool:
        """Whether a model was asked for answers on a curve."""
        return curve in self.curves and model in self.curves[curve]["model"].values

    def all_levels(self, curve: str, model: str) -> xarray.Dataset:
        """Answers of a model, every surface by itself on its levels."""

        def made():
            own = of_model(self.curves[curve], model)
            return means.with_spread(own if "speed" in own.dims else own.expand_dims(speed=[0.0], axis=1))

        return self._once(("all", curve, model), made)

    def two_levels(self, curve: str, model: str) -> xarray.Dataset:
        """Surfaces whose means on the fine and on the coarse level are those of all levels, see `multilevel`."""
        return self._once(("two", curve, model), lambda: pooled(self.all_levels(curve, model)))

    def __call__(self, curve: str, model: str, level: str = FINE) -> xarray.Dataset:
        """Answers of a model on one of both levels; those of a model without a grid are the same on both."""
        found = self.two_levels(curve, model)
        return found.sel(level=level if level in found["level"] else FINE)

    def sample(self, level: str, curve: str, *models: str) -> DrawSet:
        """Answers by model, with surfaces that can be left out; the same object each time, as it caches them."""

        def made():
            found = {each: self(curve, each, level) for each in models}
            return DrawSet({name: each[[own for own in MEASURED if own in each]] for name, each in found.items()})

        return self._once((level, curve, models), made)

    def halved(self, curve: str, *models: str) -> bool:
        """Whether the error of the grid is known of models: on half the points, or of those without a grid."""
        both = [self.two_levels(curve, each) for each in models]
        return all(COARSE in each["level"] or not each["points"].any() for each in both)

    def compared(self, curve: str, models: tuple[str, ...], measure: Any, size: bool = False) -> Estimated:
        """Numbers of a curve, a measure of samples, with scatter and error of the grid.

        The latter is not known where the surface of a model with a grid is another one on half its points. Of a
        model over the reference it counts the interval that the reference states of its own friction.
        """
        fine, reference = self.sample(FINE, curve, *models), self.models.reference
        coarse = self.sample(COARSE, curve, *models) if self.halved(curve, *models) else None
        found = compared(measure, fine, coarse, size)
        upper = means.at_upper_end(fine[reference]) if reference in models[1:] else None
        if upper is None:
            return found
        return replace(found, grid=found.grid + abs(measure({**fine, reference: upper}) - found.value))

    def interval(self, curve: str, model: str, above: str, below: str | None = None) -> Estimated:
        """Means of a variable, or over those of another, at every place of a curve, with intervals of 95 %."""
        return means.interval(self.two_levels(curve, model), above, below)

    def claiming(self, curve: str, quantity: str) -> list[Model]:
        """Models of a curve with a claim on a quantity."""
        return [each for each in self.models if quantity in each.answers and self.has(curve, each.name)]

    def judged(self, curve: str, quantity: str) -> list[Model]:
        """Models of a curve that are compared with the reference; none where the reference has no answer."""
        found = {each.name: each for each in self.claiming(curve, quantity)}
        return list(found.values()) if found.pop(self.models.reference, None) else []

    def _once(self, key, made):
        if key not in self._kept:
            self._kept[key] = made()
        return self._kept[key]

    @cached_property
    def points(self) -> DataFrame:
        """A row for each curve, model, speed, and load or depth: means over surfaces, intervals of 95 %."""
        every = self._stacked(self._points)
        first = [name for name in ("curve", "model", "points", "speed", "load", "depth") if name in every]
        return every[[*first, *every.columns.difference(first, sort=False)]]

    @property
    def failures(self) -> DataFrame:
        """Every solve that failed, with its reason."""
        return self._stacked(lambda *place: means.failures(self.all_levels(*place)))

    def _points(self, curve, model):
        dataset, draws = self.all_levels(curve, model), {each.name: each.draws for each in self.models}
        touching = CONTACT[draws.get(model, NONE)]
        return means.means(dataset.assign(contact=dataset[touching]) if touching in dataset else dataset)

    def _stacked(self, table):
        """Tables of every model on every curve, one below the other, with both names in the first columns."""
        from pandas import DataFrame, concat

        places = [(name, model) for name, each in self.curves.items() for model in each["model"].values.tolist()]
        frames = [DataFrame({"curve": place[0], "model": place[1]} | dict(table(*place))) for place in places]
        return concat([each for each in frames if len(each)] or frames[:1], ignore_index=True)
