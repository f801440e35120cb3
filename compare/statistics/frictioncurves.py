"""Curves of friction against load at several speeds: simulated on the same rough surfaces, or measured."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import nan
from typing import TYPE_CHECKING, Any, Self, TypeAlias

import numpy as np

from .jackknife import Group, Replicates, groups, resample, strata_of

if TYPE_CHECKING:
    import xarray

Statistic = Callable[[Any], Mapping[str, float | np.ndarray]]
FrictionCurves: TypeAlias = Any  # SimulatedCurves, or measured ones that answer the same


@dataclass(frozen=True)
class Curve:
    """Friction against load at one speed [m/s]: ln F, ln mu and its standard error, NaN if unknown, each (N,)."""

    speed: float
    log_load: np.ndarray
    log_friction: np.ndarray
    error: np.ndarray | float = nan


@dataclass(frozen=True)
class SimulatedCurves:
    """Friction on the same surfaces at every speed and load or depth; NaN where a solve failed.

    Points share their surfaces, so the scatter comes from leaving surfaces out, never points.

    speeds : (S,) [m/s]
    load, friction_force : (S, P, surfaces) [N], or (S, P) of a body without random surfaces
    strata : (surfaces,) number of the stratum of each surface; None where all are one
    solver : name of what solved them
    """

    speeds: np.ndarray
    load: np.ndarray
    friction_force: np.ndarray
    strata: np.ndarray | None = None
    solver: str = ""

    @classmethod
    def of(cls, dataset: xarray.Dataset) -> Self:
        """Curves of a Dataset on one grid, with dimensions speed, load or depth, and draw if it has draws."""
        ordered = dataset.transpose("speed", ..., *[name for name in ("surface",) if name in dataset.dims])
        strata = strata_of(dataset) if "surface" in dataset.dims else None
        load, friction = (ordered[name].values for name in ("normal_force", "friction_force"))
        return cls(dataset["speed"].values, load, friction, strata, str(dataset.attrs.get("solver", "")))

    @property
    def surfaces(self) -> int:
        """Number of surfaces; 1 of a body without."""
        return self._forces.shape[3]

    @cached_property
    def known(self) -> np.ndarray:
        """Points at which any surface has an answer (S, P)."""
        return np.isfinite(self._forces).all(axis=0).any(axis=2)

    @property
    def groups(self) -> list[Group]:
        """Surfaces that are left out together."""
        return groups(self._strata, self.solver) if self.load.ndim == 3 else []

    def without(self, group: Group) -> Self:
        """Curves without some surfaces."""
        every = (self.load, self.friction_force, self._strata)
        load, friction, strata = (np.delete(each, group.surfaces, axis=-1) for each in every)
        return replace(self, load=load, friction_force=friction, strata=strata)

    @cached_property
    def _forces(self):
        """Load and friction force (2, S, P, surfaces)."""
        return np.array([np.atleast_3d(self.load), np.atleast_3d(self.friction_force)])

    @property
    def _strata(self):
        return np.zeros(self.surfaces, int) if self.strata is None else self.strata

    def complete(self) -> Self:
        """Points that have an answer on every surface left, speeds ascending; all else is NaN or gone.

        Points go where more than half of the surfaces failed, then surfaces that failed anywhere else, then points
        where the mean friction, of all or without a group of surfaces, is not positive and has no logarithm, then
        speeds with a single point. Raises ValueError where nothing is left.
        """
        order = np.argsort(self.speeds)
        forces = self._forces[:, order]
        solved = np.isfinite(forces).all(axis=0)
        points = solved.mean(axis=2) >= 0.5
        surfaces = solved[points].all(axis=0)
        if not points.any() or not surfaces.any():
            raise ValueError("no surface has an answer at every point")
        forces, strata = forces[..., surfaces], self._strata[surfaces]
        left_out = [np.empty(0, int), *(group.surfaces for group in groups(strata) if strata.size > 1)]
        for part in left_out:
            means = np.delete(forces, part, axis=3).mean(axis=3)
            points &= (means > 0).all(axis=0)
        speeds = points.sum(axis=1) > 1
        load, friction = np.where(points[..., None], forces, nan)[:, speeds]
        if self.load.ndim == 2:
            load, friction, strata = load[..., 0], friction[..., 0], None
        return replace(self, speeds=self.speeds[order][speeds], load=load, friction_force=friction, strata=strata)

    @property
    def curves(self) -> tuple[Curve, ...]:
        """ln of mean friction over mean load against ln of mean load, without errors."""
        load, friction = np.log(np.where(self.known, self._forces.mean(axis=3), nan))
        return tuple(
            Curve(speed, n[at], x[at] - n[at])
            for speed, n, x, at in zip(self.speeds.tolist(), load, friction, self.known, strict=True)
        )

    def resampled(self, statistic: Statistic) -> dict[str, Replicates]:
        """Statistics with the scatter that leaving surfaces out shows."""
        return resample(statistic, self)

    def deviations(self, slopes: float | np.ndarray = 0.0) -> np.ndarray:
        """Deviations (surfaces, N) of each surface from the mean, relative, along a curve d ln mu / d ln F."""
        forces = self._forces[:, self.known, : self.surfaces if self.load.ndim == 3 else 0]
        load, friction = forces / self._forces[:, self.known].mean(axis=2, keepdims=True) - 1
        return (friction - (1 + np.reshape(slopes, (-1, 1))) * load).T

    def replicates(self, value: float | np.ndarray, deviations: np.ndarray) -> Replicates:
        """Numbers whose deviations follow from those of the surfaces."""
        return Replicates.first_order(value, deviations, self._strata[: len(deviations)].tolist())
