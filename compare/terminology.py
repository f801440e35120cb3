"""What the judge's own tasks measure beside the solvers, in the manner of scene.vocabulary."""

from collections.abc import Mapping

from scene.vocabulary import Entry

COSTS: Mapping[str, Entry] = {
    "allowed": Entry("1", "Bound within which a checked number must lie."),
    "change": Entry("1", "Relative change of the quantity from half the points to all."),
    "expected": Entry("1", "Relative error that was expected of the settings chosen."),
    "found": Entry("1", "Number that was checked."),
    "memory": Entry("B", "By which the first solve raised the peak memory of its process."),
    "padded_product": Entry("s", "Least processor time of one product in Fourier space, padded with zeros."),
    "plain_product": Entry("s", "Least processor time of one product in Fourier space."),
    "points": Entry("1", "Points a side that were chosen."),
    "processor": Entry("s", "Least processor time of repeated solves."),
    "promised_seconds": Entry("s", "Processor time that was expected of the settings chosen."),
    "repeats": Entry("1", "How often the solve was repeated."),
    "wall": Entry("s", "Least wall time of repeated solves."),
}

# Of many contacts at once, arrays (scenes, seeds).
ARRAYS: Mapping[str, Entry] = {
    "depth": Entry("m", "Depth of the macroscopic tip, above zero into the elastomer."),
    "friction": Entry("1", "Coefficient of friction, above zero where it opposes motion forwards."),
    "length": Entry("m", "Length of real contact along the profile."),
    "rms_slope": Entry("1", "Rms slope of the rough line over its period, by finite differences."),
    "span": Entry("m", "From the first to the last point of real contact."),
    "sweeps": Entry("1", "Sweeps along the profile."),
}
