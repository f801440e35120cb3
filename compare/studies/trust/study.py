"""The trust map, made again: scenes solved in both dimensionalities, and errors on scenes held out."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from math import log
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from scene import Scene

from ...library.ready import CATALOGUE
from ...models.law.parts import LawParts
from ...report.page import Block, Findings, Table, Text
from ...solving.outcome import Outcome
from ...solving.task import Batch, SceneTask, Task
from ...solving.vocabulary import attributes
from ...statistics.finding import Claim, Finding, claimed, sentences
from ...trustmap import shipped, table
from ...trustmap.groups import LINE, SPACE, DimensionlessGroups, SmoothReference
from ...trustmap.measured import beyond_measured, limits
from ...trustmap.model import NAMES, Model
from ...trustmap.ratio import LAW, QUANTITIES, RATIOS, Ratio, asked_of, ratio_of
from ...trustmap.regions import SURFACES
from ...trustmap.verdict import WIDE
from ..study import Judgement, SizedStudy
from . import design
from . import figure as regime_map
from .contact import GREAT, USUAL, Contact
from .map import ABOUT as ABOUT_FAMILY
from .map import contacts_like, regime_table
from .scoring import Score
from .statements import BEST, Scored, advice_rows, coverage_rows, error_rows, of_surfaces

LEARNED, HELD_OUT = "learned", "held-out"
ABOUT = """Each scene is a point of a design over dimensionless groups, solved in 1D on profiles and in 3D on
surfaces until its scatter is known. Gaussian processes learn the ratio of 1D over 3D from these scenes alone.
Those held out were drawn by another seed, and no model was fitted to them.

Errors are those of all held-out scenes whose advice is "use" or "multiply", as measured: each contains the scatter
of the surfaces behind the truth. The error without that scatter is the share that remains when the two are split
in proportion to their variances."""
# What the map is to keep, of each ratio and of the best advice on friction: median error, error of nine in ten.
WANTED = {
    "friction": (0.02, 0.08),
    LAW: (0.02, 0.08),
    "depth": (0.01, 0.05),
    "force": (0.01, 0.05),
    BEST: (0.012, 0.06),
}
# The same of friction on surfaces as they are measured.
WANTED_MEASURED = 0.04, 0.12
# Of what the errors are, in words.
NAMED = {
    "friction": "friction by corrected 1D",
    LAW: "friction by the 3D law",
    "depth": "depth by corrected 1D",
    "force": "force by corrected 1D",
    BEST: "friction by the best advice",
}
BOOTSTRAPS = 200
# Standard error that is wanted of a scene, and most surfaces, by set; and where waves are many.
KNOWN = {LEARNED: (0.015, 64), HELD_OUT: (0.01, 600)}
KNOWN_WIDE = 0.01, 300


@dataclass(frozen=True)
class Size:
    """Size of the campaign.

    learned : points of the design to learn from; none, and the models that come with the package are scored
    held_out : points held out
    closer : how much closer scenes are known than those of the package
    """

    learned: tuple[int, ...]
    held_out: tuple[int, ...]
    closer: float = 1.0


def _size(name: str) -> Size:
    learned, held_out = (
        tuple(int(each) for each in table.read(path)["point"]) for path in (table.LEARNED, table.HELD_OUT)
    )
    # Those drawn evenly that are smooth are in no table.
    evenly = [point for point in held_out if point < design.MEASURED]
    held_out = *range(design.EVENLY_AGAIN, evenly[-1] + 1), *held_out[len(evenly) :]
    sizes = {"quick": Size((), held_out[:24]), "standard": Size(learned, held_out)}
    return (sizes | {"full": Size(learned, held_out, 2.0)})[name]


SIZES = "quick", "standard", "full"


@dataclass(frozen=True)
class TrustStudy(SizedStudy):
    """The campaign behind the trust map, at a size."""

    command, name = "study", "trust"
    title, about = CATALOGUE["trust"].title, CATALOGUE["trust"].about
    sizes = SIZES

    def contacts(self) -> dict[str, dict[int, Contact]]:
        """Task of each scene, by set and point."""
        size = _size(self.size)
        sets = {LEARNED: size.learned, HELD_OUT: size.held_out}
        return {name: {k: contact_at(k, name, size.closer) for k in points} for name, points in sets.items()}

    def batches(self) -> Sequence[Batch]:
        """Scenes, and their smooth bodies."""
        return (Batch([task for found in self.contacts().values() for task in tasks_of(found.values())]),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Groups and ratios of the scenes of each set."""
        sets = {f"/{name}": answers_of(found, outcomes) for name, found in self.contacts().items() if found}
        return xarray.DataTree.from_dict(sets)

    @staticmethod
    def learned(answers: xarray.DataTree) -> Mapping[str, np.ndarray]:
        """Table of the contacts learned from, or of those of the package where none was."""
        return table.columns(answers[LEARNED].to_dataset()) if LEARNED in answers else table.read(table.LEARNED)

    def models(self, answers: xarray.DataTree) -> dict[str, Model]:
        """Models of all quantities: fitted to what was learned, or those that come with the package."""
        if LEARNED not in answers:
            return {name: shipped.model(name) for name in RATIOS}
        learned = self.learned(answers)
        return {name: Model.fit(name, table.measurements(learned, name)[1]) for name in RATIOS}

    @staticmethod
    def scored(held_out: Mapping[str, np.ndarray], models: Mapping[str, Model]) -> dict[str, Scored]:
        """Score of each model on the scenes of a table, and of the best advice on friction.

        Off the map nothing is known: the advice is to solve.
        """
        found: dict[str, Scored] = {}
        for name, model in models.items():
            rows, measured = table.measurements(held_out, name)
            groups = {each: held_out[each][rows] for each in NAMES}
            groups["slides"] = held_out[table.column("friction", "surfaces")][rows] > 0
            off = np.array([bool(beyond_measured(place)) for place in measured.groups], bool)
            predicted = model.predicted(np.clip(measured.groups, *limits()))
            predicted = predicted._replace(error=np.where(off, np.inf, predicted.error))
            found[name] = Score(measured, predicted), groups
        line, law = found["friction"], found[LAW]
        return {**found, BEST: (line[0].best(law[0]), line[1])}

    def judge(self, answers: xarray.DataTree) -> Judgement:
        models = self.models(answers)
        scores = self.scored(table.columns(answers[HELD_OUT].to_dataset()), models)
        drawn, measured = (of_surfaces(scores, name) for name in SURFACES)
        findings = [each for name, (score, _) in drawn.items() for each in _findings(name, score, WANTED[name])]
        findings += [
            each
            for name in (LAW, "friction", BEST)
            if measured[name][0].usable.size
            for each in _findings(f"{name}.as-measured", measured[name][0], WANTED_MEASURED)
        ]
        findings += _smooth_findings(answers[HELD_OUT].to_dataset())
        rows = advice_rows(drawn), coverage_rows(scores), error_rows(scores)
        advice, coverage, errors = (DataFrame(list(each)) for each in rows)
        blocks: list[Block] = [
            regime_map.plot(
                regime_table(model=models["friction"]), contacts_like(self.learned(answers)), ABOUT_FAMILY, WIDE
            ),
            Table("advice", advice, "Advice on the scenes held out, by regime and body."),
            Findings(findings, "Errors on scenes held out, with intervals of 95 % over these scenes."),
            Table("errors", errors, "Errors as measured and share within the interval, by region."),
            Table("coverage", coverage, "Share within the interval of 95 %, by combined region."),
        ]
        return Judgement(findings, sentences(claimed(findings)), blocks, self.setting)

    @property
    def setting(self) -> Sequence[Block]:
        """The campaign, and the meaning of its errors."""
        return [Text(ABOUT)]


