"""The whole paper: what has to be solved for its figures, and what comes of it."""

from collections.abc import Mapping
from dataclasses import dataclass

from ..outcome import Outcome
from ..store import Task
from . import campaign, contacts, law, parameters, shifts
from .campaign import Campaign


@dataclass(frozen=True)
class Reproduction:
    """The data of every figure.

    contacts : of Fig. 1, by shape
    collapse : of Fig. 3
    laws : of Fig. 4, one a shape
    losses : of Figs. 5 to 7, one a rubber
    """

    contacts: Mapping[str, contacts.Configuration]
    collapse: campaign.Collapse
    laws: tuple[law.Law, ...]
    losses: tuple[shifts.Lossy, ...]

    @property
    def failed(self) -> int:
        """Solves without an answer."""
        parts = [self.collapse.failed, *(law.failed for law in self.laws), *(each.failed for each in self.losses)]
        return sum(parts)


@dataclass(frozen=True)
class Size:
    """How much is simulated.

    studies : of Fig. 3
    profiles : averaged in Fig. 4, 3 at least
    lossy : averaged in Figs. 5 to 7
    """

    studies: Campaign
    profiles: int
    lossy: int

    @classmethod
    def of(cls, profiles: int = parameters.PROFILES) -> "Size":
        """Everything on so many profiles at most; as published by default."""
        return cls(Campaign(profiles=profiles), profiles, min(profiles, parameters.LOSS_PROFILES))


def tasks(size: Size) -> list[Task]:
    """Everything that has to be solved."""
    return [
        *(contacts.task(shape) for shape in parameters.SHAPES),
        *campaign.blocks(size.studies),
        *(task for shape in parameters.SHAPES for task in law.tasks(shape, size.profiles)),
        *(task for loss in parameters.LOSSES for task in shifts.tasks(loss, size.lossy)),
    ]


def collect(size: Size, outcomes: Mapping[Task, Outcome]) -> Reproduction:
    """Put everything together."""
    return Reproduction(
        contacts={shape: contacts.collect(shape, outcomes) for shape in parameters.SHAPES},
        collapse=campaign.collect(size.studies, outcomes),
        laws=tuple(law.collect(shape, law.tasks(shape, size.profiles), outcomes) for shape in parameters.SHAPES),
        losses=tuple(shifts.collect(loss, shifts.tasks(loss, size.lossy), outcomes) for loss in parameters.LOSSES),
    )
