"""Curves of friction against load at several speeds: simulated on the same rough surfaces, or measured."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import inf, nan
from typing import Any, Self, TypeAlias

import numpy as np
import xarray

from .jackknife import Group, Replicates, groups, resample, strata_of

Statistic = Callable[[Any], Mapping[str, float | np.ndarray]]


@dataclass(frozen=True)
class Curve:
    """Friction against load at one speed [m/s]: ln F, ln mu and its standard error, NaN if unknown, each (N,)."""

    speed: float
    log_load: np.ndarray
    log_friction: np.ndarray
    error: np.ndarray


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
        """Curves of a Dataset of one grid: dimensions speed, load or depth, and draw if the body has any."""
        (pressed,) = {"load", "depth"} & set(dataset.dims)
        load, friction = (
            dataset[name].transpose("speed", pressed, ...).values for name in ("normal_force", "friction_force")
        )
        strata = strata_of(dataset) if "surface" in dataset.dims else None
        return cls(dataset["speed"].values, load, friction, strata, str(dataset.attrs.get("solver", "")))

    @property
    def points(self) -> int:
        """Number of speeds times loads or depths."""
        return self.load.shape[0] * self.load.shape[1]

    @property
    def surfaces(self) -> int:
        """Number of surfaces; 1 of a body without."""
        return self.load.shape[2] if self.load.ndim == 3 else 1

    @property
    def known(self) -> np.ndarray:
        """Points at which any surface has an answer (S, P)."""
        return np.any(np.atleast_3d(np.isfinite(self.load) & np.isfinite(self.friction_force)), axis=2)

    @property
    def groups(self) -> list[Group]:
        """Surfaces that are left out together."""
        return groups(self._strata, self.solver) if self.load.ndim == 3 else []

    def without(self, group: Group) -> Self:
        """Curves without some surfaces."""
        return self._of(np.setdiff1d(np.arange(self.surfaces), group.surfaces))

    def _of(self, surfaces):
        """Curves of some surfaces."""
        load, friction = self.load[..., surfaces], self.friction_force[..., surfaces]
        return replace(self, load=load, friction_force=friction, strata=self._strata[surfaces])

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
        load, friction = np.atleast_3d(self.load)[order], np.atleast_3d(self.friction_force)[order]
        solved = np.isfinite(load) & np.isfinite(friction)
        points = solved.mean(axis=2) >= 0.5
        surfaces = solved[points].all(axis=0)
        if not points.any() or not surfaces.any():
            raise ValueError("no surface has an answer at every point")
        load, friction, strata = load[..., surfaces], friction[..., surfaces], self._strata[surfaces]
        left = [np.delete(np.arange(strata.size), group.surfaces) for group in groups(strata)]
        parts: list[slice | np.ndarray] = [slice(None), *(part for part in left if part.size)]
        for part in parts:
            for force in (load, friction):
                points &= np.where(points, force[..., part].mean(axis=2), 0) > 0
        speeds = points.sum(axis=1) > 1
        kept = np.where(points[..., None], [load, friction], nan)[:, speeds]
        if self.load.ndim == 2:
            return type(self)(self.speeds[order][speeds], kept[0, ..., 0], kept[1, ..., 0])
        return type(self)(self.speeds[order][speeds], kept[0], kept[1], strata, self.solver)

    @property
    def curves(self) -> tuple[Curve, ...]:
        """ln of mean friction over mean load against ln of mean load, without errors."""
        known = self.known
        load, friction = (np.atleast_3d(force).mean(axis=2) for force in (self.load, self.friction_force))
        return tuple(
            Curve(speed, np.log(n[at]), np.log(x[at] / n[at]), np.full(at.sum(), nan))
            for speed, n, x, at in zip(self.speeds.tolist(), load, friction, known, strict=True)
        )

    def resampled(self, statistic: Statistic) -> dict[str, Replicates]:
        """Statistics with the scatter that leaving surfaces out shows."""
        return resample(statistic, self)

    def deviations(self, slopes: float | np.ndarray = 0.0) -> np.ndarray:
        """Deviations (surfaces, N) of each surface from the mean, relative, along a curve d ln mu / d ln F."""
        surfaces = slice(None) if self.load.ndim == 3 else slice(0)
        forces = (np.atleast_3d(force)[self.known] for force in (self.load, self.friction_force))
        load, friction = ((force / force.mean(axis=1, keepdims=True) - 1)[:, surfaces] for force in forces)
        return (friction - (1 + np.reshape(slopes, (-1, 1))) * load).T

    def replicates(self, value: float | np.ndarray, deviations: np.ndarray) -> Replicates:
        """Numbers whose deviations follow from those of the surfaces."""
        return Replicates.first_order(value, deviations, self._strata[: len(deviations)].tolist())


@dataclass(frozen=True)
class MeasuredCurves:
    """Curves of which every point was measured by itself.

    curves : with the standard error of each ln mu, NaN where unknown
    dof : degrees of freedom of the one relative scatter behind these errors; infinite if it is known exactly
    levers : change of ln v of each curve with ln mu of each point (S, N), where friction itself says by how much
        speeds are shifted, in the order of the curves, which is that of their speeds; None of speeds as measured
    """

    curves: tuple[Curve, ...]
    dof: float = inf
    levers: np.ndarray | None = None

    @property
    def speeds(self) -> np.ndarray:
        """(S,) [m/s]."""
        return np.array([curve.speed for curve in self.curves])

    @property
    def points(self) -> int:
        """Number of points."""
        return sum(curve.log_load.size for curve in self.curves)

    @property
    def surfaces(self) -> int:
        """1, as none is random."""
        return 1

    def complete(self) -> Self:
        """Curves of more than one point, speeds ascending."""
        kept = sorted((curve for curve in self.curves if curve.log_load.size > 1), key=lambda curve: curve.speed)
        return replace(self, curves=tuple(kept))

    def resampled(self, statistic: Statistic) -> dict[str, Replicates]:
        """Statistics with the scatter that follows from moving each point by its standard error, both ways."""
        whole, errors = statistic(self), self._errors
        if not np.all(np.isfinite(errors)):
            unknown = {name: np.full((1, *np.shape(value)), nan) for name, value in whole.items()}
            return {name: self.replicates(value, unknown[name]) for name, value in whole.items()}
        moved = [
            [statistic(self._moved(point, by)) for by in (error, -error)] for point, error in enumerate(errors)
        ]
        return {
            name: self.replicates(value, np.array([(up[name] - down[name]) / 2 for up, down in moved]))
            for name, value in whole.items()
        }

    def deviations(self, slopes: float | np.ndarray = 0.0) -> np.ndarray:
        """Errors of the points (N, N); loads are known exactly."""
        return np.diag(self._errors)

    def replicates(self, value: float | np.ndarray, deviations: np.ndarray) -> Replicates:
        """Numbers whose deviations follow from those of independent points."""
        return Replicates(value, deviations, self.dof)

    @property
    def _errors(self):
        return np.concatenate([curve.error for curve in self.curves])

    def _moved(self, point, by):
        quicker = np.ones(len(self.curves)) if self.levers is None else np.exp(by * self.levers[:, point])
        moved = []
        for curve, times in zip(self.curves, quicker.tolist(), strict=True):
            here = np.arange(curve.log_load.size) == point
            moved.append(replace(curve, speed=times * curve.speed, log_friction=curve.log_friction + by * here))
            point -= curve.log_load.size
        return replace(self, curves=tuple(moved))


FrictionCurves: TypeAlias = SimulatedCurves | MeasuredCurves
"""Curves of ln mu (ln F) at several speeds, and the scatter of what follows from them.

The mean of products of `deviations` (K, N) estimates the covariance of ln mu at all points.
"""
