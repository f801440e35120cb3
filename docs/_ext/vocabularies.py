"""Tables of what the packages know.

`{kinds}`: kinds of number of a scene, what each allows, its unit; `{doubts}`: limits that raise a doubt;
`{variables} KIND`: every variable that a file of results can have.
"""

from dataclasses import astuple
from functools import partial

from annotated_types import Ge, Gt
from sphinx.util.docutils import SphinxDirective

from compare.solving.curve import NUMBERS
from compare.solving.vocabulary import LABELS, entry
from scene import signatures
from scene.doubt import LIMITS
from scene.quantities import Unit
from scene.vocabulary import FIELDS, MEASURES

BOUNDS = {Gt: "above", Ge: "at least"}
COORDINATES = ("level", "points", "speed", "load", "depth", "surface")
OF_EVERY_CONTACT = ("status", "reason", *NUMBERS)


def kinds():
    """Kinds of number with their bounds in words."""
    yield "Name", "What", "Unit", "With a unit, as", "Allowed"
    for name, alias in signatures.kinds().items():
        unit = next((part for part in alias.__metadata__ if isinstance(part, Unit)), None)
        stated = (unit.kind, unit.symbol, f'`"{unit.example}"`') if unit else ("a number", "", "")
        bounds = [bound for part in alias.__metadata__ for bound in getattr(part, "metadata", ())]
        allowed = [f"{BOUNDS[type(bound)]} {astuple(bound)[0]}" for bound in bounds if type(bound) in BOUNDS]
        yield f"`{name}`", *stated, ", ".join(allowed) or "any"


def doubts():
    """Limits, and why a number beyond is doubted."""
    yield "Number", "Doubted", "Why"
    for each in LIMITS:
        yield each.name, f"{'above' if each.most else 'below'} {each.limit:g} {each.unit}", each.why


def variables(found):
    """Variables with the dimensions of those that have some, and units."""
    dimensions = any(each.axes for each in found.values())
    yield "Variable", *["Dimensions"] * dimensions, "Unit", "Meaning"
    for name, each in found.items():
        axes = ", ".join(f"`{axis}`" for axis in each.axes)
        line = f" (line: {each.along_line})" if each.along_line else ""
        yield f"`{name}`", *[axes] * dimensions, each.unit_in_words + line, each.text


TABLES = {
    "kinds": kinds,
    "doubts": doubts,
    "coordinates": partial(variables, {name: LABELS[name] for name in COORDINATES}),
    "contacts": partial(variables, {name: entry(name) for name in OF_EVERY_CONTACT}),
    "measures": partial(variables, dict(sorted(MEASURES.items()))),
    "fields": partial(variables, dict(sorted(FIELDS.items()))),
}


class Table(SphinxDirective):
    """The table that the directive or its argument names."""

    optional_arguments = 1

    def run(self):
        header, *rows = TABLES[[self.name, *self.arguments][-1]]()
        lines = [header, ["---"] * len(header), *rows]
        return self.parse_text_to_nodes("\n".join(f"| {' | '.join(line)} |" for line in lines))


def setup(app):
    for name in ("kinds", "doubts", "variables"):
        app.add_directive(name, Table)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
