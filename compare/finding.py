"""What a claim comes to: a number with both of its errors, and the verdict that follows from them."""

from dataclasses import asdict, dataclass
from math import isfinite, nan


def verdict(expected: float, tolerance: float, low: float, high: float) -> str:
    """holds if the interval lies within the tolerance around what is expected, fails if none of it does, else
    undecided; undecided too where an end is unknown."""
    least, most = expected - tolerance, expected + tolerance
    if not (isfinite(low) and isfinite(high)):
        return "undecided"
    if least <= low and high <= most:
        return "holds"
    return "fails" if high < least or low > most else "undecided"


@dataclass(frozen=True)
class Finding:
    """One claim, and what was measured of it in one dimensionality.

    claim : what is claimed, the same words wherever it is asked
    dimension : "1D", "3D", or "1D/3D" of a claim on both
    expected, tolerance : the number claimed, and how far from it still counts as it, absolute
    value : measured
    statistical : interval of 95 % from the scatter of surfaces alone; both ends the value of a smooth body
    grid : error of discretisation, absolute: the change from half the points a side to all, on the same surfaces,
        which is no less than the error that is left if that falls at least as fast as the pixel; NaN if unknown
    surfaces : how many were drawn; 0 of a smooth body, which has no scatter
    regime : where it was measured, in words
    figure : name of the figure that shows it
    text : how it was measured, and what a deviation means
    undecidable : why there is no verdict whatever the number; empty if there may be one
    """

    claim: str
    dimension: str
    expected: float
    tolerance: float
    value: float
    statistical: tuple[float, float]
    grid: float
    surfaces: int
    regime: str
    figure: str
    text: str
    undecidable: str = ""

    @property
    def interval(self) -> tuple[float, float]:
        """Of 95 %, wider at both ends by the error of discretisation; NaN without either error."""
        low, high = self.statistical
        return low - self.grid, high + self.grid

    @property
    def verdict(self) -> str:
        """holds, fails or undecided, from the interval that holds both errors."""
        return "undecided" if self.undecidable else verdict(self.expected, self.tolerance, *self.interval)

    @property
    def effect(self) -> float:
        """How far from what is expected, in tolerances."""
        return (self.value - self.expected) / self.tolerance if self.tolerance else nan

    @property
    def row(self) -> dict:
        """Flat, for a table."""
        flat = asdict(self)
        (flat["statistical_low"], flat["statistical_high"]) = flat.pop("statistical")
        flat["low"], flat["high"] = self.interval
        return flat | {"effect": self.effect, "verdict": self.verdict}
