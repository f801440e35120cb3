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
    found: dict[str, np.ndarray] = {}
    for node in answers.subtree:
        if MEASURE not in node.data_vars:
            continue
        every = node.dataset[MEASURE]
        for model in every["model"].values.tolist() if "model" in every.dims else [str(node.name)]:
            bounds = every.sel(model=model) if "model" in every.dims else every
            bounds = bounds.sel(level="fine") if "level" in bounds.dims else bounds
            # Of a mean over surfaces the bound is the mean of theirs.
            values = (bounds.mean("surface") if "surface" in bounds.dims else bounds).values
            name = MODELS.get(model, model)
            found[name] = np.append(found.get(name, []), values[np.isfinite(values)])
    return {model: each for model, each in sorted(found.items()) if each.size}


def sentence(bounds: Mapping[str, np.ndarray]) -> str:
    """What the grids leave uncertain of friction, the model that errs most first; empty without friction."""
    falling = sorted(bounds.items(), key=lambda item: -item[1].max())
    told = ", ".join(
        f"{_percent(each.max())} in {model}"
        + (f" ({_percent(np.median(each))} in the median)" if len(each) > 1 else "")
        for model, each in falling
        if each.max() > MUCH or not much(bounds)
    )
    if much(bounds):
        return f"Friction may be wrong by up to {told} by the grid: take more points (bounds of 95 %)."
    return f"The grid leaves at most {told} of friction uncertain (bounds of 95 %)." if told else ""


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
