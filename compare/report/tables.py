"""Tables as people read them: words with units in the heads, a number together with its interval."""

from collections.abc import Sequence
from itertools import chain

from pandas import DataFrame, Series

from ..solving import words
from ..solving.vocabulary import head
from ..statistics.finding import Finding

# Columns of findings that stand together in one.
JOINED = {"value": ("low", "high"), "expected": ("tolerance",)}
WRITTEN = (words.shown, words.plus_minus, words.interval)  # by the number of columns beside a number


def shown(frame: DataFrame) -> DataFrame:
    """A table of texts: NAME_low and NAME_high, or NAME_error, stand in the cells of NAME."""
    beside = {name: _beside(name, frame) for name in frame}
    hidden = set(chain.from_iterable(beside.values()))
    texts = {
        head(str(name)): list(map(WRITTEN[len(ends)], *(frame[each].tolist() for each in (name, *ends))))
        for name, ends in beside.items()
        if name not in hidden
    }
    return DataFrame(texts, frame.index, dtype=object)


def _beside(name, frame):
    """Columns that hold the interval of another, or its error."""
    for ends in (JOINED.get(name, ()), (f"{name}_low", f"{name}_high"), (f"{name}_error",)):
        if ends and {*ends} <= {*frame}:
            return ends
    return ()


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
            "Where": _lines(each.where, details and not told and each.regime),
            "Found (95 %)": _lines(words.found(each), details and words.basis(each), each.why),
            "Tested against": words.tested(each.claim),
        }
        for each, told in zip(findings, places.duplicated(), strict=True)
    ]
    table = DataFrame(rows)
    table["Claim"] = table["Claim"].where(table["Claim"] != table["Claim"].shift(), "")
    return table if len({place[:2] for place in places}) > 1 else table.drop(columns="Where")


def _lines(*parts):
    return "\n".join(filter(None, parts))
