"""Three-dimensional solver: boundary elements on a viscoelastic half-space."""

import logging

from scene.signatures import make_readable

from .accuracy import Unconfirmed, for_accuracy
from .heights import Heights, heights, press
from .refinement import refined
from .solver import BEM
from .warmstart import WarmStart

__all__ = ["BEM", "Heights", "Unconfirmed", "WarmStart", "for_accuracy", "heights", "press", "refined"]

make_readable(globals()[name] for name in __all__)
logging.getLogger(__name__).addHandler(logging.NullHandler())
