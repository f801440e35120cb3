"""`{kinds}`: kinds of number of a scene, what each allows, its unit; `{doubts}`: limits that raise a doubt."""

from dataclasses import astuple

from annotated_types import Ge, Gt
from sphinx.util.docutils import SphinxDirective

from scene.doubt import LIMITS
from scene.quantities import Unit
from scene.signatures import kinds

BOUNDS = {Gt: "above", Ge: "at least"}


def _allowed(alias) -> str:
    """Bounds in words."""
    bounds = [bound for part in alias.__metadata__ for bound in getattr(part, "metadata", ())]
    stated = [f"{BOUNDS[type(bound)]} {astuple(bound)[0]}" for bound in bounds if type(bound) in BOUNDS]
    return ", ".join(stated) or "any"


class Kinds(SphinxDirective):
    """The table."""

    def run(self):
        rows = ["| Name | What | Unit | With a unit, as | Allowed |", "|---|---|---|---|---|"]
        for name, alias in kinds().items():
            unit = next((part for part in alias.__metadata__ if isinstance(part, Unit)), None)
            stated = (unit.kind, unit.symbol, f'`"{unit.example}"`') if unit else ("a number", "", "")
            rows.append(f"| `{name}` | {' | '.join(stated)} | {_allowed(alias)} |")
        return self.parse_text_to_nodes("\n".join(rows))


class Doubts(SphinxDirective):
    """The table of limits."""

    def run(self):
        rows = ["| Number | Doubted | Why |", "|---|---|---|"]
        for each in LIMITS:
            side = "above" if each.most else "below"
            rows.append(f"| {each.name} | {side} {each.limit:g} {each.unit} | {each.why} |")
        return self.parse_text_to_nodes("\n".join(rows))


def setup(app):
    app.add_directive("doubts", Doubts)
    app.add_directive("kinds", Kinds)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
