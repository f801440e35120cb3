"""Scenes in one and in three dimensions: `crosscheck run`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from pandas import DataFrame

from scene import Refused, Scene, notes
from scene.result import labelled, provenance

from ...figures import contact, shifted_curves
from ...library.case import Case, NotCompared, doubted, share_of
from ...library.describe import conditions, described, folders
from ...library.lookup import SceneLike, named_cases
from ...models.table import ModelLike, Models, listed
from ...report.page import Block, Findings, Plot, Section, Table, Text
from ...report.views import view
from ...solving import parameter_grid, words
from ...solving.continuation import by_contact
from ...solving.outcome import Outcome
from ...solving.parameter_grid import ParameterGrid
from ...solving.task import SceneTask, Task
from ...solving.vocabulary import attributes, head
from ...statistics import eq23, finding
from ...statistics.finding import Finding
from ...statistics.means import with_spread
from ...statistics.multilevel import GROWTH, MEANS, WORDS, DrawnSurfaces, needed, unreached
from ...trustmap.verdict import Advice, trust
from ..study import Judgement, Study
from ..theory import THEORY
from .claims import ROUGH_FORCE, SMOOTH_FORCE, SMOOTH_SPEED, CaseFindings, draws_of, own_means
from .curves import (
    CURVES,
    OWN,
    SHARED,
    SLIDING,
    Strata,
    corners,
    curves,
    edge_slope,
    friction_law,
    models_of,
    predicted_exponent,
    scaled_speed,
    slow_friction,
)
from .figures import cases as friction_of_cases
from .figures import force_depth, friction_curves, smooth_limit
from .opening import opening

FIELDS, TIMES, COLLAPSE = "fields", "times", "collapse"


@dataclass(frozen=True)
class Run(Study):
    """Scenes, each with the curves around it.

    cases : by name
    asked, reference : models and the reference among them, in place of those that the cases name, see `Models.of`
    interval : half-width that is wanted of intervals of 95 %, in place of those of the cases: relative, of the
        scene's own friction, depth or force, and of claims that are not decided; None where the cases say
    strata : then numbers of surfaces on each grid, by case; see `curves.curves`
    """

    cases: Mapping[str, Case]
    asked: tuple[ModelLike, ...] = ()
    reference: str | None = None
    interval: float | None = None
    strata: Mapping[str, Strata] = field(default_factory=dict)

    command, title = "run", "One dimension against three"

    @classmethod
    def of(
        cls,
        scene: SceneLike | Sequence[str | Path] | Mapping[str, SceneLike] | None = None,
        models: Sequence[ModelLike] | None = None,
        reference: str | None = None,
        interval: float | str | None = None,
    ) -> "Run":
        """Run of a scene, of several files or by name, or of the paper's two. Raises InvalidInput, Refused."""
        if isinstance(scene, Sequence) and not isinstance(scene, str) and len(scene) == 1:
            scene = scene[0]
        asked = scene if isinstance(scene, str | Path) else "scene"
        wanted = None if interval is None else share_of("interval", interval)
        try:
            run = cls(named_cases(scene), listed(models), reference, wanted)
            run.grids()
        except NotCompared as error:
            if not isinstance(scene, str | Path):
                raise
            alone = "crosscheck plan says what each solver makes of it, and crosscheck draw shows motion in time"
            raise NotCompared(f"{error}. So {scene} cannot be compared; {alone}") from error
        except Refused as error:
            raise Refused(f"{asked}: {error}") from error
        return run

    @property
    def inputs(self) -> Mapping[str, Any]:
        told: dict[str, Any] = {"cases": {name: case.inputs for name, case in self.cases.items()}}
        names = sorted({each.name for models in self.models.values() for each in models})
        told |= {} if self.interval is None else {"interval": self.interval}
        return told if names == ["BEM", "MDR"] else told | {"models": names}

    @cached_property
    def models(self) -> Mapping[str, Models]:
        """Models of each case. Raises InvalidInput."""
        return {name: models_of(case, self.asked, self.reference) for name, case in self.cases.items()}

    @cached_property
    def doubts(self) -> tuple[str, ...]:
        """Doubts about the scene of each case as it stands, with its name where there are several.

        Also about its curves, where a table of moduli does not show what they ask for.
        """
        found = {name: doubted(case, curves=corners(self._curves[name])) for name, case in self.cases.items()}
        named = len(self.cases) > 1
        return tuple(f"{name}: {each}" if named else each for name, told in found.items() for each in told)

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """Notes on what was read for the scenes."""
        return tuple(dict.fromkeys(note for case in self.cases.values() for note in notes(case.scene)))

    @property
    def own(self) -> Sequence[SceneTask]:
        """First contact of each case in each solver, on the fine grid."""
        found = [dict(reversed(curves[OWN].contacts)) for curves in self._curves.values()]
        return [contacts[0] for each in found for contacts in each.values()]

    @cached_property
    def folders(self) -> Mapping[str, str]:
        """Folders of the cases, by name. Raises InvalidInput where two share one."""
        return folders(self.cases, "case")

    @cached_property
    def _curves(self) -> Mapping[str, Mapping[str, ParameterGrid]]:
        strata = {name: None if self._wanted(name) is None else self.strata.get(name, {}) for name in self.cases}
        return {name: curves(case, self.models[name], strata[name]) for name, case in self.cases.items()}

    def _wanted(self, name):
        """Half-width that is wanted of intervals of a case; None of fixed draws."""
        return self.cases[name].study.interval if self.interval is None else self.interval

    def _draws(self, name):
        """Surfaces of the rough curves of a case, by the name of those that share them."""
        own = {
            shared: [each for curve, each in self._curves[name].items() if curve in names]
            for shared, names in SHARED.items()
        }
        return {shared: DrawnSurfaces.of(grids) for shared, grids in own.items() if grids}

    def grids(self) -> Mapping[str, ParameterGrid]:
        """Every curve of every case, by "case/curve"."""
        return self._grids

    @cached_property
    def _grids(self):
        return {
            f"{self.folders[name]}/{curve}": each
            for name, own in self._curves.items()
            for curve, each in own.items()
        }

    def answers(self, outcomes: Mapping[Task, Outcome]) -> xarray.DataTree:
        """Every curve, the fields of each scene's own contact, and the processor time of each solver."""
        parts: dict[str, xarray.Dataset] = {}
        outcomes = by_contact(outcomes)
        for name, found in self._curves.items():
            folder = self.folders[name]
            for solver, kept in found[OWN].fields(outcomes).items():
                fields = labelled(kept, self.cases[name].indenter.type)
                parts[f"/{folder}/{FIELDS}/{solver}"] = fields.assign_attrs(provenance(self.cases[name].scene))
            parts[f"/{folder}/{TIMES}"] = _times(parameter_grid.contacts_of(found), outcomes)
        return xarray.DataTree.from_dict(
            {node.path: node.to_dataset(inherit=False) for node in super().answers(outcomes).subtree} | parts
        )

    def _judged(self, name, answers) -> CaseFindings:
        below = answers[self.folders[name]]
        datasets = {
            f"{curve}/{solver}": with_spread(node.to_dataset(inherit=False))
            for curve, solvers in below.children.items()
            if curve in CURVES
            for solver, node in solvers.children.items()
        }
        return CaseFindings(
            name, self.folders[name], self.cases[name], self.models[name], datasets, self._draws(name)
        )

    def more(self, answers: xarray.DataTree, findings: Sequence[Finding], growth: float = GROWTH) -> "Run | None":
        """The run with the surfaces that undecided claims and wide intervals ask for; None where none does."""
        sampled = self._sampled
        asked = {name: self._more(name, answers, findings, growth) for name in sampled}
        had = {name: {shared: dict(each.counts) for shared, each in self._draws(name).items()} for name in sampled}
        return None if asked == had else replace(self, strata=asked)

    def _more(self, name, answers, findings, growth):
        """Numbers of surfaces of each model on each grid, of REST and SLIDING of a case."""
        wanted, made = self._wanted(name), {}
        for shared, draws in self._draws(name).items():
            # The name of a case stands first in the place.
            here = [each for each in findings if f"{each.where}, ".startswith(f"{name}, ")]
            own = [each for each in here if draws_of(each) == shared]
            counts = draws.more(own, wanted, growth)
            for model in self.models[name].drawn:
                for mean in own_means(self.cases[name]) if shared == SLIDING else ():
                    own_contact = self._own_contact(name, model.name, answers)
                    more = needed(own_contact, *MEANS[mean], draws.costs[model.name], wanted, growth)
                    counts[model.name] = tuple(map(max, counts[model.name], more))
            made[shared] = counts
        return made

    def _own_contact(self, name, model, answers):
        """Answers of a model to a scene as it stands."""
        return answers[f"{self.folders[name]}/{OWN}/{model}"].to_dataset(inherit=False)

    def _unreached(self, answers):
        """Sentences on means of scenes as they stand whose intervals are wider than wanted."""
        for name in self._sampled:
            for model, mean in product(self.models[name].drawn, own_means(self.cases[name])):
                own_contact = self._own_contact(name, model.name, answers)
                if why := unreached(own_contact, *MEANS[mean], self._wanted(name)):
                    yield f"{name}: the {WORDS[mean]} in {model.label} {why}."

    @property
    def _sampled(self):
        """Names of the rough cases of which an interval is wanted."""
        return [name for name, case in self.cases.items() if self._wanted(name) is not None and case.roughness]

    @cached_property
    def trusts(self) -> Mapping[str, Advice]:
        """Advice of the trust map on 1D, by case: predicted, and not from what is solved here."""
        return {name: trust(case.scene) for name, case in self.cases.items()}

    def judge(self, answers: xarray.DataTree) -> Judgement:
        cases = [self._judged(name, answers) for name in self.cases]
        findings = [each for case in cases for each in case.findings]
        claims = words.sentences(finding.claimed(findings))
        answer = [*claims, *eq23.answers(findings), *self._unreached(answers)]
        blocks: list[Block] = [
            Section(case.case.title or case.name, _blocks(case, answers[case.folder], self.trusts[case.name]))
            for case in cases
        ]
        if len(cases) > 1:
            blocks += _side_by_side(cases)
            every = Table("summary", summary(cases), "Number and verdict, or counts of verdicts, of each case.")
            blocks.append(Section("Every claim in every case", [every]))
        first = [opening(each, self.trusts[each.name]) for each in cases]
        return Judgement(findings, answer, blocks, self.setting, first)

    @property
    def setting(self) -> Sequence[Block]:
        """Scene and settings of each case, and how a case of the paper departs from it."""
        return [
            block
            for name, case in self.cases.items()
            for block in _setting(case.title or name, case, self.models[name], self._curves[name])
        ]


