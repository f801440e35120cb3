"""Kinds of number of a scene by name, and `{kinds}`: a table of what each allows and of its unit."""

import typing
from dataclasses import astuple

from annotated_types import Ge, Gt
from sphinx.util.docutils import SphinxDirective

import scene.quantities
from scene.quantities import Unit

BOUNDS = {Gt: "above", Ge: "at least"}


def kinds() -> dict[str, typing.Any]:
    """The annotated numbers that scene.quantities declares, by name."""
    return {
        name: alias
        for name, alias in vars(scene.quantities).items()
        if not name.startswith("_") and typing.get_origin(alias) is typing.Annotated
    }


def named(annotation) -> str | None:
    """Name of the kind that an annotation is, or narrows further; None of anything else."""
    if typing.get_origin(annotation) is not typing.Annotated:
        return None
    stated = annotation.__metadata__
    fitting = {
        name: alias.__metadata__
        for name, alias in kinds().items()
        if alias.__origin__ == annotation.__origin__ and stated[: len(alias.__metadata__)] == alias.__metadata__
    }
    return max(fitting, key=lambda name: len(fitting[name]), default=None)


def _allowed(alias) -> str:
    """Bounds in words."""
    bounds = [bound for part in alias.__metadata__ for bound in getattr(part, "metadata", ())]
    said = [f"{BOUNDS[type(bound)]} {astuple(bound)[0]}" for bound in bounds if type(bound) in BOUNDS]
    return ", ".join(said) or "any"


class Kinds(SphinxDirective):
    """The table."""

    def run(self):
        rows = ["| Name | What | Unit | With a unit, as | Allowed |", "|---|---|---|---|---|"]
        for name, alias in kinds().items():
            unit = next((part for part in alias.__metadata__ if isinstance(part, Unit)), None)
            said = (unit.kind, unit.symbol, f'`"{unit.example}"`') if unit else ("a number", "", "")
            rows.append(f"| `{name}` | {' | '.join(said)} | {_allowed(alias)} |")
        return self.parse_text_to_nodes("\n".join(rows))


def setup(app):
    app.add_directive("kinds", Kinds)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