def contact_at(point: int, name: str, closer: float = 1.0) -> Contact:
    """Task of a point of a set; closer : how much closer it is to be known than that of the package."""
    many = point >= design.WIDE
    wanted, most = KNOWN_WIDE if many else KNOWN[name]
    return Contact(design.scene(point), wanted / closer, round(most * closer**2), GREAT if many else USUAL)


def tasks_of(contacts: Iterable[Contact]) -> list[Task]:
    """Scenes, and their smooth bodies, as tasks."""
    return [task for each in contacts for task in (each, *_smooth(each.scene))]


def answers_of(contacts: Mapping[int, Contact], outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
    """Groups and ratios of scenes by their points, from the outcomes of `tasks_of`."""
    rows = [_row(point, each, outcomes) for point, each in contacts.items()]
    return labelled({name: np.array([row[name] for row in rows], float) for name in rows[0]})


def _smooth(scene: Scene) -> tuple[SceneTask, SceneTask]:
    """Tasks of the smooth body of a scene in both dimensionalities."""
    smooth = (replace(scene, roughness=None),)
    return SceneTask(LINE, smooth, work=1e4), SceneTask(SPACE, smooth, work=1e5)


def _row(point: int, contact: Contact, outcomes: Mapping[Task, Outcome]) -> dict[str, Any]:
    """Point, groups, and the numbers of each ratio of a scene."""
    scene = contact.scene
    line, space = (outcomes[each].rows[0] for each in _smooth(scene))
    groups, smooth, law = {}, dict.fromkeys(RATIOS, np.nan), np.nan
    if not (line.reason or space.reason):
        body = SmoothReference.of(scene, line, space)
        smooth |= {name: log(getattr(body, name)) for name in QUANTITIES}
        if scene.roughness is not None:
            parts = LawParts.of(scene, body.contact)
            groups, law = asdict(DimensionlessGroups.of(scene, body, parts)), parts.friction_coefficient
    return {
        "point": point,
        "groups": [groups.get(name, np.nan) for name in NAMES],
        "smooth": [smooth[name] for name in RATIOS],
        **ratios_of(scene, outcomes[contact], law),
    }


def ratios_of(scene: Scene, outcome: Outcome, law: float) -> dict[str, list[float]]:
    """Numbers of each ratio of a scene, by name; law : friction coefficient that the law makes of it."""
    found = {name: ratio_of(outcome, name, law) for name in asked_of(scene)}
    none = Ratio(np.nan, np.nan, np.nan, 0, np.nan)
    return {number: [getattr(found.get(name, none), number) for name in RATIOS] for number in table.NUMBERS}


def labelled(made: Mapping[str, np.ndarray]) -> xarray.Dataset:
    """Columns of scenes as a Dataset with the dimensions scene, group and quantity."""
    dims = {"point": ("scene",), "groups": ("scene", "group")}
    dataset = xarray.Dataset(
        {name: (dims.get(name, ("scene", "quantity")), values) for name, values in made.items()},
        {"group": list(NAMES), "quantity": list(RATIOS)},
    )
    for name in dataset.variables:
        dataset[name].attrs = attributes(str(name))
    return dataset


def _findings(name: str, score: Score, wanted: tuple[float, float]) -> Iterator[Finding]:
    """Findings on each claim of one ratio; wanted : median error, and that of nine in ten."""
    used, of = score.used, NAMED.get(name.split(".")[0], name)
    of = f"{of} on surfaces as measured" if name.endswith("as-measured") else of
    own, errors = np.abs(used.own), np.abs(used.errors)

    def measured(id, sentence, expected, tolerance, measure, meaning, count=used.usable.size):
        return _measured(Claim(f"trust.{name}.{id}", sentence, expected, tolerance, meaning), measure, count)

    over = "Quantile of the relative error over held-out scenes with advice use or multiply"
    for id, share, bound in zip(("median", "nine-in-ten"), (0.5, 0.9), wanted, strict=True):
        told = "Half" if share == 0.5 else "Nine in ten"
        yield measured(
            id, f"{told} of the errors of {of} are at most {100 * bound:g} %", 0.0, bound,
            lambda draw, share=share: float(np.quantile(errors[draw], share)),
            f"{over}, the scatter of the surfaces of the truth in it",
        )  # fmt: skip
        yield measured(
            f"{id}-alone", f"{told} of these without the scatter of the truth", 0.0, np.nan,
            lambda draw, share=share: float(np.quantile(own[draw], share)),
            f"{over}, the scatter of the surfaces of the truth taken out",
        )  # fmt: skip
    yield measured(
        "coverage", f"95 % of the ratios of {of} lie within their interval", 0.95, 0.02,
        lambda draw: used.taken(draw).covered, "Share within the interval, which the scatter of the truth widens",
    )  # fmt: skip
    yield measured(
        "one-surface", f"95 % of single surfaces have a ratio of {of} within theirs", 0.95, 0.02,
        lambda draw: used.taken(draw).surfaces_covered, "Share within the interval of one surface",
    )  # fmt: skip
    yield measured(
        "usable", f"At least 80 % of the scenes need no 3D for {of}", 1.0, 0.2,
        lambda draw: float(score.usable[draw].mean()),
        "Share of the held-out scenes with advice use or multiply", score.usable.size,
    )  # fmt: skip


def _smooth_findings(held_out: xarray.Dataset) -> Iterator[Finding]:
    """Findings on the smooth scenes held out: their ratios as the map answers them, against more points."""
    smooth = held_out.isel(scene=np.isnan(held_out["groups"].values).all(axis=1))
    for name in QUANTITIES if smooth.sizes["scene"] else ():
        apart = (smooth["logarithm"] - smooth["smooth"]).sel(quantity=name).dropna("scene").values
        claim = Claim(
            f"trust.{name}.smooth", f"The {name} ratio of smooth bodies is known within 1 %", 0.0, 0.01,
            "Error of nine in ten of the smooth scenes held out, on 64 points a side against 128",
        )  # fmt: skip
        yield _measured(
            claim, partial(lambda off, draw: float(np.quantile(off[draw], 0.9)), np.abs(apart)), apart.size
        )


def _measured(claim: Claim, measure: Callable[[np.ndarray], float], count: int) -> Finding:
    """Finding of a number measured on some scenes, with its interval over scenes drawn again and again."""
    if not count:
        return Finding(claim, np.nan, reason="no scene held out has it")
    rng = np.random.default_rng(0)
    draws = [measure(rng.integers(0, count, count)) for _ in range(BOOTSTRAPS)]
    low, high = np.quantile(draws, (0.025, 0.975))
    return Finding(claim, measure(np.arange(count)), (float(low), float(high)), 0.0, "exact", draws=count)
