"""numpy in the place of cupy, whose arrays and functions have the same names, on a GPU of eight gigabytes."""

from types import SimpleNamespace

import numpy as np

MEMORY = 8 * 10**9
_NAMES = {name: getattr(np, name) for name in dir(np) if not name.startswith("_")}
_CUDA = SimpleNamespace(runtime=SimpleNamespace(memGetInfo=lambda: (MEMORY // 2, MEMORY)))
STAND_IN = SimpleNamespace(**_NAMES | {"asnumpy": np.asarray, "cuda": _CUDA})
