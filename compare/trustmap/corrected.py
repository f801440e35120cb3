"""Answers of three dimensions from one: means over profiles over the ratios that the trust map predicts."""

from collections.abc import Iterator, Sequence
from math import exp, hypot, isfinite, log, nan
from time import process_time
from typing import ClassVar

import numpy as np
from pydantic.dataclasses import dataclass

from mdr1d import MDR
from scene import EmptyContact, Result, Scene, SolveError
from scene.protocol import refuse
from scene.quantities import CLOSED
from scene.signatures import readable

from ..library.case import Draws
from ..solving.task import Row, SceneTask, draws_of
from ..statistics.jackknife import mean_ratio
from .measured import unmeasured
from .verdict import Correction, trust

# Quantities whose means over profiles are taken.
TAKEN = {"friction": "friction_force", "depth": "depth", "force": "normal_force"}


@readable
@dataclass(frozen=True, config=CLOSED)
class CorrectedMDR:
    """The 1D model, corrected by the trust map to the mean over surfaces in 3D.

    mdr : solver of each profile
    profiles : over which means are taken, of the seeds seed, seed + 1, ...; a smooth body is solved once

    Friction coefficient, mean F_x over mean F_N, depth under a load and force at a depth are those in 1D over
    their ratio 1D/3D as the map predicts it; what is prescribed stays. A depth is nan where the roughness lifts
    the body, so that its mean over profiles is not above zero. Where the map knows a ratio but advises to
    solve in 3D, the interval is wide. Of a smooth body the map solves both dimensions, which costs what 3D costs.

    Result.measures, of friction, depth [m] and force [N] as far as they are corrected: friction_ratio, 1D over
    3D; friction_low and friction_high, interval of 95 % of the mean over surfaces, from the map and from the
    scatter of the profiles, NaN for a single rough profile; friction_surface_low and friction_surface_high,
    interval of single surfaces, NaN too where they say nothing. Result.residual is the largest of the profiles;
    operator_applications and seconds are of all of them, the seconds with the map. There are no fields.
    """

    label: ClassVar[str] = "1D corrected"
    draws: ClassVar[str] = "none"  # it answers with the mean
    # Whose code and data the answer depends on.
    packages: ClassVar[tuple[str, ...]] = (
        "mdr1d",
        "bem3d",
        "compare.models",
        "compare.statistics",
        "compare.trustmap",
    )

    mdr: MDR = MDR(points=4000)
    profiles: Draws = 40

    @property
    def name(self) -> str:
        return "CorrectedMDR"

    def refusals(self, scene: Scene) -> list[str]:
        """Reasons why the scene cannot be solved, one sentence each: MDR refuses it, or it was never measured."""
        return [*self.mdr.refusals(scene), *unmeasured(scene)]

    def solve(self, scene: Scene) -> Result:
        """Solve the profiles, and correct their means.

        Raises Refused for what refusals names; EmptyContact if no profile reaches a prescribed depth; SolveError
        off the map, if a profile fails, and where no mean is above zero, so that no ratio corrects it.
        """
        start = process_time()
        refuse(self, scene)
        corrections, motion = trust(scene).of_model(self.mdr.name), scene.motion
        for name, worth in corrections.items():
            if not isfinite(worth.ratio):
                raise SolveError(f"the ratio 1D/3D of {name} is not known. {worth.reason}")
        rough = scene.roughness is not None and not scene.roughness.flat
        rows = SceneTask(self.mdr, draws_of(scene, self.profiles if rough else 1)).solve().rows
        if failed := [row.reason for row in rows if row.reason is not None]:
            raise SolveError(f"{len(failed)} of {len(rows)} profiles have no answer: {failed[0]}")
        most = max(rows, key=lambda row: row.normal_force)
        if not most.normal_force:
            raise EmptyContact(f"none of {len(rows)} profiles touches at a depth of {motion.depth:g} m")
        means = {name: _mean(name, rows, rough) for name in corrections}
        values = {name: means[name][0] / worth.ratio for name, worth in corrections.items()}
        if not any(map(isfinite, values.values())):
            raise SolveError(f"no mean over {len(rows)} profiles is above zero, so that no ratio corrects it")
        force = values["force"] if motion.load is None else motion.load
        return Result(
            scene=scene,
            solver=self.name,
            settings={"profiles": len(rows), **most.settings},
            normal_force=force,
            depth=values["depth"] if motion.depth is None else motion.depth,
            friction_force=values.get("friction", 0.0) * force,
            residual=max(row.residual for row in rows),
            operator_applications=sum(row.operator_applications for row in rows),
            seconds=process_time() - start,
            measures={
                measure: number
                for name, worth in corrections.items()
                for measure, number in _measures(name, worth, values[name], *means[name][1:])
            },
        )


def _mean(quantity: str, rows: Sequence[Row], rough: bool) -> tuple[float, float, float]:
    """Mean over profiles, and either side of its interval of 95 %, relative; nan if no ratio can correct it."""
    values = np.array([getattr(row, TAKEN[quantity]) for row in rows])
    over = np.array([row.normal_force if quantity == "friction" else 1.0 for row in rows])
    found = mean_ratio(values, over)
    if not found.value > 0:
        return nan, nan, nan
    if not rough:
        return float(found.value), 0.0, 0.0
    below, above = (abs(float(end / found.value - 1)) for end in found.interval())
    return float(found.value), below, above


def _measures(
    quantity: str, worth: Correction, value: float, below: float, above: float
) -> Iterator[tuple[str, float]]:
    """Ratio, and ends of the intervals of a corrected value; below, above : of the profiles' mean, relative."""
    yield f"{quantity}_ratio", worth.ratio
    for of, low, high in (("", worth.low, worth.high), ("_surface", worth.surface_low, worth.surface_high)):
        yield f"{quantity}{of}_low", value * exp(-hypot(log(high / worth.ratio), below))
        yield f"{quantity}{of}_high", value * exp(hypot(log(worth.ratio / low), above))
