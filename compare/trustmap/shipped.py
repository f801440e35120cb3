"""The models that come with the package: measured tables, and what was fitted to them."""

import json
from functools import cache
from pathlib import Path

import numpy as np

from .model import Fitted, Model
from .regression import Scales
from .table import LEARNED, measurements, read

FITTED = Path(__file__).with_name("fitted.json")


@cache
def model(quantity: str) -> Model:
    """Model of friction, depth or force; the same object each time."""
    told = json.loads(FITTED.read_text(encoding="utf-8"))[quantity]
    process, scatter = (_scales(**told[each]) for each in ("process", "scatter"))
    errors, widening, parts = (np.array(told[each]) for each in ("errors", "widening", "parts"))
    fitted = Fitted(process, np.array(told["taken"]), scatter, errors, widening, parts)
    return Model.of(quantity, measurements(read(LEARNED), quantity)[1], fitted)


def _scales(middle, spread, lengths, **numbers) -> Scales:
    return Scales(np.array(middle), np.array(spread), np.array(lengths), **numbers)
