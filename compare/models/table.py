"""Models as the judge sees them: by which name they are asked for, what they are called, what their draws are."""

import json
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, is_dataclass
from functools import cached_property
from importlib import import_module
from importlib.metadata import entry_points
from typing import Any, Literal, TypeAlias, cast, get_args

from bem3d import BEM
from mdr1d import MDR
from scene import Solver
from scene.files.reading import InvalidInput, whole
from scene.printable import brief
from scene.quantities import MOST_WHOLE

from ..solving.suggest import suggestion

GROUP = "crosscheck.models"  # of entry points, by which installed packages add models
Draws: TypeAlias = Literal["profiles", "surfaces", "none"]
DRAWS: tuple[Draws, ...] = get_args(Draws)
PROFILES, SURFACES, NONE = DRAWS
FRICTION, FORCE, DEPTH = QUANTITIES = "friction", "force", "depth"  # that a model may have a claim on
# A model as it is asked for: an object of the protocol `scene.Solver`, or a name.
ModelLike: TypeAlias = Solver | str
# Label and draws of those that come with the package, by the name of the solver; others state their own.
KNOWN: Mapping[str, tuple[str, Draws]] = {"MDR": ("1D", PROFILES), "BEM": ("3D", SURFACES)}
OWN = {"mdr": MDR, "bem": BEM}  # models that a scene has settings for, by the name of these
THEORIES = {  # imported when they are asked for
    "persson": "compare.models.law.persson:Persson",
    "extended": "compare.models.law.extended:ExtendedBEM",
    "law": "compare.trustmap.friction_law:FrictionLaw",
}


@dataclass(frozen=True)
class Model:
    """One model to the judge.

    solver : answers scenes, see `scene.Solver`
    label : what it is called in words: 1D, 3D, or as its attribute `label` says; its name, if it has none
    draws : what its means are taken over, as its attribute `draws` says: profiles in one dimension, surfaces, or
        none of what answers for all surfaces at once; surfaces, if it has none
    answers : quantities that it has a claim on, as its attribute `answers` says: friction, force at a depth, depth
        under a load; all, if it has none
    """

    solver: Solver
    label: str
    draws: Draws
    answers: tuple[str, ...] = QUANTITIES

    @classmethod
    def of(cls, solver: Solver) -> "Model":
        """The row of a solver. Raises InvalidInput where it is none."""
        given = f"models = {brief(repr(solver))}"
        if not is_dataclass(solver) or isinstance(solver, type) or not callable(getattr(solver, "solve", None)):
            raise InvalidInput(
                f"{given}: an object of a frozen dataclass with `name` and `solve(scene)` is allowed"
            )
        name = getattr(solver, "name", None)
        label, draws = KNOWN.get(name, (name, SURFACES)) if isinstance(name, str) else ("", SURFACES)
        label = str(getattr(solver, "label", label))
        for what, text, without in (("name", name, "/\\$"), ("label", label, "$")):
            if not (isinstance(text, str) and text.strip(". ") and text.isprintable()) or set(text) & set(without):
                allowed = f"printable letters without {' '.join(without)}"
                raise InvalidInput(f"{given}: its `{what}` is {brief(repr(text))}, {allowed} are allowed")
        try:
            json.dumps(asdict(solver))
        except (TypeError, ValueError) as error:
            raise InvalidInput(
                f"{given}: its settings are to be numbers, texts and rows of them: {error}"
            ) from error
        if hasattr(solver, "points"):
            whole(f"{given}: its `points`", solver.points, MOST_WHOLE)
        draws = cast(Draws, getattr(solver, "draws", draws))
        if draws not in DRAWS:
            raise InvalidInput(f"{given}: its `draws` is {brief(repr(draws))}, {', '.join(DRAWS)} are allowed")
        answers = getattr(solver, "answers", QUANTITIES)
        if not isinstance(answers, tuple) or not answers or not set(answers) <= set(QUANTITIES):
            raise InvalidInput(
                f"{given}: its `answers` is {brief(repr(answers))}, a tuple of {', '.join(QUANTITIES)} is allowed"
            )
        return cls(solver, label, draws, answers)

    @property
    def name(self) -> str:
        """Name of the solver, under which its answers stand."""
        return self.solver.name

    @property
    def dimension(self) -> str:
        """1D of what draws profiles, else 3D: which laws it must hold."""
        return "1D" if self.draws == PROFILES else "3D"

    def tells(self, pressed_by: str, slides: bool) -> bool:
        """Whether it has a claim on contacts under a load or at a depth, that slide or rest: its grids are solved.

        At a depth friction is a coefficient only with the force.
        """
        if pressed_by in ("depth", "gap"):
            return FORCE in self.answers
        return DEPTH in self.answers or (slides and FRICTION in self.answers)

    @property
    def claim(self) -> str:
        """Sentence on what it has a claim on; empty where that is everything."""
        if set(self.answers) == set(QUANTITIES):
            return ""
        return f"{self.label} has a claim on {' and '.join(self.answers)} alone: it is left out of all else"

    @property
    def has_grid(self) -> bool:
        """Whether half its points can be asked for, which tells the error of its grid."""
        return hasattr(self.solver, "points")

    @property
    def slow_factor(self) -> float:
        """Friction of a smooth, slow body over that in three dimensions: 2 in one dimension."""
        return 2.0 if self.draws == PROFILES else 1.0

    def count(self, profiles: int, surfaces: int) -> int:
        """Number of its draws."""
        return {PROFILES: profiles, SURFACES: surfaces, NONE: 1}[self.draws]


