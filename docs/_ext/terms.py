"""The first use on a page of a term of the glossary links to it; without Sphinx it is plain text."""

import re

from docutils import nodes
from equations import is_prose
from sphinx.transforms.post_transforms import SphinxPostTransform

PAGE = "reference/glossary"
# Terms that are also words of any sentence, or have another meaning in some.
WORDS = "claim draw factor fails holds multiply path program ratio reference reported scene solve stage tolerance"
COMMON = {*WORDS.split(), "use", "window"}


class Linked(SphinxPostTransform):
    """First uses of terms become links, in paragraphs, lists and tables."""

    default_priority = 910  # after the numbers of equations

    def run(self):
        if self.env.docname == PAGE:
            return
        objects = self.env.domains.standard_domain.objects
        terms = {name: place for (kind, name), place in objects.items() if kind == "term" and name not in COMMON}
        # The longest first: "trust map" before "map". "ξ (xi)" is known by either.
        named = {each: place for name, place in terms.items() for each in re.split(r" \(|\)", name) if each}
        for link in self.document.findall(nodes.reference):
            if "glossary.html#" in link.get("refuri", ""):  # linked by the page itself, for GitHub
                named.pop(link.astext().removesuffix("s"), None)
        known = {form: place for each, place in named.items() for form in (each, each[0].upper() + each[1:])}
        for text in list(self.document.findall(nodes.Text)):
            if known and is_prose(text) and not _in_title(text):
                text.parent.replace(text, list(self.pieces(str(text), known)))

    def pieces(self, text, known):
        """The text, with a link for each term that was not met before; it is taken out of the known ones."""
        while known:
            match = re.search(rf"\b({'|'.join(map(re.escape, sorted(known, key=len, reverse=True)))})s?\b", text)
            if match is None:
                break
            page, anchor = known[match[1]]
            uri = self.app.builder.get_relative_uri(self.env.docname, page) + f"#{anchor}"
            yield nodes.Text(text[: match.start()])
            yield nodes.reference(match[0], match[0], internal=True, refuri=uri, classes=["term"])
            for name in [name for name, place in known.items() if place == known[match[1]]]:
                del known[name]
            text = text[match.end() :]
        yield nodes.Text(text)


def _in_title(text) -> bool:
    node = text.parent
    while node is not None:
        if isinstance(node, nodes.title | nodes.term | nodes.caption | nodes.comment | nodes.raw):
            return True
        node = node.parent
    return False


def setup(app):
    app.add_post_transform(Linked)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