def _blocks(found: CaseFindings, answers, trusted: Advice) -> list[Block]:
    folder = f"{found.folder}/"
    others = [each for each in found.findings if each.verdict == finding.REPORTED]
    blocks: list[Block] = [
        *_plots(found, answers),
        Findings(
            finding.claimed(found.findings),
            "Claims: intervals of 95 % with the scatter of surfaces and the error of the grid.",
        ),
        Findings(others, "Numbers that tell how far these can be trusted."),
        Table(
            f"{folder}trust",
            trusted.table(),
            " ".join(filter(None, ["Advice of the trust map on cheap models, predicted.", trusted.choice])),
        ),
        Table(f"{folder}points", found.points, "Every point of every curve.", long=True),
    ]
    if len(found.failures):
        blocks.append(Table(f"{folder}failures", found.failures, "Solves without an answer."))
    times = answers[TIMES].to_dataset(inherit=False).to_dataframe().reset_index()
    return [
        *blocks,
        Table(f"{folder}times", times, "Processor time of all solves, those of earlier runs included."),
    ]


def _side_by_side(cases: Sequence[CaseFindings]) -> list[Block]:
    """Friction, and depth or force, of all scenes as they stand in one table, and their friction in one figure."""
    rows = []
    for each, name in ((case, name) for case in cases for name in own_means(case.case)):
        row: dict[str, Any] = {"case": each.name, "contact": conditions(each.case.motion), "quantity": head(name)}
        for label, (value, low, high) in each.own(name).items():
            row |= {label: value, f"{label}_low": low, f"{label}_high": high}
        rows.append(row)
    told = "Every scene as it stands: means with intervals of 95 %, and their ratios."
    drawn = friction_of_cases.plot(
        {each.name: each.points[each.points["solver"].isin(each.models.labels)] for each in cases},
        {each.name: each.case.motion.speed for each in cases},
    )
    return [Table(friction_of_cases.NAME, DataFrame(rows), told), *([drawn] if drawn else [])]


