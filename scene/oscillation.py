"""An oscillation in time about a ramp: its values, and the lowest and highest of the two together."""

from dataclasses import dataclass
from math import acos, floor, pi

import numpy as np

ROUNDING = 1e-12  # of the half periods that have passed: what is closer to a whole number of them is at zero


@dataclass(frozen=True)
class Oscillation:
    """amplitude * sin(2 pi frequency t), from t = 0 to a duration.

    amplitude > 0, in the unit of what oscillates; frequency [Hz]; duration [s]
    """

    amplitude: float
    frequency: float
    duration: float

    @property
    def periods(self) -> float:
        """Number of periods in the duration; any number."""
        return self.frequency * self.duration

    @property
    def last(self) -> float:
        """Value at the end."""
        return float(self.at(self.duration))

    def at(self, time):
        """Values at times [s], any shape; exactly zero after whole half periods."""
        halves = 2 * self.frequency * np.asarray(time, float)
        nearest = np.rint(halves)
        beyond = halves - nearest
        beyond = np.where(np.abs(beyond) <= ROUNDING * np.maximum(nearest, 1.0), 0.0, beyond)
        return self.amplitude * np.where(nearest % 2 == 0, 1.0, -1.0) * np.sin(pi * beyond)

    def beyond_chord(self, time):
        """Values at times [s] less the chord from the start to the end; zero before and after the duration."""
        within = np.clip(time, 0.0, self.duration)
        return self.at(within) - self.last * within / self.duration

    def about(self, start: float, end: float) -> tuple[float, float]:
        """Lowest and highest value of the oscillation on a ramp from `start` to `end`.

        Ends of the duration, and where the slopes of both cancel: on a ramp that does not outrun the oscillation,
        the first and the last crest and trough of those.
        """
        omega, rise = 2 * pi * self.frequency, (end - start) / self.duration
        values = [start, end + self.last]
        steepest = self.amplitude * omega
        if abs(rise) < steepest:
            crest = acos(-rise / steepest)
            for first in (crest, 2 * pi - crest):
                last = first + 2 * pi * floor(self.periods - first / (2 * pi))
                values += [
                    start + rise * phase / omega + float(self.at(phase / omega))
                    for phase in (first, last)
                    if last >= first
                ]
        return min(values), max(values)
