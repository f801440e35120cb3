"""Vocabulary of the judge: unit and definition of every variable of a Dataset and every column of a table."""

from collections.abc import Mapping

from scene import Scene
from scene.vocabulary import FIELDS, MEASURES, NUMBERS, Entry

# Of Datasets: coordinates, and what scene.vocabulary has under another name.
LABELS: Mapping[str, Entry] = {
    "grid": Entry("", "Which grid of the solver: fine, as the settings say, or coarse, with half the points a side."),
    "points": Entry("1", "Points of the grid along a side."),
    "speed": Entry("m/s", "Speed of sliding that was prescribed, or rate of pressing in; 0 is rest."),
    "load": Entry("N", "Normal force that was prescribed.", along_line="N/m"),
    "depth": Entry("m", "Depth that was prescribed, above zero into the elastomer."),
    "draw": Entry("1", "Seed of the rough surface."),
    "depth_reached": NUMBERS["depth"],
    "status": Entry("", "Whether a contact was solved, has no contact, failed, or was not asked for."),
    "reason": Entry("", "Why a solve failed; empty where it did not."),
    # Of hard cases and of stored quantities.
    "check": Entry("", "What is measured of a hard case and must not exceed its bound."),
    "found": Entry("1", "Number of a check; of a refusal, how many of the words it must say are missing."),
    "allowed": Entry("1", "Bound of a check, from the law of the case."),
    "message": Entry("", "Error that came of what must be refused; in brackets what came instead of one."),
    "quantity": Entry("", "Name of a ratio of two answers to one question."),
    "side": Entry("", "Which of the two answers: numerator or denominator of the ratio."),
    "measured": Entry("", "Number of one answer that a ratio is made of, in its SI unit."),
    "stored": Entry("1", "Ratio as the baseline has it."),
}


def entry(name: str) -> Entry | None:
    """Entry of a name, of the judge first and then of the solvers; None of a name that explains itself."""
    return LABELS.get(name) or NUMBERS.get(name) or MEASURES.get(name) or FIELDS.get(name)


def attributes(name: str, scene: Scene | None = None) -> dict[str, str]:
    """Attributes of a variable of a Dataset: units, long name and definition."""
    found, plain = entry(name), name.replace("_", " ")
    if found is None:
        return {"long_name": plain}
    indenter = "" if scene is None else scene.indenter.type
    return {"units": found.unit_under(indenter), "long_name": plain, "comment": found.text}
