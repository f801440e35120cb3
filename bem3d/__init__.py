"""The three-dimensional answer: boundary elements on a viscoelastic half-space."""

from .solver import BEM
from .trail import Trail

__all__ = ["BEM", "Trail"]
