"""`{thumbnails}` with pages, one a line: a card for each, its title and its first picture, that leads to it."""

from docutils import nodes
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective


class Cards(nodes.General, nodes.Element):
    """Stands for the cards of `pages` until all of them are read."""


class Thumbnails(SphinxDirective):
    """Cards of the pages named in its content, relative to its own page."""

    has_content = True

    def run(self):
        return [Cards(pages=[self.env.relfn2path(f"{line}.md")[0].removesuffix(".md") for line in self.content])]


def place(app, document, docname):
    """Put the cards where they are asked for."""
    for cards in list(document.findall(Cards)):
        gallery = nodes.container(classes=["cards"])
        gallery += [_card(app, docname, page) for page in cards["pages"]]
        cards.replace_self(gallery)


def _card(app, docname, page):
    uri = app.builder.get_relative_uri(docname, page)
    title = app.env.titles[page].astext()
    pictures = list(app.env.get_doctree(page).findall(nodes.image))
    if not pictures:
        raise ExtensionError(f"{page} shows no picture to lead to it")
    picture = pictures[0].deepcopy()
    picture["alt"] = title
    link = nodes.reference("", "", picture, nodes.inline(title, title), internal=True, refuri=uri)
    return nodes.container("", nodes.paragraph("", "", link), classes=["card"])


def setup(app):
    app.add_node(Cards)
    app.add_directive("thumbnails", Thumbnails)
    app.connect("doctree-resolved", place)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
