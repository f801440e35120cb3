"""Error of friction that grids leave, as the solved contacts state it: a sentence, first where it is much."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from scene import Doubtful

if TYPE_CHECKING:
    import xarray

MEASURE = "friction_error"
LEAST = 1e-4  # below which an error is only said to be less
MUCH = 0.1  # from which on it is said first
# Nodes of answers by what people call their model.
MODELS = {"MDR": "1D", "row": "1D", "BEM": "3D", "surface": "3D"}


class UncertainFriction(Doubtful):
    """Friction may be wrong by more than a tenth, as its grid is coarse."""


def stated(answers: "xarray.DataTree") -> dict[str, np.ndarray]:
    """Bounds of 95 % on the relative error of friction of every contact on its fine grid (n,), by model.

    Surfaces of one contact are one: of their mean.
    """
    found: dict[str, list[np.ndarray]] = {}
    for node in answers.subtree:
        every = node[MEASURE] if MEASURE in node.data_vars else None
        for model in (
            () if every is None else every["model"].values.tolist() if "model" in every.dims else [node.name]
        ):
            bounds = every.sel(model=model) if "model" in every.dims else every
            bounds = bounds.sel(level="fine") if "level" in bounds.dims else bounds
            # Of a mean over surfaces the bound is the mean of theirs.
            bounds = bounds.mean("surface") if "surface" in bounds.dims else bounds
            found.setdefault(MODELS.get(str(model), str(model)), []).append(bounds.values.ravel())
    joined = {model: np.concatenate(parts) for model, parts in sorted(found.items())}
    return {model: each[np.isfinite(each)] for model, each in joined.items() if np.isfinite(each).any()}


def sentence(bounds: Mapping[str, np.ndarray]) -> str:
    """What the grids leave uncertain of friction, the model that errs most first; empty without friction."""
    if not bounds:
        return ""
    falling = sorted(bounds.items(), key=lambda item: -item[1].max())
    if much(bounds):
        told = [_above(model, each) for model, each in falling if each.max() > MUCH]
        return f"{'; '.join(told)}: take more points (bounds of 95 %)."
    told = [f"{_percent(each.max())} in {model}{_median(each)}" for model, each in falling]
    return f"The grid leaves at most {', '.join(told)} of friction uncertain (bounds of 95 %)."


def much(bounds: Mapping[str, np.ndarray]) -> bool:
    """Whether any contact may be wrong by more than a tenth."""
    return any(each.max() > MUCH for each in bounds.values())


def told(answers: "xarray.DataTree", sentences: Sequence[str]) -> list[str]:
    """Sentences of an answer, and what the grids leave uncertain of friction: first where it is much."""
    bounds = stated(answers)
    own = [sentence(bounds)] if bounds else []
    return [*own, *sentences] if much(bounds) else [*sentences, *own]


def warnings_of(answers: "xarray.DataTree") -> list[Warning]:
    """UncertainFriction where it is much; empty elsewhere."""
    bounds = stated(answers)
    return [UncertainFriction(sentence(bounds))] if much(bounds) else []


def _percent(share):
    return f"{100 * share:.2g} %" if share > LEAST else f"less than {100 * LEAST:g} %"


def _median(bounds):
    return f" ({_percent(np.median(bounds))} in the median)" if len(bounds) > 1 else ""


def _above(model, bounds):
    """Contacts of a model that may be wrong by more than a tenth, in words."""
    if len(bounds) == 1:
        return f"Friction in {model} may be wrong by up to {_percent(bounds[0])} by the grid"
    return (
        f"Friction of {int((bounds > MUCH).sum())} of {len(bounds)} contacts in {model} may be wrong by more than "
        f"{_percent(MUCH)} by the grid, by up to {_percent(bounds.max())}{_median(bounds)}"
    )
