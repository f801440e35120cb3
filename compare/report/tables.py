"""Tables as people read them: words with units in the heads, a number together with its interval."""

from collections.abc import Sequence
from itertools import chain

import pandas
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
    columns = [_column(frame, name, beside[name]) for name in frame if name not in hidden]
    return pandas.concat(columns, axis=1) if columns else frame


def _beside(name, frame):
    """Columns that hold the interval of another, or its error."""
    for ends in (JOINED.get(name, ()), (f"{name}_low", f"{name}_high"), (f"{name}_error",)):
        if ends and all(end in frame for end in ends):
            return ends
    return ()


def _column(frame, name, beside):
    values = (frame[each].tolist() for each in (name, *beside))
    texts = [WRITTEN[len(beside)](*each) for each in zip(*values, strict=True)]
    return Series(texts, frame.index, dtype=object, name=head(str(name)))


def claims(findings: Sequence[Finding], details: bool = True) -> DataFrame:
    """Findings as a table of texts: a claim stands in the first of its rows, places where there are several.

    details : whether meaning, regime, and what an interval is made of stand on further lines of the cells
    """
    rows, seen = [], set()
    for each, before in zip(findings, (None, *findings), strict=False):
        claim, place = each.claim, (each.where, each.dimension, each.regime)
        again = before is not None and before.claim == claim
        more = (
            (claim.meaning, "" if place in seen else each.regime, words.basis(each)) if details else ("", "", "")
        )
        rows.append(
            {
                "Verdict": each.verdict,
                "Claim": "" if again else _lines(claim.sentence, more[0]),
                "Model": each.dimension,
                "Where": _lines(each.where, more[1]),
                "Found (95 %)": _lines(words.found(each), more[2], each.why),
                "Tested against": words.tested(claim),
            }
        )
        seen.add(place)
    table, places = DataFrame(rows), {(each.where, each.regime) for each in findings}
    return table if len(places) > 1 else table.drop(columns="Where", errors="ignore")


def _lines(*parts):
    return "\n".join(filter(None, parts))