def summary(cases: Sequence[CaseFindings]) -> DataFrame:
    """A row for each claim, dimension and case: number and verdict, or counts of verdicts."""
    rows: dict[tuple[str, str], dict[str, list[Finding]]] = {}
    for case in cases:
        for each in finding.claimed(case.findings):
            place = each.claim.sentence, each.dimension or each.claim.dimension
            rows.setdefault(place, {}).setdefault(case.name, []).append(each)
    return DataFrame(
        [
            (sentence, dimension, case, _cell(each))
            for (sentence, dimension), found in rows.items()
            for case, each in found.items()
        ],
        columns=["sentence", "dimension", "case", "verdict"],
    )


def _cell(found: Sequence[Finding]) -> str:
    """One number with its verdict, or how often each verdict stands."""
    if len(found) == 1:
        return f"{words.found(found[0], 3)}, {found[0].verdict}"
    counts = {name: sum(each.verdict == name for each in found) for name in words.VERDICTS}
    return ", ".join(f"{name} {count} of {len(found)}" for name, count in counts.items() if count)


def _setting(title: str, case: Case, models: Models, curves: Mapping[str, ParameterGrid]) -> Iterator[Block]:
    """Scene in words, averages, grids and notes of a case; departures only of a case of the paper."""
    parts = [(each.name, getattr(case, each.name)) for each in fields(Scene)]
    lines = [f"{name}: {described(part)}" for name, part in parts if part is not None]
    lines.append(f"averaged: {_averaged(curves, models) if case.roughness else 'one smooth body'}")
    lines.append(f"grids: {_grids_of(models)}")
    lines += [each.claim for each in models if each.claim]
    yield Section(f"Scene: {title}", [_list([*lines, *case.notes])])
    if case.departures:
        yield Section(f"How this departs from the paper: {title}", [_list(case.departures)])


