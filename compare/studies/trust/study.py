"""The trust map, made again: scenes solved in both dimensionalities, and errors on scenes held out."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from math import log
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from scene import Scene

from ...library.ready import CATALOGUE
from ...report.page import Block, Findings, Table, Text
from ...solving.outcome import Outcome
from ...solving.suggest import known
from ...solving.task import Batch, SceneTask, Task
from ...solving.vocabulary import attributes
from ...statistics.finding import Claim, Finding, claimed, sentences
from ...trustmap import shipped, table
from ...trustmap.groups import LINE, SPACE, DimensionlessGroups, SmoothReference
from ...trustmap.model import NAMES, Model
from ...trustmap.ratio import QUANTITIES, Ratio, asked_of, ratio_of
from ...trustmap.verdict import WIDE
from ..study import Judgement, Study
from . import design
from . import figure as regime_map
from .contact import Contact
from .map import ABOUT as ABOUT_FAMILY
from .map import regime_table
from .scoring import Score
from .statements import PROMISED, Scored, advice_rows, coverage_rows, evenly

LEARNED, HELD_OUT = "learned", "held-out"
ABOUT = """Each scene is a point of a design over dimensionless groups, solved in 1D on profiles and in 3D on
surfaces until its scatter is known. Gaussian processes learn the ratio of 1D over 3D from these scenes alone.
Those held out were drawn by another seed, and no model was fitted to them.

Errors are those of all held-out scenes whose advice is "use" or "multiply", as measured: each contains the scatter
of the surfaces behind the truth. The error without that scatter is the share that remains when the two are split
in proportion to their variances."""
# What the map is to keep, of each quantity: median error, error of nine in ten.
WANTED = {"friction": (0.02, 0.08), "depth": (0.01, 0.05), "force": (0.01, 0.05)}
BOOTSTRAPS = 200
# Standard error that is wanted of a scene, and most surfaces; those of blunt bodies are alike in both sets.
KNOWN = {LEARNED: (0.015, 16), HELD_OUT: (0.01, 24)}
KNOWN_BLUNT = KNOWN[LEARNED]


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
    # Among those drawn evenly the smooth ones are in no table; the blunt ones after them are all rough.
    evenly = [point for point in held_out if point < design.BLUNT_HELD_OUT]
    held_out = *range(evenly[-1] + 1), *held_out[len(evenly) :]
    sizes = {"quick": Size((), held_out[:24]), "standard": Size(learned, held_out)}
    return (sizes | {"full": Size(learned, held_out, 2.0)})[name]


SIZES = "quick", "standard", "full"


@dataclass(frozen=True)
class TrustStudy(Study):
    """The campaign behind the trust map, at a size."""

    size: str = "quick"

    command, name = "study", "trust"
    title, about = CATALOGUE["trust"].title, CATALOGUE["trust"].about

    @classmethod
    def of(cls, size: str) -> "TrustStudy":
        """Study of a size. Raises InvalidInput where there is no such size."""
        known("size", size, SIZES)
        return cls(size)

    @property
    def place(self) -> str:  # type: ignore[override]
        return f"{self.name}-{self.size}"

    @property
    def inputs(self) -> Mapping[str, Any]:
        return {"name": self.name, "size": self.size}

    def contacts(self) -> dict[str, dict[int, Contact]]:
        """Task of each scene, by set and point."""
        size = _size(self.size)
        sets = {
            LEARNED: (design.learned, size.learned, design.BLUNT, KNOWN[LEARNED]),
            HELD_OUT: (design.held_out, size.held_out, design.BLUNT_HELD_OUT, KNOWN[HELD_OUT]),
        }
        return {
            name: {k: _contact(scene(k), k >= blunt, size.closer, *known) for k in points}
            for name, (scene, points, blunt, known) in sets.items()
        }

    def batches(self) -> Sequence[Batch]:
        """Scenes, and their smooth bodies."""
        contacts = [each for found in self.contacts().values() for each in found.values()]
        return (Batch([task for each in contacts for task in (each, *_smooth(each.scene))]),)

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Groups and ratios of the scenes of each set."""
        sets = {
            name: _dataset([_row(point, each, outcomes) for point, each in found.items()])
            for name, found in self.contacts().items()
            if found
        }
        return xarray.DataTree.from_dict({f"/{name}": each for name, each in sets.items()})

    def models(self, answers: xarray.DataTree) -> dict[str, Model]:
        """Models of all quantities: fitted to what was learned, or those that come with the package."""
        if LEARNED not in answers:
            return {name: shipped.model(name) for name in QUANTITIES}
        learned = table.columns(answers[LEARNED].to_dataset())
        return {name: Model.fit(name, table.measurements(learned, name)[1]) for name in QUANTITIES}

    @staticmethod
    def scored(held_out: Mapping[str, np.ndarray], models: Mapping[str, Model]) -> dict[str, Scored]:
        """Score of each model on the scenes of a table."""
        found: dict[str, Scored] = {}
        for name, model in models.items():
            rows, measured = table.measurements(held_out, name)
            groups = {each: held_out[each][rows] for each in NAMES}
            groups["slides"] = held_out[table.column("friction", "surfaces")][rows] > 0
            groups["blunt"] = held_out["point"][rows] >= design.BLUNT_HELD_OUT
            found[name] = Score(measured, model.predicted(measured.groups)), groups
        return found

    def judge(self, answers: xarray.DataTree) -> Judgement:
        models = self.models(answers)
        scores = self.scored(table.columns(answers[HELD_OUT].to_dataset()), models)
        rough = [each for name, (score, _) in evenly(scores).items() for each in _findings(name, score)]
        blunt = [
            _held(name, score.taken(groups["blunt"]))
            for name, (score, groups) in scores.items()
            if groups["blunt"].any()
        ]
        findings = [*rough, *blunt, *_smooth_findings(answers[HELD_OUT].to_dataset())]
        advice, coverage = (DataFrame(list(rows)) for rows in (advice_rows(evenly(scores)), coverage_rows(scores)))
        blocks: list[Block] = [
            regime_map.plot(regime_table(model=models["friction"]), ABOUT_FAMILY, WIDE),
            Table("advice", advice, "Advice on the scenes held out, by regime and body."),
            Findings(findings, "Errors on scenes held out, with intervals of 95 % over these scenes."),
            Table("coverage", coverage, "Share within the interval of 95 %, by region."),
        ]
        return Judgement(findings, sentences(claimed(findings)), blocks, self.setting)

    @property
    def setting(self) -> Sequence[Block]:
        """The campaign, and the meaning of its errors."""
        return [Text(ABOUT)]


