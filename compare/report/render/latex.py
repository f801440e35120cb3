"""A page, or one table, as LaTeX for a paper: booktabs, values with their errors, everything escaped."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from pandas import DataFrame

from ..page import Findings, Page, Plot, Section, Table, Text
from ..plots.rendering import Picture
from . import mathematics, prose
from .columns import claims, columns

MOST_ROWS = 100
HEAD = r"""\documentclass{article}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage{booktabs,graphicx,textcomp}
\usepackage[margin=2.5cm]{geometry}
\begin{document}"""
SECTIONS = ("section", "subsection", "subsubsection", "paragraph")
SUPERSCRIPTS = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-", strict=True))
SUBSCRIPTS = dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True))
ESCAPED = (
    {character: f"\\{character}" for character in "&%$#_{}"}
    | {character: f"{{{character}}}" for character in "[]*"}  # behind a line's end they would be its arguments
    | {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "\n": " ", '"': "''"}
    | {character: f"${character}$" for character in "<>|"}
    | {character: rf"$\{name}$" for character, name in mathematics.GREEK.items()}
    | {"−": "$-$", "°": r"$^\circ$", "′": r"$'$", "–": "--", "½": r"$\frac{1}{2}$"}
)
# Characters that are one symbol together.
JOINED = re.compile(f"μ̃|[{''.join(SUPERSCRIPTS)}]+|[{''.join(SUBSCRIPTS)}]+|.", re.DOTALL)
MARKS: prose.Marks = {
    "em": (r"\emph{", "}"),
    "strong": (r"\textbf{", "}"),
    "code_inline": (r"\texttt{", "}"),
    "bullet_list": ("\\begin{itemize}\n", "\\end{itemize}\n\n"),
    "ordered_list": ("\\begin{enumerate}\n", "\\end{enumerate}\n\n"),
    "list_item": (r"\item ", ""),
    "math": ("$", "$"),
}


def escaped(words: str) -> str:
    """Text that LaTeX prints as it is; letters beyond ASCII that are no symbols are left to its input encoding."""
    return JOINED.sub(lambda found: _symbol(found.group()), words)


def typeset(words: str) -> str:
    """A sentence, escaped, with its symbols as formulas."""
    return mathematics.typeset(words, escaped, mathematics.dollars)


def table(frame: DataFrame, caption: str = "", label: str = "") -> str:
    """A table with booktabs in a float: text on the left, numbers on the right with their errors."""
    shown = columns(frame)
    texts = [[typeset(" ".join(cell.split())) for cell in column.texts] for column in shown]
    # By number, as two columns may have one title once they are escaped.
    styled = DataFrame(dict(enumerate(texts))).style.hide(axis="index")
    styled = styled.format_index(lambda place: escaped(shown[place].title), axis="columns")
    return styled.to_latex(
        hrules=True,
        position_float="centering",
        column_format="".join("r" if column.numeric else "l" for column in shown),
        caption=typeset(caption) or None,
        label=label or None,
    )


def findings(block: Findings, label: str = "") -> str:
    """Findings as a table."""
    shown = claims([replace(each, regime="") for each in block.findings])
    heads = [head for head in ("Claim", "Model", "Where", "Claimed", "Found (95 %)", "Verdict") if head in shown]
    return table(DataFrame({head: shown[head] for head in heads}), block.caption, label)


def text(page: Page, pictures: Mapping[str, Picture], tables: Mapping[str, str]) -> str:
    """The page as a document that stands alone, with its figures beside it."""
    parts = [HEAD, rf"\section*{{{escaped(page.title)}}}"]
    for sentences in (page.first, page.answer):
        items = "\n".join(rf"\item {typeset(sentence)}" for sentence in sentences)
        parts += [f"\\begin{{itemize}}\n{items}\n\\end{{itemize}}"] if items else []
    parts += [*_blocks(page.blocks, 0, pictures), r"\end{document}"]
    return "\n\n".join(parts) + "\n"


def _blocks(blocks, level, pictures) -> Iterator[str]:
    for block in blocks:
        match block:
            case Text(markdown):
                yield prose.converted(markdown, MARKS, escaped)
            case Table(name, frame, caption) if not block.long and len(frame) <= MOST_ROWS:
                yield table(frame, caption, f"tab:{name}")
            case Findings():
                yield findings(block)
            case Plot():
                yield _figure(block, pictures[block.name])
            case Section(title, inside):
                yield rf"\{SECTIONS[min(level, 3)]}{{{escaped(title)}}}"
                yield from _blocks(inside, level + 1, pictures)


def _figure(plot, picture):
    form = "pdf" if "pdf" in picture.files else "png"
    width = rf"width={min(picture.inches[0], 6.2):.2f}in"
    lines = [r"\begin{figure}", r"\centering", rf"\includegraphics[{width}]{{{plot.name}.{form}}}"]
    return "\n".join(
        [*lines, rf"\caption{{{typeset(plot.caption)}}}", rf"\label{{fig:{plot.name}}}", r"\end{figure}"]
    )


def _symbol(given):
    if given == "μ̃":
        return r"$\tilde{\mu}$"
    for mark, known in (("^", SUPERSCRIPTS), ("_", SUBSCRIPTS)):
        if given[0] in known:
            return f"${mark}{{{''.join(known[character] for character in given)}}}$"
    return ESCAPED.get(given, given)
