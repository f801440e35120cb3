"""The share of its friction in full contact that a rough plane keeps in partial contact."""

from dataclasses import dataclass

import numpy as np

from .bands import FullContact

# Below and above which pressures, over the rms pressure of full contact, powers of it were measured.
LEAST, MOST = 5e-3, 2.0


@dataclass(frozen=True)
class Share:
    """S(x) = 1 - exp{-x e^A (1 + B x) (x + 0.01)^C}, x the pressure over the rms pressure of full contact.

    level, bend, power : A, B, C [1]
    """

    level: float
    bend: float
    power: float

    @classmethod
    def of(cls, full: FullContact) -> "Share":
        """Share of waves that lose and stiffen as these do."""
        t = full.lossy
        g = np.tanh(np.log(full.stiffening * np.sqrt(max(1 - t**2, 1e-12))))
        return cls(
            level=0.282 - 0.293 * t + 0.518 * t**2 - 0.049 * g,
            bend=0.331 - 0.202 * t,
            power=-0.144 + 0.335 * t - 0.139 * t**2 + 0.091 * g,
        )

    def __call__(self, x: np.ndarray) -> np.ndarray:
        """Share at pressures x >= 0, of any shape."""
        inside = np.clip(x, LEAST, MOST)
        return -np.expm1(-x * np.exp(self.level) * (1 + self.bend * inside) * (inside + 0.01) ** self.power)