def _contact(scene: Scene, blunt: bool, closer: float, wanted: float, most: int) -> Contact:
    """Task of a scene; closer : how much closer it is to be known than that of the package."""
    wanted, most = KNOWN_BLUNT if blunt else (wanted, most)
    return Contact(scene, wanted / closer, round(most * closer**2), depth_too=blunt)


def _smooth(scene: Scene) -> tuple[SceneTask, SceneTask]:
    """Tasks of the smooth body of a scene in both dimensionalities."""
    smooth = (replace(scene, roughness=None),)
    return SceneTask(LINE, smooth, work=1e4), SceneTask(SPACE, smooth, work=1e5)


def _row(point: int, contact: Contact, outcomes: Mapping[Task, Outcome]) -> dict[str, Any]:
    """Point, groups, and the numbers of each ratio of a scene."""
    scene = contact.scene
    line, space = (outcomes[each].rows[0] for each in _smooth(scene))
    groups, smooth = {}, dict.fromkeys(QUANTITIES, np.nan)
    if not (line.reason or space.reason):
        body = SmoothReference.of(scene, line, space)
        smooth = {name: log(getattr(body, name)) for name in QUANTITIES}
        groups = {} if scene.roughness is None else asdict(DimensionlessGroups.of(scene, body))
    none = Ratio(np.nan, np.nan, np.nan, 0, np.nan)
    ratios = {name: ratio_of(outcomes[contact], name) for name in asked_of(scene)}
    return {
        "point": point,
        "groups": [groups.get(name, np.nan) for name in NAMES],
        "smooth": [smooth[name] for name in QUANTITIES],
        **{number: [getattr(ratios.get(name, none), number) for name in QUANTITIES] for number in table.NUMBERS},
    }