def _averaged(curves: Mapping[str, ParameterGrid], models: Models) -> str:
    """Numbers of draws of each model in words, by the grids that they are solved on."""
    found = {}
    for shared, names in SHARED.items():
        for own in [each for name, each in curves.items() if name in names][:1]:
            told = [f"{own.told(each.name, each.draws)} in {each.label}" for each in models.drawn]
            found[shared] = ", ".join(told)
    if len(set(found.values())) == 1:
        return found.popitem()[1]
    return "; ".join(f"{shared}: {told}" for shared, told in found.items())


def _grids_of(models: Models) -> str:
    """Points of each model in words."""
    own = {"MDR": "points in 1D", "BEM": "a side in 3D"}
    told = [
        f"{each.solver.points} {own.get(each.name, f'points of {each.label}')}"
        for each in models
        if hasattr(each.solver, "points")
    ]
    return f"{', '.join(told)}, and half as many" if told else "none"


def _list(lines: Sequence[str]) -> Text:
    return Text("\n".join(f"- {line}" for line in lines))


def _plots(found: CaseFindings, answers) -> list[Plot]:
    """Figures of a case."""
    case, folder, points = found.case, f"{found.folder}/", found.points
    motion, law = case.motion, partial(friction_law, case)
    beside = points["solver"] == ("" if THEORY.name in found.models.labels else THEORY.name)
    theory, judged = points[beside], points[~beside]
    below = answers.children.get(FIELDS, xarray.DataTree()).children
    fields = {
        solver: {str(name): each.values for name, each in node.variables.items()} for solver, node in below.items()
    }
    load, depth = f"load of {motion.greatest:g} N", f"depth of {motion.greatest * 1e6:g} µm"
    pressed = load if motion.load is not None else depth
    forces = [
        (body, *row)
        for claim, body in ((ROUGH_FORCE, "rough"), (SMOOTH_FORCE, "smooth"))
        for row in found.forces(claim)
    ]
    seen = view(case.scene, case.bem, fields)
    plots = [
        contact.plot(case.scene, seen, folder=folder) if seen else None,
        force_depth.plot(points, forces, folder),
        friction_curves.against_speed(judged, found.at_speeds, law, pressed, theory, folder),
        friction_curves.against_load(judged, law, theory, folder),
        _shifted_curves(found),
        _smooth_limit(found),
    ]
    return [each for each in plots if each is not None]


def _shifted_curves(found: CaseFindings) -> Plot | None:
    """Friction against load shifted onto one curve."""
    expected = predicted_exponent(found.case)
    rows = [
        shifted_curves.ShiftedCurves(
            found.models[each.solver].label,
            each.collapse,
            {one.claim.id: one for one in each.findings},
            expected,
            lead=eq23.leading(each.collapse, each.findings),
        )
        for each in found.shifted
    ]
    plot = shifted_curves.plot(rows, COLLAPSE)
    return plot and replace(plot, name=f"{found.folder}/{COLLAPSE}")


def _smooth_limit(found: CaseFindings) -> Plot | None:
    """Friction of the smooth body from slow to fast."""
    points = found.points[found.points["curve"] == SMOOTH_SPEED]
    if points.empty:
        return None
    table = DataFrame(
        {
            "solver": points["solver"],
            "v_tau_over_a": [scaled_speed(found.case, speed) for speed in points["speed"]],
            "speed": points["speed"],
            "friction_coefficient": points["friction_coefficient_mean"],
            "friction_over_slope": points["friction_coefficient_mean"] / edge_slope(found.case),
        }
    )
    return smooth_limit.plot(
        table, slow_friction(found.case, found.models), found.models.reference, f"{found.folder}/"
    )


def _times(contacts: Sequence[SceneTask], outcomes: Mapping[Task, Outcome]) -> xarray.Dataset:
    """Processor time of all solves by solver, each contact once."""
    spent: dict[str, float] = {}
    for each in contacts:
        seconds = float(np.nansum([row.seconds for row in outcomes[each].rows]))
        spent[each.solver.name] = spent.get(each.solver.name, 0.0) + seconds
    solvers = xarray.Variable("solver", list(spent), attributes("solver"))
    return xarray.Dataset(
        {"seconds": ("solver", list(spent.values()), attributes("seconds"))}, {"solver": solvers}
    )
