"""The chapters of the page on effects, in their order; what they cost is another, which wants a quiet machine.

Each is a module with its NAME, `tasks()`, everything that is solved, and `chapter(outcomes)`, what came out.
"""

from . import layer, motions, shear, temperature, topography

STUDIES = (layer, topography, temperature, shear, motions)
