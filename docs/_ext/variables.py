"""`{variables}`: a table of every variable that a file of results can have, made of the vocabularies."""

from sphinx.util.docutils import SphinxDirective

from compare.solving.curve import NUMBERS
from compare.solving.vocabulary import LABELS, entry
from scene.vocabulary import FIELDS, MEASURES

COORDINATES = ("level", "points", "speed", "load", "depth", "surface")
OF_EVERY_CONTACT = ("status", "reason", *NUMBERS)
KINDS = {
    "coordinates": {name: LABELS[name] for name in COORDINATES},
    "contacts": {name: entry(name) for name in OF_EVERY_CONTACT},
    "measures": dict(sorted(MEASURES.items())),
    "fields": dict(sorted(FIELDS.items())),
}


class Variables(SphinxDirective):
    """The table of one kind: coordinates, contacts, measures or fields."""

    required_arguments = 1

    def run(self):
        found = KINDS[self.arguments[0]]
        fields = self.arguments[0] == "fields"
        rows = ["| Variable | Unit | Meaning |", "|---|---|---|"]
        if fields:
            rows = ["| Variable | Dimensions | Unit | Meaning |", "|---|---|---|---|"]
        for name, each in found.items():
            axes = f"{', '.join(f'`{axis}`' for axis in each.axes)} | " if fields else ""
            rows.append(f"| `{name}` | {axes}{_unit(each)} | {each.text} |")
        return self.parse_text_to_nodes("\n".join(rows))


def _unit(each):
    return f"{each.unit_in_words} (line: {each.along_line})" if each.along_line else each.unit_in_words


def setup(app):
    app.add_directive("variables", Variables)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
