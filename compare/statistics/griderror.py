"""Error of friction that grids leave, as the solved contacts state it: a sentence, first where it is much."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from pandas import Series, concat

from scene import Doubtful

if TYPE_CHECKING:
    import xarray

MEASURE = "friction_error"
LEAST = 1e-4  # an error below is stated as less than this
MUCH = 0.1  # an error from here on is stated first
# Nodes of answers by what people call their model.
MODELS = {"MDR": "1D", "row": "1D", "BEM": "3D", "surface": "3D"}


class UncertainFriction(Doubtful):
    """Friction may be wrong by more than a tenth, as its grid is coarse."""


def stated(answers: "xarray.DataTree") -> Series:
    """Bounds of 95 % on the relative error of friction of every contact on its fine grid, by model.

    All surfaces of a contact have a common bound, for their mean.
    """
    found = [Series(dtype=float)]
    for node in answers.subtree:
        if MEASURE in node.data_vars:
            bounds = node.dataset[MEASURE]
            bounds = bounds if "model" in bounds.dims else bounds.expand_dims(model=[str(node.name)])
            bounds = bounds.sel(level="fine") if "level" in bounds.dims else bounds
            # Of a mean over surfaces the bound is the mean of theirs.
            own = (bounds.mean("surface") if "surface" in bounds.dims else bounds).to_series()
            own.index = [MODELS.get(each, each) for each in own.index.get_level_values("model")]
            found.append(own)
    return concat([each for each in found if each.size] or found).dropna()


def sentence(bounds: Series) -> str:
    """What the grids leave uncertain of friction, the model that errs most first; empty without friction."""
    most = bounds.groupby(level=0).max().sort_values(ascending=False)
    errors = ", ".join(
        f"{_percent(each)} in {model}" for model, each in most.items() if each > MUCH or not much(most)
    )
    if much(most):
        return f"Friction may be wrong by up to {errors} by the grid: take more points (bounds of 95 %)."
    return f"The grid leaves at most {errors} of friction uncertain (bounds of 95 %)." if errors else ""


def much(bounds: Series) -> bool:
    """Whether any contact may be wrong by more than a tenth."""
    return bool((bounds > MUCH).any())


def with_grid_error(answers: "xarray.DataTree", sentences: Sequence[str]) -> list[str]:
    """Sentences of an answer, and what the grids leave uncertain of friction: first where it is much."""
    bounds = stated(answers)
    own = [sentence(bounds)] if bounds.size else []
    return [*own, *sentences] if much(bounds) else [*sentences, *own]


def warnings_of(answers: "xarray.DataTree") -> list[Warning]:
    """UncertainFriction where it is much; empty elsewhere."""
    bounds = stated(answers)
    return [UncertainFriction(sentence(bounds))] if much(bounds) else []


def _percent(share):
    return f"{100 * share:.2g} %" if share > LEAST else f"less than {100 * LEAST:g} %"
