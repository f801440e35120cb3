"""Fig. 1: the contact of the rough cone and the rough sphere."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mdr1d import MDR
from scene import Scene
from scene.scales import ElasticContact, elastic_contact

from ..outcome import Outcome, Row
from ..store import Task as AnyTask
from ..study import Task
from . import parameters


@dataclass(frozen=True)
class Configuration:
    """One contact of Fig. 1.

    scene : what was solved; row : its numbers; fields : of the solver, at the nodes
    relaxed : the smooth contact at rest under the same load
    """

    scene: Scene
    row: Row
    fields: Mapping[str, np.ndarray]
    relaxed: ElasticContact


def task(shape: str) -> Task:
    """The task of one shape."""
    return Task(MDR(points=parameters.POINTS), (parameters.contact(shape),), keeps_fields=True)


def collect(shape: str, outcomes: Mapping[AnyTask, Outcome]) -> Configuration:
    """The configuration of one shape."""
    asked = task(shape)
    outcome = outcomes[asked]
    return Configuration(asked.scenes[0], outcome.rows[0], outcome.fields, elastic_contact(asked.scenes[0]))
