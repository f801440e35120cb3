"""Tables as people read them: words with units in the heads, a number together with its interval."""

from collections.abc import Sequence

from pandas import DataFrame, Series

from ..solving import words
from ..solving.vocabulary import head
from ..statistics.finding import Finding

ENDS = "low", "high"


def shown(frame: DataFrame) -> DataFrame:
    """A table of texts: NAME_low and NAME_high stand in the cells of NAME."""
    texts = {}
    for name in frame:
        base, _, end = name.rpartition("_")
        if base not in frame or end not in ENDS:
            ends = [each for each in (f"{name}_{end}" for end in ENDS) if each in frame]
            write = words.interval if ends else words.shown
            texts[head(name)] = [*map(write, *(frame[each].tolist() for each in (name, *ends)))]
    return DataFrame(texts, frame.index, dtype=object)


def claims(findings: Sequence[Finding], details: bool = True) -> DataFrame:
    """Findings as a table of texts: a claim stands in the first of its rows, places where there are several.

    details : whether meaning, regime, and what an interval is made of stand on further lines of the cells
    """
    places = Series([(each.where, each.regime, each.dimension) for each in findings])
    rows = [
        {
            "Verdict": each.verdict,
            "Claim": _lines(each.claim.sentence, details and each.claim.meaning),
            "Model": each.dimension,
            "Where": _lines(each.where, details and not repeated and each.regime),
            "Found (95 %)": _lines(words.found(each), details and words.basis(each), each.why),
            "Tested against": words.tested(each.claim),
        }
        for each, repeated in zip(findings, places.duplicated(), strict=True)
    ]
    table = DataFrame(rows)
    table["Claim"] = table["Claim"].where(table["Claim"] != table["Claim"].shift(), "")
    return table if len({place[:2] for place in places}) > 1 else table.drop(columns="Where")


def _lines(*parts):
    return "\n".join(filter(None, parts))
