"""All inquiries by name, in the order of the page."""

from collections.abc import Mapping

from . import models, surfaces
from .costs import COSTS
from .diagram import Inquiry
from .diagrams import elastic, extent, marching, mdr, precision, sliding

INQUIRIES: Mapping[str, Inquiry] = {
    each.name: each
    for each in (
        models.DIAGRAM,
        surfaces.DIAGRAM,
        mdr.DIAGRAM,
        elastic.DIAGRAM,
        sliding.DIAGRAM,
        marching.DIAGRAM,
        precision.DIAGRAM,
        extent.DIAGRAM,
        COSTS,
    )
}
