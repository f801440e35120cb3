"""Symbols of sentences, which claims write in letters of any keyboard, as a page shows them."""

import re

SYMBOLS = {
    "xi^1": "ξ¹",
    "xi": "ξ",
    "alpha": "α",
    "ln mu": "ln μ",
    "mu-tilde": "μ̃",
    "sqrt(2)": "√2",
    "h0": "h₀",
    "h_0": "h₀",
    "d/h0": "d/h₀",
    "h0/d": "h₀/d",
    "v tau/a": "vτ/a",
    "v tau q_s": "vτ q_s",
    "G''(v q_s)/G0": "G''(v q_s)/G₀",
    "G''(v/a)/G0": "G''(v/a)/G₀",
}
_LONGEST_FIRST = "|".join(map(re.escape, sorted(SYMBOLS, key=len, reverse=True)))
_SYMBOL = re.compile(rf"(?<![\w/^-])(?:{_LONGEST_FIRST})(?![\w/^-])")


def symbolic(words: str) -> str:
    """A sentence with its symbols in Unicode."""
    return _SYMBOL.sub(lambda found: SYMBOLS[found.group()], words)
