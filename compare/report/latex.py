"""A table as LaTeX for a paper: booktabs, values with their errors, everything escaped."""

import re

from pandas import DataFrame

from scene.printable import printable

from .render import mathematics
from .render.columns import columns

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


def escaped(words: str) -> str:
    """Text that LaTeX prints as it is; letters beyond ASCII that are no symbols are left to its input encoding."""
    return JOINED.sub(lambda found: _symbol(found.group()), printable(words))


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
        label=re.sub(r"[^A-Za-z0-9:/_.-]", "-", label) or None,
    )


def _symbol(given):
    if given == "μ̃":
        return r"$\tilde{\mu}$"
    for mark, known in (("^", SUPERSCRIPTS), ("_", SUBSCRIPTS)):
        if given[0] in known:
            return f"${mark}{{{''.join(known[character] for character in given)}}}$"
    return ESCAPED.get(given, given)
