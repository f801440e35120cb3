"""Claims on the master curve in three dimensions: what roughness adds to friction, over full contact, is S(x)."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray
from scipy.special import ndtri

from scene.surfaces.isotropic import Isotropic

from ...models.law.bands import Bands, FullContact
from ...models.law.parts import Share
from ...models.table import SURFACES
from ...solving.curve import COARSE, FINE, of_model
from ...statistics.finding import Claim, Finding
from ...statistics.jackknife import DrawSet, friction, mean, resample
from .answers import LAW, Answers
from .claims import CLAIMS
from .laws import Laws
from .measures import closed_forms

if TYPE_CHECKING:
    from .rough import RoughSeries

# Rms height over the depth of the smooth relaxed contact up to which the law is claimed.
SHALLOW = 0.1
# Part of friction that the roughness has at least, by the law: below, its part is a small difference.
LEAST_ROUGH = 0.3
# Coordinates of each finding: law at the mean pressure, law averaged over the pressure of the body, and raw.
FINDINGS = {"collapse": "law", "averaged": "averaged", "raw": "bare"}
QUANTILES = {"": 0.5, "-most": 0.9}
EVERY = "every series"
_UNKNOWN = "the scatter is not known, or at some point roughness does not add to friction"


@dataclass(frozen=True)
class Coordinates:
    """Points of a series in which they are to fall on one curve, arrays (speeds, values).

    x : mean nominal pressure over the rms pressure of the roughness in full contact [1]
    share : S(x), the share of its friction in full contact that the roughness is to have [1]
    smooth : friction coefficient of the smooth body [1]
    full : friction coefficient of the roughness in full contact, F_full / p [1]
    """

    x: np.ndarray
    share: np.ndarray
    smooth: np.ndarray
    full: np.ndarray

    @classmethod
    def of_bare(cls, smooth: xarray.Dataset, waves: Sequence[FullContact]) -> "Coordinates":
        """Raw coordinates: all waves in full contact at each speed, on the contact of the bare smooth body."""
        load, drag, area = (mean(smooth, name) for name in ("normal_force", "friction_force", "contact_area"))
        force, rms = np.array([(each.friction.sum(), each.pressure[-1]) for each in waves]).T[..., None]
        x = load / area / rms
        shares = [Share.of(each)(row) for each, row in zip(waves, x, strict=True)]
        return cls(x=x, share=np.array(shares), smooth=drag / load, full=force * area / load)

    def measured(self, mu: np.ndarray) -> np.ndarray:
        """Share of its friction in full contact that the roughness has at coefficients of friction."""
        return (mu - self.smooth) / self.full


@dataclass(frozen=True)
class LawPoints:
    """Points of a series for the master curve, arrays (speeds, values).

    series, answers, model : what is judged, and the model that is measured
    law, averaged, bare : coordinates of the law, and raw ones
    curves : S of all waves, by the speed
    height : rms height over the depth of the smooth relaxed contact [1]
    counted : where the roughness has enough of friction, and friction is known on both grids
    """

    series: "RoughSeries"
    answers: Answers
    model: str
    law: Coordinates
    averaged: Coordinates
    bare: Coordinates
    curves: tuple[Share, ...]
    height: np.ndarray
    counted: np.ndarray

    @classmethod
    def of(cls, series: "RoughSeries", answers: Answers) -> "LawPoints | None":
        """Points of the reference, where it is in three dimensions and the law answers; None where it is not."""
        model, roughness = series.models.reference, series.scene.roughness
        if not answers.has("rough", LAW.name) or series.models[model].draws != SURFACES:
            return None
        law = of_model(answers.curves["rough"], LAW.name).sel(level=FINE).isel(speed=slice(1, None))
        if "share_of_full_contact" not in law:
            return None
        assert isinstance(roughness, Isotropic)  # the law answers no other
        law = law.transpose("speed", series.prescribed, ...)
        bands = Bands.of(roughness)
        waves = [FullContact.of(bands, series.scene.solid, speed) for speed in series.speeds]
        known = [np.isfinite(_mu(answers.sample(level, "rough", model)[model])) for level in (FINE, COARSE)]
        names = "friction_of_shape", "friction_of_roughness", "full_contact_friction", "normal_force"
        own, rough, full, load = (law[name].values for name in names)
        x, share = (law[name].values for name in ("pressure_ratio", "share_of_full_contact"))
        with np.errstate(invalid="ignore", divide="ignore"):
            # Without waves that carry the contact, which roughness widens.
            coordinates = Coordinates(x, share, own / load, full / load)
            found = cls(
                series=series,
                answers=answers,
                model=model,
                law=coordinates,
                averaged=replace(coordinates, share=rough / full),  # as S is bent and the pressure peaks
                bare=Coordinates.of_bare(answers("smooth", model).isel(speed=slice(1, None)), waves),
                curves=tuple(map(Share.of, waves)),
                height=np.broadcast_to(roughness.rms_height / closed_forms(series.curves["rough"])[1], x.shape),
                counted=(rough / (own + rough) > LEAST_ROUGH) & known[0] & known[1],
            )
        return found if found.counted.any() else None

    @property
    def claimed(self) -> np.ndarray:
        """Points that the claims are on."""
        return self.counted & (self.height <= SHALLOW)


def law_findings(series: "RoughSeries", answers: Answers, laws: Mapping[str, Laws]) -> list[Finding]:
    """Findings on the master curve of a series; none where the law claims nothing."""
    found = LawPoints.of(series, answers)
    if found is None:
        return []
    regime = laws[found.model].words(found.claimed)
    return [*law_findings_of([found], series.name, regime, series.place("rough"))]


def law_findings_of(
    points: Sequence[LawPoints], where: str = EVERY, groups: str = "", curve: str = ""
) -> Iterator[Finding]:
    """Findings at all points of several series, with the same surfaces left out of each."""
    claimed = np.concatenate([each.law.x[each.claimed] for each in points])
    if not claimed.size:
        return
    model, labels = points[0].model, points[0].series.models.labels
    fine, coarse = (drawn_of(points, model, level) for level in (FINE, COARSE))
    regime = f"{claimed.size} points, x {claimed.min():.2g} to {claimed.max():.2g}"
    regime = "; ".join(filter(None, (regime, groups)))
    for found, coordinates in FINDINGS.items():

        def off(sample, coordinates=coordinates):
            return np.concatenate([_off(each, coordinates, sample) for each in points])

        for quantile, level in QUANTILES.items():
            claim = replace(CLAIMS[f"law3d.{found}{quantile}"], dimension=labels[model])
            yield _finding(claim, level, off, fine, coarse, where=where, curve=curve, regime=regime)


def drawn_of(members: Sequence[Any], model: str, level: str) -> DrawSet:
    """Answers of a model to the rough bodies of several series, by the name of these."""
    return DrawSet({each.series.name: each.answers.sample(level, "rough", model)[model] for each in members})


def _off(points, coordinates, sample):
    """ln of the share measured over S at the points that are claimed."""
    place: Coordinates = getattr(points, coordinates)
    mu = _mu(sample[points.series.name])
    return np.log(place.measured(mu) / place.share)[points.claimed]


def _finding(claim: Claim, level: float, off: Callable, fine: DrawSet, coarse: DrawSet, **place: Any) -> Finding:
    """Finding on a quantile of the sizes of what points are off by.

    Scatter makes sizes larger: the upper end of the interval has that in it, the lower end is of what they are
    beyond the size that scatter alone has at this quantile.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        chance = ndtri((1 + level) / 2) * resample(lambda sample: {"": off(sample)}, fine)[""].estimated.error

        def both(sample):
            sizes = np.abs(off(sample))
            return np.quantile([sizes, np.maximum(sizes - chance, 0.0)], level, axis=1)

        found = resample(lambda sample: {"": both(sample)}, fine)[""].estimated
        low, high = found.interval()[0][1], found.interval()[1][0]
        grid = abs(float(both(coarse)[0] - found.value[0]))
    known = np.all(np.isfinite([low, high, grid]))
    return Finding(
        claim=claim,
        value=float(found.value[0]),
        scatter=(max(float(low), 0.0), float(high)) if known else (nan, nan),
        grid=grid,
        drawn=fine.drawn,
        reason="" if known else _UNKNOWN,
        size=True,
        parts={source: float(each[0]) for source, each in found.parts.items()},
        **place,
    )


def _mu(dataset):
    return friction(dataset)[1:]
