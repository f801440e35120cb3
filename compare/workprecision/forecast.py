"""What the laws of cost say of the largest grid, of a machine's memory, and of very many surfaces."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, nan

import numpy as np

from .bill import MEMORY_FROM, Bill
from .costladders import AXES
from .laws import REPEATABLE, Law, NoLaw, held_out
from .wording import HOUR, seconds

LARGEST = 16384  # points a side that the 3D solver takes at most
GIBIBYTE = 2.0**30
MEMORIES = (24, 64, 128)  # of machines [GiB]
SURFACES = 10**5
# Rough ladders that stand for an ensemble, with the points that it takes: some that were measured.
ENSEMBLES = {"plane": (256, 512), "slide-rough": (256, 512), "mdr-rough": (5000, 10**5)}
MATTERS = 2.0  # a cost that varies by less along a ladder hardly depends on it
USELESS = 100.0  # an interval wider than this factor says nothing


@dataclass(frozen=True)
class Forecast:
    """One number that a law gives, with its interval of 95 % for one more measurement, NaN where not known.

    ladder : that the law was fitted to, for people; what : is forecast
    found : the same as measured, NaN where it was not
    reason : why there is none, None where there is one
    """

    ladder: str
    what: str
    unit: str
    value: float = nan
    low: float = nan
    high: float = nan
    found: float = nan
    reason: str | None = None

    @property
    def held(self) -> bool | None:
        """Whether what was found lies in the interval; None where nothing was found, or nothing forecast."""
        if self.reason is not None or not isfinite(self.found):
            return None
        return self.low <= self.found <= self.high


def forecasts(bills: Mapping[str, Bill]) -> Iterator[Forecast]:
    """All of them: held-out points first, as they say how far to trust the others."""
    by_points = {name: bill for name, bill in bills.items() if bill.ladder.setting == "points"}
    checks = {name: _checks(bill) for name, bill in by_points.items()}
    for name in by_points:
        yield from checks[name].values()
    for name, bill in by_points.items():
        if bill.dimension == "3D":
            yield from _largest(bill, checks[name])
    for name, points in ENSEMBLES.items():
        if name in by_points:
            yield from _ensembles(by_points[name], points)


def name_of(bill: Bill) -> str:
    """Dimensionality and label, for people."""
    return (
        f"{bill.dimension} {bill.ladder.label}" if bill.dimension not in bill.ladder.label else bill.ladder.label
    )


def _checks(bill) -> dict[str, Forecast]:
    """The largest grid from those below it: its time, and its memory."""
    enough, found = bill.nodes >= MEMORY_FROM, {}
    for what, unit, part, cost in (
        ("time", "s", slice(None), bill.processor),
        ("memory", "GiB", enough, bill.memory / GIBIBYTE),
    ):
        x, law, seen = held_out(bill.x[part], cost[part])
        found[what] = _of(law, x, name_of(bill), f"{what} with {x:g} points, from fewer", unit, found=seen)
    return found


def _largest(bill, checks):
    """None from a law that has missed already by more than scatter."""
    time, memory = (
        _unless_missed(bill.laws[cost], checks[what])
        for cost, what in (("processor", "time"), ("memory", "memory"))
    )
    yield _of(time, LARGEST, name_of(bill), largest("time"), "s")
    yield _of(memory, LARGEST, name_of(bill), largest("memory"), "GiB", 1 / GIBIBYTE)
    for size in MEMORIES:
        what = f"points a side that {size} GiB hold"
        if isinstance(memory, NoLaw):
            yield Forecast(name_of(bill), what, "1", reason=memory.reason)
        else:
            yield Forecast(name_of(bill), what, "1", *memory.reach(size * GIBIBYTE))


def _unless_missed(law, check):
    if check.held is not False or (factor := _factor(check)) <= 1 + REPEATABLE:
        return law
    return NoLaw(f"without its largest grid the law misses it by a factor of {factor:.2g}", nan, nan, nan)


def largest(what: str) -> str:
    """Name of the forecast of the time or the memory of the largest grid."""
    return f"{what} with {LARGEST}² points"


def _factor(each):
    return max(each.found / each.value, each.value / each.found)


def _ensembles(bill, points):
    """As many times what one surface was measured to take: how that scatters between surfaces is not known."""
    for n in points:
        grid = f"{n} points" if bill.dimension == "1D" else f"{n}² points"
        what = f"{SURFACES} surfaces with {grid}"
        measured = bill.processor[bill.x == n]
        if not np.isfinite(measured).any():
            yield Forecast(name_of(bill), what, "core hours", reason="not measured")
            continue
        yield Forecast(name_of(bill), what, "core hours", float(measured[0]) * SURFACES / HOUR)
    rows = bill.stored[[reason is None for reason in bill.reasons]]
    if len(rows):
        low, middle, high = (float(SURFACES * f(rows) / GIBIBYTE) for f in (np.min, np.median, np.max))
        yield Forecast(name_of(bill), f"rows of {SURFACES} surfaces on disk", "GiB", middle, low, high)


def _of(law: Law | NoLaw, x, ladder, what, unit, times=1.0, found=nan):
    if isinstance(law, NoLaw):
        return Forecast(ladder, what, unit, found=found, reason=law.reason)
    low, high = law.interval(x)
    return Forecast(ladder, what, unit, times * law.at(x), times * low, times * high, found)


def advice(bills: Mapping[str, Bill], found: Sequence[Forecast]) -> str:
    """What to do about all this, in one paragraph."""
    sentences = [
        _growth(bills),
        _products(bills),
        _checked(found),
        *(_largest_grid(bills[name], found) for name in ("plane", "rest", "slide") if name in bills),
        _surfaces(found),
        *(_dependence(bill) for bill in bills.values() if bill.ladder.setting != "points"),
        _failed(bills),
    ]
    return " ".join(filter(None, sentences))


def _growth(bills):
    parts = []
    for bill in bills.values():
        if bill.ladder.setting != "points":
            continue
        name, law = name_of(bill), bill.laws["processor"]
        if isinstance(law, NoLaw):
            parts.append(f"{name}, by no power ({law.reason})")
        else:
            parts.append(f"{name}, as n^{_exponent(law)} from n = {law.lowest:g} on{_split(bill)}")
    return f"Processor time grows with the points n along a line: {'; '.join(parts)}." if parts else ""


def _split(bill):
    """The share of operator applications in it."""
    law = bill.laws["applications"]
    if bill.dimension == "1D" or isinstance(law, NoLaw):
        return ""
    return f", its operator applications as n^{_exponent(law)} from n = {law.lowest:g} on"


def _products(bills):
    """What the transforms leave to gain, on grids that are large enough for them to count."""
    ratios = np.concatenate([[nan], *(bill.over_limit[bill.nodes >= MEMORY_FROM] for bill in bills.values())])
    ratios = ratios[np.isfinite(ratios)]
    if not len(ratios):
        return ""
    rest = "quicker transforms alone pay" if ratios.max() < MATTERS else "set-up and coarser grids are the rest"
    return (
        f"From 256² points on, a 3D solve takes {ratios.min():.1f} to {ratios.max():.1f} times as long as its "
        f"products by transforms alone: {rest}."
    )


def _checked(found):
    judged = [each for each in found if each.held is not None]
    if not judged:
        return "No law could be checked on a point left out of it."
    held = sum(each.held for each in judged)
    factor = max(map(_factor, judged))
    return (
        f"Of {len(judged)} costs of the largest grids, left out and forecast from the others, {held} lay within "
        f"the interval, and the forecast was off by a factor of {factor:.2f} at most."
    )


def _largest_grid(bill, found):
    mine = {each.what: each for each in found if each.ladder == name_of(bill)}
    time, memory = mine[largest("time")], mine[largest("memory")]
    text = f"{LARGEST}² points, {bill.ladder.label}: {_amount(time)}; {_amount(memory)}"
    if memory.reason is not None or memory.high > USELESS * memory.low:
        return f"{text}."
    fits = [size for size in MEMORIES if memory.high <= size]
    if fits:
        return f"{text}, which {fits[0]} GiB hold."
    most = mine[f"points a side that {MEMORIES[-1]} GiB hold"]
    return f"{text}; {MEMORIES[-1]} GiB surely hold {most.low:.0f} points a side."


def _amount(each: Forecast) -> str:
    kind = each.what.split()[0]
    if each.reason is not None:
        return f"no forecast of {kind} ({each.reason})"
    if each.high > USELESS * each.low:
        return f"no useful forecast of {kind} (its interval spans a factor above {USELESS:g})"
    return _with_interval(each)


def _with_interval(each):
    """The value, and its ends where they say anything."""
    told = each.high <= USELESS * each.low
    if each.unit == "s":
        return seconds(each.value) + (f" ({seconds(each.low)} to {seconds(each.high)})" if told else "")
    interval = f" ({_short(each.low)} to {_short(each.high)})" if told else ""
    return f"{_short(each.value)} {each.unit}{interval}"


def _short(value):
    """Two digits, without powers of ten where there need be none."""
    rounded = float(f"{value:.2g}")
    return f"{rounded:.0f}" if 10 <= rounded < 1e6 else f"{rounded:g}"


def _exponent(law):
    low, high = law.exponent_interval
    return f"{law.exponent:.2f} ({low:.2f} to {high:.2f})"


def _surfaces(found):
    parts = [
        f"{_with_interval(each)} with {each.what.split(' with ')[1]} ({each.ladder})"
        for each in found
        if each.unit == "core hours" and each.reason is None
    ]
    if not parts:
        return ""
    disk = max((each.value for each in found if "on disk" in each.what), default=nan)
    return (
        f"{SURFACES} surfaces take {', '.join(parts)}, each from the time of one surface, and {disk:.2g} GiB on "
        "disk at most for their rows."
    )


def _dependence(bill):
    """Along anything else than points: a power where it matters, else the range."""
    law, name = bill.laws["processor"], f"{name_of(bill)}, against {AXES[bill.ladder.setting].label}"
    good = np.isfinite(bill.processor) & np.isfinite(bill.x)
    if not good.any():
        return f"{name}: every solve failed."
    time, x = bill.processor[good], bill.x[good]
    shown = (lambda value: f"{100 * value:.3g} %") if bill.ladder.setting == "contact" else _short
    ends = f"{shown(x.min())} to {shown(x.max())}"
    if time.max() < MATTERS * time.min():
        return f"{name}, {ends}: times differ by a factor of {time.max() / time.min():.1f} only."
    if isinstance(law, Law) and bill.ladder.setting in ("modes", "steps"):
        fixed = f" beside {seconds(law.overhead)} that are always paid" if law.overhead else ""
        return f"{name}, {ends}: power {_exponent(law)}{fixed}."
    times = f"{seconds(time.min())} to {seconds(time.max())}"
    return f"{name}, {ends}: {times}, the dearest at {shown(x[np.argmax(time)])}."


def _failed(bills):
    """Where, and the first reason of each ladder; the table has them all."""
    parts = []
    for bill in bills.values():
        failed = [k for k, reason in enumerate(bill.reasons) if reason is not None]
        if failed:
            where = ", ".join(f"{bill.ladder.values[k]:g}" for k in failed)
            parts.append(f"{name_of(bill)}, {bill.ladder.setting} {where} ({bill.reasons[failed[0]]})")
    return f"Failed, and left out: {'; '.join(parts)}." if parts else ""