@dataclass(frozen=True)
class Models:
    """Models that are judged together, one of them the reference against which the others are.

    models : one after the other, the reference among them
    reference : name of the reference
    """

    models: tuple[Model, ...]
    reference: str

    @classmethod
    def of(
        cls,
        asked: Sequence[ModelLike] | None = None,
        reference: str | None = None,
        own: Mapping[str, Solver] | None = None,
    ) -> "Models":
        """Models that are asked for; MDR and BEM by default.

        reference : name of the model that others are compared with; BEM by default, else the last of them
        own : solvers with the settings of a scene, by the names mdr and bem

        Raises InvalidInput for an unknown name, two models with the same name, fewer than two models, and an
        unknown reference.
        """
        settings: Mapping[str, Solver] = own if own is not None else {name: make() for name, make in OWN.items()}
        found = [
            Model.of(named(each, settings) if isinstance(each, str) else each)
            for each in listed(asked) or settings
        ]
        names = [each.name for each in found]
        if len(set(names)) < len(names):
            raise InvalidInput(f"models = {', '.join(names)}: two have one name, each its own is allowed")
        if len(found) < 2:
            raise InvalidInput(f"models = {', '.join(names)}: at least two are compared")
        by_name = {each.lower(): each for each in names}
        if reference and reference.lower() not in by_name:
            raise InvalidInput(f"reference = {brief(repr(reference))}: one of {', '.join(names)} is allowed")
        return cls(tuple(found), by_name[reference.lower()] if reference else _reference(names))

    def claiming(self, pressed_by: str, slides: bool) -> "Models":
        """Models with a claim on some contacts, see `Model.tells`. Raises InvalidInput where there is none."""
        found = tuple(each for each in self.models if each.tells(pressed_by, slides))
        names = [each.name for each in found]
        if not found:
            given = ", ".join(f"{each.name} ({', '.join(each.answers)})" for each in self.models)
            raise InvalidInput(f"models = {given}: none has a claim on contacts under a prescribed {pressed_by}")
        return Models(found, self.reference if self.reference in names else _reference(names))

    def __getitem__(self, name: str) -> Model:
        return self._by_name[name]

    def __iter__(self) -> Iterator[Model]:
        return iter(self.models)

    @cached_property
    def _by_name(self):
        return {each.name: each for each in self.models}

    @property
    def labels(self) -> dict[str, str]:
        """Labels by name."""
        return {each.name: each.label for each in self.models}

    @property
    def judged(self) -> list[Model]:
        """All but the reference."""
        return [each for each in self.models if each.name != self.reference]

    @property
    def drawn(self) -> list[Model]:
        """All that draw surfaces or profiles."""
        return [each for each in self.models if each.draws != NONE]

    def pair_label(self, name: str) -> str:
        """Dimension in findings of a ratio of this model over the reference: 1D/3D."""
        return f"{self[name].label}/{self[self.reference].label}"


def model_of(asked: ModelLike) -> Model:
    """Row of a model, of its name, or of a class that needs no settings. Raises InvalidInput."""
    solver: Any = named(asked, {name: make() for name, make in OWN.items()}) if isinstance(asked, str) else asked
    return Model.of(_made(solver, repr(asked)))


def listed(asked: Sequence[ModelLike] | None) -> tuple[ModelLike, ...]:
    """Models one by one, also of names separated by commas; none where none is asked for."""
    given = [asked] if isinstance(asked, str) else [] if asked is None else asked
    if not isinstance(given, Sequence) or isinstance(given, bytes | bytearray | memoryview):
        raise InvalidInput(f"models = {brief(repr(given))}: names or models in a list")
    parts = [each.split(",") if isinstance(each, str) else [each] for each in given]
    return tuple(each.strip() if isinstance(each, str) else each for part in parts for each in part)


def named(name: str, own: Mapping[str, Solver]) -> Solver:
    """Model of a name: one of the scene's, of an installed package, or MODULE:NAME. Raises InvalidInput."""
    if name.lower() in own:
        return own[name.lower()]
    installed = {each.name: each for each in entry_points(group=GROUP)}
    place = THEORIES.get(name.lower(), name)
    if name in installed:
        found = installed[name].load()
    elif ":" in place:
        module, _, attribute = place.partition(":")
        # A console command does not look where it is called. Last, as no file there may hide an installed module.
        if place == name and os.getcwd() not in sys.path:
            sys.path.append(os.getcwd())
        try:
            found = getattr(import_module(module), attribute)
        except (ImportError, AttributeError, ValueError) as error:
            raise InvalidInput(f"models = {brief(repr(name))}: cannot be imported: {brief(str(error))}") from error
    else:
        known = [*own, *THEORIES, *installed]
        meant = suggestion(name, known) or "."
        raise InvalidInput(
            f"models = {brief(repr(name))}: no model of that name{meant} There are {', '.join(known)}, those of "
            f"installed packages (entry points {GROUP}), and, on the command line or from Python, MODULE:NAME"
        )
    return _made(found, repr(name))


def _reference(names: Sequence[str]) -> str:
    """The reference where none is named: BEM if it is among them, else the last."""
    return next((each for each in names if each.lower() == "bem"), names[-1])


def _made(found: Any, name: str) -> Any:
    """Object of a class without settings, or the object itself."""
    try:
        return found() if isinstance(found, type) else found
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"models = {brief(name)}: cannot be made without settings: name an object") from error
