"""Units with the prefix in which values read well."""

import numpy as np
from matplotlib.ticker import EngFormatter


def prefixed(values, unit: str) -> tuple[float, str]:
    """Factor on values in a unit of SI, and the unit that they then have, so that the greatest is 1 to 1000.

    Beyond the prefixes, and of nothing but zero or NaN, the unit stays.
    """
    finite = np.abs(np.asarray(values, float))
    greatest = np.max(finite[np.isfinite(finite)], initial=0.0)
    power = 3 * int(np.floor(np.log10(greatest) / 3 + 1e-12)) if greatest > 0 else 0
    prefixes = EngFormatter.ENG_PREFIXES
    return (10.0**-power, prefixes[power] + unit) if power in prefixes else (1.0, unit)
