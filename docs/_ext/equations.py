"""Numbered equations: `$$ ... \\tag{5a} $$` of the theory is a target, and "(5a)" in its text links to it.

"theory, Eq. 5a" links to it from every other page. Where the pages are read as they are, both remain plain text.
"""

import re

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

PAGE = "explanation/theory"
_TAG = re.compile(r"\\tag\{(\w+)\}")
_HERE = re.compile(r"\((\d+[a-z]?)\)")
_ELSEWHERE = re.compile(r"theory, Eqs?\. (\d+[a-z]?)")


def collect(app, document):
    """Give every numbered equation of the page its anchor and remember it; a number used twice is an error."""
    if app.env.docname != PAGE:
        return
    app.env.numbered_equations = found = set()
    for block in document.findall(nodes.math_block):
        for number in _TAG.findall(block.astext()):
            if number in found:
                raise ValueError(f"equation ({number}) of {PAGE} is there twice")
            found.add(number)
            block["ids"].append(f"eq-{number}")


class Linked(SphinxPostTransform):
    """Numbers of equations in the text become links."""

    default_priority = 900

    def run(self):
        here = self.env.docname == PAGE
        pattern = _HERE if here else _ELSEWHERE
        for text in list(self.document.findall(nodes.Text)):
            if is_prose(text) and pattern.search(text):
                text.parent.replace(text, list(self.pieces(str(text), pattern)))

    def pieces(self, text, pattern):
        """The text and, in it, a link for each number of an equation that is there."""
        known, end = self.env.numbered_equations, 0
        for match in pattern.finditer(text):
            if match[1] in known:
                yield nodes.Text(text[end : match.start()])
                target = self.app.builder.get_relative_uri(self.env.docname, PAGE) + f"#eq-{match[1]}"
                yield nodes.reference(match[0], match[0], internal=True, refuri=target)
                end = match.end()
        yield nodes.Text(text[end:])


def is_prose(text) -> bool:
    node = text.parent
    while node is not None:
        if isinstance(node, (nodes.literal, nodes.literal_block, nodes.math, nodes.math_block, nodes.reference)):
            return False
        node = node.parent
    return True


def setup(app):
    app.connect("doctree-read", collect)
    app.add_post_transform(Linked)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
