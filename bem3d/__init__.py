"""The three-dimensional answer: boundary elements on a viscoelastic half-space."""

from .refinement import refined
from .solver import BEM
from .trail import Trail

__all__ = ["BEM", "Trail", "refined"]
