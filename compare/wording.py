"""Numbers with their errors, and what a collapse shows, in words."""

import numpy as np

from .commoncurve import Misfit
from .mastercurve import Collapse
from .vertical import Vertical


def plus_minus(value: float, error: float, unit: str = "") -> str:
    """value ± error unit, to two digits of the error; the unit may be %."""
    scale, unit = (100, " %") if unit == "%" else (1, f" {unit}" if unit else "")
    if not np.isfinite(value):
        return "undecided"
    if not np.isfinite(error):
        return f"{value * scale:.3g}{unit}, error undecided"
    digits = 4 if error == 0 else int(np.clip(1 - np.floor(np.log10(error * scale)), 0, 6))
    return f"{value * scale:.{digits}f} ± {error * scale:.{digits}f}{unit}"


def explain_vertical(result: Vertical | None) -> str:
    """Whether vertical shifts are needed beside the horizontal ones, in words."""
    if result is None:
        return "Whether vertical shifts are needed too cannot be asked of so few points."
    if result.needed == "undecided":
        return "Whether vertical shifts are needed too is undecided: one shift cannot be told from the other."
    exponent = f"they go as v^({plus_minus(result.exponent, result.exponent_error)})"
    chance = f"chance of that without them {result.chance:.1g}"
    if result.needed == "no":
        return f"Vertical shifts are not needed ({chance}); with them, {exponent}."
    horizontal = plus_minus(result.horizontal_exponent, result.horizontal_exponent_error)
    return (
        f"Vertical shifts are needed too ({chance}): {exponent}, the horizontal ones then as v^({horizontal}), "
        f"and the misfit falls to {result.after.rms:.2%}."
    )


def explain(result: Collapse) -> str:
    """Whether a collapse by horizontal shifts holds, in words."""
    if not result.overlaps:
        return "undecided, since the misfit only falls as the curves are pulled apart."
    if not result.separable:
        return "undecided, since straight parallel lines fit: horizontal and vertical shifts cannot be told apart."
    if result.verdict == "undecided":
        return "undecided, since there is no scatter to compare with."
    return said(result.after)


def said(misfit: Misfit) -> str:
    """Whether curves fall onto one, in words."""
    if misfit.verdict == "undecided":
        return "undecided."
    they = "collapse" if misfit.verdict == "holds" else "do not collapse"
    return f"the curves {they} within their scatter (chi square {misfit.chi_square:.3g} per degree of freedom)."
