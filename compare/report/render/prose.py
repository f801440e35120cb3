"""Text of a page, which is Markdown of a few marks, as HTML and as plain words."""

from collections.abc import Sequence
from pathlib import PurePosixPath
from urllib.parse import unquote, urlsplit

from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin

from . import mathematics

# All that a text may have: no image, which would be loaded, and nothing else that a scene does not need.
MARKS = ("list", "emphasis", "backticks", "link", "escape", "entity", "newline", "balance_pairs", "fragments_join")
_PARSER = (
    MarkdownIt("zero")
    .enable(MARKS)
    .use(
        dollarmath_plugin,
        allow_labels=False,
        allow_space=False,
        allow_digits=False,
        renderer=lambda latex, options: mathematics.mathml(latex.strip()),
    )
)
BREAKS = {"softbreak": " ", "hardbreak": "\n"}


def html(markdown: str) -> str:
    """Markdown as HTML; marks of HTML in it are shown as text."""
    return _PARSER.render(markdown)


def tokens(markdown: str) -> Sequence[Token]:
    """Parts of a text, as markdown-it has them."""
    return _PARSER.parse(markdown)


def plain(markdown: str) -> str:
    """Text without the marks of Markdown, its formulas in plain letters."""
    return "".join(_words(tokens(markdown))).strip()


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


def _allowed(url):
    """Whether a link leads to the web, or to a file in the folder of the page."""
    try:
        parts = urlsplit(unquote(url))
    except ValueError:
        return False
    if parts.scheme or parts.netloc:
        return parts.scheme in ("http", "https")
    path = PurePosixPath(parts.path)
    return not path.is_absolute() and ".." not in path.parts and "\\" not in parts.path


def _link(renderer, parts, place, options, env):
    parts[place].attrSet("rel", "noopener noreferrer")
    return renderer.renderToken(parts, place, options, env)


_PARSER.validateLink = _allowed  # type: ignore[method-assign]
_PARSER.add_render_rule("link_open", _link)
