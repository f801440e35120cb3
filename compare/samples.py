"""Friction on the same random surfaces at several speeds and presses, and the curves of its means."""

from dataclasses import dataclass, replace
from math import nan

import numpy as np

from .commoncurve import Curve
from .statistics.jackknife import groups


@dataclass(frozen=True)
class Samples:
    """Friction on the same surfaces at every speed and press; NaN where a solve failed.

    speeds : (S,) [m/s]
    load, friction_force : (S, P, surfaces) [N], or (S, P) of a body without random surfaces
    """

    speeds: np.ndarray
    load: np.ndarray
    friction_force: np.ndarray

    @property
    def surfaces(self) -> int:
        """How many; 1 of a body without."""
        return self.load.shape[2] if self.load.ndim == 3 else 1

    @property
    def known(self) -> np.ndarray:
        """Points at which any surface has an answer (S, P)."""
        return np.any(np.atleast_3d(np.isfinite(self.load) & np.isfinite(self.friction_force)), axis=2)

    @property
    def groups(self) -> list[np.ndarray]:
        """Surfaces that are left out together."""
        return groups(self.surfaces) if self.load.ndim == 3 else []

    def without(self, group: np.ndarray) -> "Samples":
        """The same without some surfaces."""
        return replace(
            self,
            load=np.delete(self.load, group, axis=2),
            friction_force=np.delete(self.friction_force, group, axis=2),
        )

    def complete(self) -> "Samples":
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
        load, friction = load[..., surfaces], friction[..., surfaces]
        left = [np.delete(np.arange(surfaces.sum()), group) for group in groups(surfaces.sum())]
        parts: list[slice | np.ndarray] = [slice(None), *(part for part in left if part.size)]
        for part in parts:
            for force in (load, friction):
                points &= np.where(points, force[..., part].mean(axis=2), 0) > 0
        speeds = points.sum(axis=1) > 1
        kept = np.where(points[..., None], [load, friction], nan)[:, speeds]
        if self.load.ndim == 2:
            kept = kept[..., 0]
        return Samples(self.speeds[order][speeds], *kept)

    @property
    def curves(self) -> tuple[Curve, ...]:
        """ln of mean friction over mean load against ln of mean load; no errors, so that points weigh alike."""
        known = self.known
        load, friction = (np.atleast_3d(force).mean(axis=2) for force in (self.load, self.friction_force))
        return tuple(
            Curve(speed, np.log(n[at]), np.log(x[at] / n[at]), np.full(at.sum(), nan))
            for speed, n, x, at in zip(self.speeds.tolist(), load, friction, known, strict=True)
        )

    @property
    def deviations(self) -> tuple[np.ndarray, np.ndarray]:
        """Of each surface from the mean, relative: of ln load and of ln friction force, (N, surfaces)."""
        surfaces = slice(None) if self.load.ndim == 3 else slice(0)
        forces = (np.atleast_3d(force)[self.known] for force in (self.load, self.friction_force))
        load, friction = ((force / force.mean(axis=1, keepdims=True) - 1)[:, surfaces] for force in forces)
        return load, friction
