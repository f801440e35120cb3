"""Something to draw for every figure module: made-up answers of their tests, and the kept numbers of effects."""

import csv
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from math import nan
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import test_compare_paper_figures as paper
import test_compare_study_figures as study
import test_compare_verdict as verdict
import test_compare_workprecision_costs as costs
import test_compare_workprecision_models as models
import test_compare_workprecision_numerics as numerics
from test_compare_topography import sampled

from compare.figures import (
    collapse,
    contact,
    effect_costs,
    effect_layer,
    effect_motions,
    effect_shear,
    effect_temperature,
    effect_topography,
    force_depth,
    friction_load,
    friction_speed,
    paper_contacts,
    paper_law,
    paper_losses,
    paper_sketch,
    paper_studies,
    shifted_curves,
    smooth_limit,
    study_collapse,
    study_depth,
    study_effects,
    study_family,
    study_levels,
    study_pressed_in,
    study_shifts,
    study_verdicts,
    topography,
    workprecision,
    workprecision_costs,
    workprecision_models,
    workprecision_surfaces,
)
from compare.paper import contacts, parameters
from compare.topography import describe
from scene import SelfAffine

KEPT = Path(__file__).parent.parent / "docs" / "effects"


def judgement():
    """Of a rough sphere, with a contact of a few pixels."""
    x = np.linspace(-2e-3, 2e-3, 65)
    height, flat = x**2 / 2e-2, np.maximum(2e-5 - x**2 / 2e-2, 0.0)
    pressure = np.sqrt(np.maximum(1 - (x**2 + x[:, None] ** 2) / 1e-6, 0.0)) * 1e5
    fields = {
        "MDR": {"x": x, "profile": height, "displacement": flat, "contact": flat > 0},
        "BEM": {"x": x, "y": x, "pressure": pressure},
    }
    return replace(verdict.judged(), fields=fields)


def kept(module: ModuleType) -> list[dict[str, Any]]:
    """The rows that a figure of an effect draws, as the repository keeps them."""
    with (KEPT / f"{module.NAME}.csv").open(newline="") as file:
        return [{name: _number(text) for name, text in row.items()} for row in csv.DictReader(file)]


def _number(text):
    try:
        return float(text)
    except ValueError:
        return text


def found_contacts():
    """Of the cone and the sphere of the paper, solved."""
    return {
        shape: contacts.collect(shape, {contacts.task(shape): contacts.task(shape).solve()})
        for shape in parameters.SHAPES
    }


def described():
    """A map drawn from a spectrum."""
    length = 4e-3
    return describe(sampled(SelfAffine(hurst=0.8, rms_height=2e-6, longest=length, shortest=length / 24, seed=3)))


def compared():
    """Series of one shape that differ in roughness."""
    members = [
        study.judged(
            study.sliding(
                replace(
                    study.SERIES,
                    name=f"h{k}",
                    title=f"Sphere, rms height {height * 1e6:g} µm",
                    scene=replace(study.SCENE, roughness=replace(study.SCENE.roughness, rms_height=height)),
                )
            )
        )
        for k, height in enumerate((5e-6, 1e-5, 2e-5))
    ]
    return study.study(*members)


EVERY: dict[ModuleType, Callable[[], Any]] = {
    collapse: judgement,
    contact: judgement,
    force_depth: judgement,
    friction_load: judgement,
    friction_speed: judgement,
    smooth_limit: judgement,
    effect_costs: lambda: kept(effect_costs),
    effect_layer: lambda: kept(effect_layer),
    effect_motions: lambda: kept(effect_motions),
    effect_shear: lambda: kept(effect_shear),
    effect_temperature: lambda: kept(effect_temperature),
    effect_topography: lambda: kept(effect_topography),
    paper_contacts: found_contacts,
    paper_law: lambda: [paper.rule("cone", 1.4), paper.rule("sphere", 1.5)],
    paper_losses: lambda: [paper.lossy(), paper.lossy(), paper.lossy()],
    paper_sketch: lambda: None,
    paper_studies: paper.studies,
    shifted_curves: lambda: [paper.lossy().whole, paper.lossy().rough],
    study_collapse: lambda: study.judged(study.sliding()),
    study_depth: study.resting,
    study_effects: study.resting,
    study_family: compared,
    study_levels: lambda: study.judged(study.sliding()),
    study_pressed_in: lambda: study.resting((1e-3, 1e-2, 1e-1)),
    study_shifts: lambda: study.judged(study.sliding()),
    study_verdicts: lambda: study.study(study.judged(study.sliding()), study.resting()),
    topography: described,
    workprecision: lambda: [numerics.drawn([1e-2, nan, 1e-3, 1e-4], reference_error=3e-4, by=(None, "by loss"))],
    workprecision_costs: lambda: costs.COSTS.judge("quick", costs.made()),
    workprecision_models: lambda: [models.contest(), models.made()],
    workprecision_surfaces: lambda: [models.made()],
}


@cache
def sample(module: ModuleType) -> Any:
    """What the module is given to draw; made once."""
    return EVERY[module]()
