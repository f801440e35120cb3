"""Text of a page, which is Markdown, in other forms: emphasis, code, links, lists and formulas."""

from collections.abc import Callable, Mapping

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
# Before and behind what is marked, by the names of markdown-it; `{href}` is where a link leads to.
Marks = Mapping[str, tuple[str, str]]
PLAIN: Marks = {
    "paragraph": ("", "\n\n"),
    "list_item": ("- ", ""),
    "softbreak": (" ", ""),
    "hardbreak": ("\n", ""),
}


def html(markdown: str) -> str:
    """Markdown as HTML; marks of HTML in it are shown as text."""
    return _PARSER.render(markdown)


def converted(markdown: str, marks: Marks, escaped: Callable[[str], str] = str) -> str:
    """Text with other marks in place of those of Markdown; a mark that is not given is left out.

    A formula is in plain letters, unless it has marks, "math": it then stays as it is.
    """
    return "".join(_parts(_PARSER.parse(markdown), {**PLAIN, **marks}, escaped)).strip()


def _parts(tokens, marks, escaped):
    links = []
    for token in tokens:
        kind = token.type.removesuffix("_open").removesuffix("_close")
        before, behind = marks.get(kind, ("", ""))
        if token.type == "inline":
            yield from _parts(token.children, marks, escaped)
        elif token.type == "text":
            yield escaped(token.content)
        elif token.type in ("code_inline", "fence", "code_block"):
            before, behind = marks.get("code_inline", ("", ""))
            yield before + escaped(token.content) + behind
        elif kind.startswith("math"):
            formula = token.content.strip()
            yield formula.join(marks["math"]) if "math" in marks else escaped(mathematics.plain(formula))
        elif token.nesting > 0:
            before = "" if token.hidden else before
            links.append(str(token.attrs.get("href", "")))
            yield before.replace("{href}", links[-1])
        elif token.nesting < 0:
            behind = "\n" if token.hidden else behind
            yield behind.replace("{href}", links.pop())
        else:
            yield before