def _dataset(rows: Sequence[Mapping[str, Any]]) -> xarray.Dataset:
    """Rows as a Dataset with the dimensions scene, group and quantity."""
    made = {name: np.array([row[name] for row in rows], float) for name in rows[0]}
    dims = {"point": ("scene",), "groups": ("scene", "group")}
    dataset = xarray.Dataset(
        {name: (dims.get(name, ("scene", "quantity")), values) for name, values in made.items()},
        {"group": list(NAMES), "quantity": list(QUANTITIES)},
    )
    for name in dataset.variables:
        dataset[name].attrs = attributes(str(name))
    return dataset


def _findings(name: str, score: Score) -> Iterator[Finding]:
    """Findings on each claim of one quantity."""
    used = score.used
    half, most = WANTED[name]
    own = np.abs(used.own)

    def measured(id, sentence, expected, tolerance, measure, meaning, count=used.usable.size):
        return _measured(Claim(f"trust.{name}.{id}", sentence, expected, tolerance, meaning), measure, count)

    errors = np.abs(used.errors)
    over = "Quantile of the relative error over held-out scenes with advice use or multiply"
    for id, share, bound in (("median", 0.5, half), ("nine-in-ten", 0.9, most)):
        told = "Half" if share == 0.5 else "Nine in ten"
        yield measured(
            id, f"{told} of the {name} errors of corrected 1D are at most {100 * bound:g} %", 0.0, bound,
            lambda draw, share=share: float(np.quantile(errors[draw], share)),
            f"{over}, the scatter of the surfaces of the truth in it",
        )  # fmt: skip
        yield measured(
            f"{id}-alone", f"{told} of these without the scatter of the truth", 0.0, np.nan,
            lambda draw, share=share: float(np.quantile(own[draw], share)),
            f"{over}, the scatter of the surfaces of the truth taken out",
        )  # fmt: skip
    yield measured(
        "coverage", f"95 % of the {name} ratios lie within their interval", 0.95, 0.02,
        lambda draw: used.taken(draw).covered, "Share within the interval, which the scatter of the truth widens",
    )  # fmt: skip
    yield measured(
        "one-surface", f"95 % of single surfaces have a {name} ratio within theirs", 0.95, 0.02,
        lambda draw: used.taken(draw).surfaces_covered, "Share within the interval of one surface",
    )  # fmt: skip
    yield measured(
        "usable", f"At least 80 % of the scenes need no 3D for their {name}", 1.0, 0.2,
        lambda draw: float(score.usable[draw].mean()),
        "Share of the held-out scenes with advice use or multiply", score.usable.size,
    )  # fmt: skip


def _held(name: str, score: Score) -> Finding:
    """Finding on the coverage of blunt bodies that slide under a load, held out by themselves."""
    used = score.used
    claim = Claim(
        f"trust.{name}.coverage.blunt", f"95 % of the {name} ratios of blunt bodies lie within their interval",
        PROMISED, 0.03, "Share within the interval: n from 3, sliding under a load, h0/d 0.08 to 0.3",
    )  # fmt: skip
    return _measured(claim, lambda draw: used.taken(draw).covered, used.usable.size)


def _smooth_findings(held_out: xarray.Dataset) -> Iterator[Finding]:
    """Findings on the smooth scenes held out: their ratios as the map answers them, against more points."""
    smooth = held_out.isel(scene=np.isnan(held_out["groups"].values).all(axis=1))
    for name in QUANTITIES:
        apart = np.abs((smooth["logarithm"] - smooth["smooth"]).sel(quantity=name).dropna("scene").values)
        claim = Claim(
            f"trust.{name}.smooth", f"The {name} ratio of smooth bodies is known within 1 %", 0.0, 0.01,
            "Error of nine in ten of the smooth scenes held out, on 64 points a side against 128",
        )  # fmt: skip
        yield _measured(claim, partial(_nine_in_ten, apart), apart.size)


def _nine_in_ten(errors, draw):
    return float(np.quantile(errors[draw], 0.9))


def _measured(claim: Claim, measure: Callable[[np.ndarray], float], count: int) -> Finding:
    """Finding of a number measured on some scenes, with its interval over scenes drawn again and again."""
    if not count:
        return Finding(claim, np.nan, reason="no scene held out has it")
    rng = np.random.default_rng(0)
    draws = [measure(rng.integers(0, count, count)) for _ in range(BOOTSTRAPS)]
    low, high = np.quantile(draws, (0.025, 0.975))
    return Finding(claim, measure(np.arange(count)), (float(low), float(high)), 0.0, "exact", draws=count)
