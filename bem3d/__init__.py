"""The three-dimensional answer: boundary elements on a viscoelastic half-space."""

from .solver import BEM

__all__ = ["BEM"]
