"""Series of a study: one scene at every speed and every load or depth, rough and smooth, on the same surfaces."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

import xarray

from bem3d import BEM
from mdr1d import MDR
from scene import Program, Scene
from scene.reading import InvalidInput

from ...library.describe import slug
from ...models import exact
from ...models.table import PROFILES, ModelLike, Models
from ...solving.parameter_grid import FINE, ParameterGrid, on_two_grids
from ...statistics.jackknife import DrawSet
from ...statistics.multilevel import DrawnSurfaces, in_strata, pooled
from ..theory import THEORIES, with_theory

ROUGH, SMOOTH = BODIES = "rough", "smooth"
# Kinds of claims: shifts of curves (Eq. 23), friction in each dimensionality (Eqs. 14 to 19), depth and force in
# each, all that compares the dimensionalities, and what compares several series.
COLLAPSE, FRICTION, DEPTH, PAIRS, FAMILIES = KINDS = "collapse", "friction", "depth", "dimensions", "families"
SOLVERS = {"MDR": "1D", "BEM": "3D"}
CONTACT = {"profiles": "contact_length", "surfaces": "contact_area", "none": "contact_area"}  # [m], [m²]
# Variables that claims are measured on; others are not copied for every draw that is left out.
MEASURED = ("normal_force", "friction_force", "depth_reached")
SLOW_DRAG = "slow_drag"
AT_REST = (SLOW_DRAG, "curvature_by_pressure", "rms_slope_contact", "contact_length", "contact_area")


@dataclass(frozen=True)
class Series:
    """One rough scene at every speed and every load or depth, and the same body without its roughness.

    name, title : of the folder, and for people
    scene : its motion says whether load or depth is prescribed; that of a Program is pressed in from nothing at a
        constant rate, and all other scenes slide. Every scene is also solved at rest
    speeds : of sliding, or the rates of pressing in [m/s]; none where only rest is asked for
    values : loads [N] or depths [m]
    surfaces, profiles : drawn in three and in one dimension, with the seeds from that of the scene on; where an
        interval is wanted, of a pilot at least so many on its coarsest grid
    bem, mdr : the finer settings; the coarser have half the points, and half the steps in time
    note : what is to be said of it on the page
    claims : which kinds of claims are judged, out of KINDS
    asked, reference : models and the reference among them, see `Models.of`; MDR and BEM if none is asked for
    interval : the half-width that is wanted of intervals of 95 % of claims that are not decided, relative; None of
        fixed numbers
    strata : then numbers of draws on each grid by model, those of a pilot if absent; fewer numbers than grids
        leave out the coarsest
    """

    name: str
    title: str
    scene: Scene
    speeds: tuple[float, ...]
    values: tuple[float, ...]
    surfaces: int
    profiles: int
    bem: BEM
    mdr: MDR
    note: str = ""
    claims: tuple[str, ...] = KINDS
    asked: tuple[ModelLike, ...] = ()
    reference: str = ""
    interval: float | None = None
    strata: Mapping[str, tuple[int, ...]] | None = None

    @property
    def folder(self) -> str:
        """Folder of its figures and tables below that of the page."""
        return slug(self.name)

    @property
    def prescribed(self) -> str:
        """Name of what is prescribed: "load" or "depth"."""
        return self.scene.motion.pressed_by

    @property
    def draws(self) -> dict[str, int]:
        """Number of profiles or surfaces by the name of the model."""
        rough = self.grids[f"{self.name}/{ROUGH}"]
        return {each.name: sum(map(len, rough.strata(each.name))) for each in self.models}

    @property
    def drawn(self) -> DrawnSurfaces:
        """Draws of the rough body, by stratum."""
        return DrawnSurfaces.of([self.grids[f"{self.name}/{ROUGH}"]])

    @cached_property
    def every_model(self) -> Models:
        """Models that are asked for. Raises InvalidInput."""
        return Models.of(self.asked or None, self.reference or None, {"mdr": self.mdr, "bem": self.bem})

    @cached_property
    def models(self) -> Models:
        """Models with a claim on its contacts, which are compared. Raises InvalidInput."""
        return self.every_model.telling(self.prescribed, self.slides)

    @property
    def pressed_in(self) -> bool:
        """Whether speeds are rates of pressing in."""
        return isinstance(self.scene.motion, Program)

    @property
    def slides(self) -> bool:
        """Whether speeds are those of sliding."""
        return bool(self.speeds) and not self.pressed_in

    @cached_property
    def grids(self) -> Mapping[str, ParameterGrid]:
        """Parameter grids of the rough and of the smooth body, by "series/body"; the first speed is rest.

        Raises InvalidInput if the scene has no roughness.
        """
        if self.scene.roughness is None:
            raise InvalidInput(f"{self.title}: a series asks what roughness does, and this scene has none")
        counts = {each.name: each.count(self.profiles, self.surfaces) for each in self.models}
        rough = ParameterGrid(
            scene=self.scene,
            speeds=(0.0, *self.speeds),
            values=self.values,
            grids=on_two_grids(*(each.solver for each in self.models)),
            draws=counts,
        )
        smooth = replace(rough, scene=replace(self.scene, roughness=None))
        if self.interval is not None:
            rough = in_strata([rough], self.models, self.strata or {}, least=counts)[0]
        rough = with_theory(rough, THEORIES) if self.slides else rough
        return {f"{self.name}/{ROUGH}": rough, f"{self.name}/{SMOOTH}": smooth}

    def at(self, value: float, speed: float = 0.0) -> Scene:
        """The rough scene under one load or depth, at rest or at a speed."""
        return self.grids[f"{self.name}/{ROUGH}"].at(value, speed)


@dataclass(frozen=True)
class Contacts:
    """Answers of one series: its Datasets of /series/body/solver, and samples of them for claims."""

    series: Series
    answers: xarray.DataTree

    def __call__(self, solver: str, body: str = ROUGH, grid: str = FINE) -> xarray.Dataset:
        """Draws of one grid, rest first; a model without another grid has no error of it."""
        found = self._pooled[solver, body]
        return found.sel(level=grid if grid in found["level"] else FINE)

    @property
    def labels(self) -> dict[str, str]:
        """Labels of the models by name: 1D, 3D."""
        return self.series.models.labels

    def pairs(self, quantity: str) -> Iterator[tuple[str, str, str]]:
        """Each model and the reference, by name, and their dimension in findings: MDR, BEM, 1D/3D.

        quantity : that both have a claim on
        """
        models = self.series.models
        if quantity in models[models.reference].answers:
            for each in models.judged:
                if quantity in each.answers:
                    yield each.name, models.reference, models.beside(each.name)

    @cached_property
    def datasets(self) -> Mapping[tuple[str, str], xarray.Dataset]:
        """Datasets on all grids, by solver and body."""
        places = {
            (solver, body): f"{self.series.name}/{body}/{solver}" for solver in self.labels for body in BODIES
        }
        nodes = {place: cast(xarray.DataTree, self.answers[path]) for place, path in places.items()}
        return {place: node.to_dataset(inherit=False) for place, node in nodes.items()}

    @property
    def theories(self) -> Mapping[str, xarray.Dataset]:
        """Rough points that slide of theories beside the models, or of the models that they are, by name."""
        nodes = cast(xarray.DataTree, self.answers[f"{self.series.name}/{ROUGH}"]).children
        names = [each.name for each in THEORIES if each.name in nodes]
        return {name: sliding(nodes[name].to_dataset(inherit=False).sel(level=FINE)) for name in names}

    @cached_property
    def _pooled(self):
        return {place: pooled(each.assign(self._drag(*place, each))) for place, each in self.datasets.items()}

    def _drag(self, solver, body, dataset):
        """Friction force over speed and mean lag, as the speed tends to zero, from the contact at rest [N/m]."""
        force, by_curvature = dataset["normal_force"], "curvature_by_pressure" in dataset
        if self.series.models[solver].draws != PROFILES and by_curvature:
            return {SLOW_DRAG: exact.slow_friction_by_curvature(1.0, 1.0, force, dataset["curvature_by_pressure"])}
        if "rms_slope_contact" in dataset and "contact_length" in dataset:
            slope, length = dataset["rms_slope_contact"], dataset["contact_length"]
            modulus = self.series.scene.elastomer.indentation_modulus
            return {SLOW_DRAG: exact.slow_friction_by_slope(1.0, 1.0, modulus, slope, length)}
        return {}

    def sample(self, grid: str, body: str, *solvers: str) -> DrawSet:
        """Datasets by the name of the solver, of which draws can be left out; always the same object."""
        key = grid, body, solvers
        if key not in self._samples:
            self._samples[key] = DrawSet({solver: _measured(self(solver, body, grid)) for solver in solvers})
        return self._samples[key]

    @cached_property
    def _samples(self):
        return {}


def sliding(dataset: xarray.Dataset) -> xarray.Dataset:
    """Dataset without the bodies at rest."""
    return dataset.isel(speed=slice(1, None))


def resting(dataset: xarray.Dataset) -> xarray.Dataset:
    """Dataset of the bodies at rest alone."""
    return dataset.isel(speed=0)


def _measured(dataset):
    return dataset[[name for name in (*MEASURED, *AT_REST) if name in dataset]]
