"""Text of a page, which is Markdown, as HTML and as plain words."""

from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

from . import mathematics

_PARSER = MarkdownIt("commonmark", {"html": False}).use(
    dollarmath_plugin,
    allow_labels=False,
    allow_space=False,
    allow_digits=False,
    renderer=lambda latex, options: mathematics.mathml(latex.strip()),
)
BREAKS = {"softbreak": " ", "hardbreak": "\n"}


def html(markdown: str) -> str:
    """Markdown as HTML; marks of HTML in it are shown as text."""
    return _PARSER.render(markdown)


def plain(markdown: str) -> str:
    """Text without the marks of Markdown, its formulas in plain letters."""
    return "".join(_words(_PARSER.parse(markdown))).strip()


def _words(tokens):
    for token in tokens:
        if token.type == "inline":
            yield from _words(token.children)
        elif token.type.startswith("math"):
            yield mathematics.plain(token.content.strip())
        elif token.type == "list_item_open":
            yield "- "
        elif token.type == "paragraph_close":
            yield "\n" if token.hidden else "\n\n"
        else:
            yield BREAKS.get(token.type, token.content)
