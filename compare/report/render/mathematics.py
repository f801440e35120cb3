"""Mathematics on a page: formulas in LaTeX, as MathML that browsers draw themselves, or in plain letters."""

import re
from collections.abc import Callable
from functools import lru_cache
from html import escape

from latex2mathml.converter import convert

GREEK = {
    "Δ": "Delta", "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "varepsilon",
    "η": "eta", "θ": "theta", "λ": "lambda", "µ": "mu", "μ": "mu", "ν": "nu",
    "ξ": "xi", "π": "pi", "ρ": "rho", "σ": "sigma", "τ": "tau", "φ": "varphi",
    "ω": "omega", "±": "pm", "×": "times", "·": "cdot", "√": "surd", "≤": "leq",
    "≥": "geq", "∞": "infty", "°": "circ", "→": "to", "≈": "approx", "∫": "int",
    "∂": "partial", "∇": "nabla", "′": "prime", "⟨": "langle", "⟩": "rangle", "∝": "propto",
}  # fmt: skip
# Plain letters of the commands that a formula may have: one with any other is shown as it is written.
COMMANDS = {name: letter for letter, name in GREEK.items()} | {
    "sqrt": "√", "tilde": "\N{COMBINING TILDE}", "ln": "ln ", "sin": "sin ", "cos": "cos ", "tan": "tan ",
    "ll": "≪", "gg": "≫", "sim": "~", "lvert": "|", "rvert": "|", "frac": "", "mathrm": "", "left": "",
    "right": "", "quad": " ",
}  # fmt: skip
# Symbols of sentences, as claims write them in letters of any keyboard, in LaTeX.
SYMBOLS = {
    "xi^1": r"\xi^1",
    "xi": r"\xi",
    "alpha": r"\alpha",
    "ln mu": r"\ln\mu",
    "mu-tilde": r"\tilde\mu",
    "sqrt(2)": r"\sqrt{2}",
    "p(v)": "p(v)",
    "h0": "h_0",
    "h_0": "h_0",
    "d/h0": "d/h_0",
    "h0/d": "h_0/d",
    "0.1 d": r"0.1\,d",
    "a q_s": "a q_s",
    "2a/L": "2a/L",
    "p/(E* h')": "p/(E^* h')",
    "v tau/a": r"v\tau/a",
    "v τ / a": r"v\tau/a",
    "v tau q_s": r"v\tau q_s",
    "G''(v q_s)/G0": "G''(v q_s)/G_0",
    "G''(v/a)/G0": "G''(v/a)/G_0",
    "E_g/E_r": r"E_\mathrm{g}/E_\mathrm{r}",
}
_LONGEST_FIRST = "|".join(map(re.escape, sorted(SYMBOLS, key=len, reverse=True)))
_SYMBOL = re.compile(rf"(?<![\w/^-])(?:{_LONGEST_FIRST})(?![\w/^-])")
_COMMAND, _MARKS = re.compile(r"\\([A-Za-z]+) ?"), re.compile(r"""[<>&"%#$`@]|\^\^|\\(?![A-Za-z,;: ])""")


def typeset(words: str, escaped: Callable[[str], str], formula: Callable[[str], str]) -> str:
    """A sentence with its symbols as formulas.

    escaped : of what stands between symbols; formula : of a symbol in LaTeX
    """
    parts, reached = [], 0
    for found in _SYMBOL.finditer(words):
        parts += [escaped(words[reached : found.start()]), formula(SYMBOLS[found.group()])]
        reached = found.end()
    return "".join([*parts, escaped(words[reached:])])


def dollars(latex: str) -> str:
    """A formula for Markdown and LaTeX."""
    return f"${latex}$"


@lru_cache(maxsize=1024)
def mathml(latex: str) -> str:
    """A formula for HTML; one that is not understood stands as code, as it is written."""
    # The converter passes marks of HTML on, and has commands that link and style; TeX takes others for its own.
    if not _MARKS.search(latex) and all(name in COMMANDS for name in _COMMAND.findall(latex)):
        try:
            return convert(latex)
        except Exception:  # its errors have no class in common
            pass
    return f"<code>{escape(latex)}</code>"


def understood(latex: str) -> bool:
    """Whether a formula has nothing but what it may have, for whatever sets it later."""
    return latex.isprintable() and mathml(latex).startswith("<math")


def plain(latex: str) -> str:
    """A formula in plain letters, for a terminal."""
    text = re.sub(r"\\mathrm\{(\w*)\}", r"\1", latex)
    text = re.sub(r"\\tilde ?\\?(\w+)", lambda found: COMMANDS.get(found[1], found[1]) + COMMANDS["tilde"], text)
    text = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"\1/\2", text)
    text = re.sub(r"([_^])\{([^{}]{2,})\}", r"\1(\2)", text)
    text = _COMMAND.sub(lambda found: COMMANDS.get(found[1], found[1]), re.sub(r"\\[,;: ]", " ", text))
    return " ".join(re.sub(r"[{}]", "", re.sub(r"([=≪≫≈])", r" \1 ", text)).split())
