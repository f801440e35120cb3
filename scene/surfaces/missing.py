"""Missing heights of a map or a line: what was not measured, what stands for it, outliers, and filling in."""

import numpy as np

MOST_FILLED = 0.05  # of all heights
LEAST_DEVIATIONS = 3.0
NEIGHBOURS = 5  # pixels a side of the square whose median an outlier is far from
NORMAL = 1.4826  # standard deviation of a normal distribution over its median absolute deviation
# Numbers that programs write where they have no height, whatever its unit, and any from 1e30 on.
_NONES = (-999.0, -32768.0, 32767.0, 65535.0, -2147483648.0, 2147483647.0, 4294967295.0)
_METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
_ENDLESS = 1e30
# Over the range of all other heights: how far off is a number that stands for none, one that programs write, one
# that is there more than once, and any other.
_PROGRAMS, _REPEATED, _ALONE = 1.0, 100.0, 1000.0
_FARTHER = 10.0  # and over the largest of them


def refuse_missing(heights: np.ndarray) -> None:
    """Raise ValueError, with their number and share, where heights of a map or a line are missing.

    Missing is what is not finite, and what stands for none, see `sentinels`.
    """
    holes = ~np.isfinite(heights)
    if count := np.count_nonzero(holes):
        place = tuple(np.argwhere(holes)[0])
        at = "".join(f"[{each}]" for each in place)
        raise ValueError(
            f"heights{at} = {heights[place]:g}: {_share(count, heights)} missing: {_remedy(count, heights)}"
        )
    if found := sentinels(heights):
        count = np.count_nonzero(np.isin(heights, found))
        raise ValueError(
            f"{_share(count, heights)} are {' or '.join(map(_in_words, found))}, far off all others, as programs "
            f"write missing ones: {_remedy(count, heights)}"
        )


def cleaned_heights(
    heights: np.ndarray, pixel: tuple[float, float], fill: bool, deviations: float | None = None
) -> tuple[np.ndarray, tuple[str, ...]]:
    """Heights of a map or a line with missing ones or outliers filled in, see `filled`; and what was done.

    fill : whether what is missing is filled in; where not, whoever makes a map of it refuses it
    deviations : heights of a map farther off their neighbours are outliers and filled in, see `outliers`; None
        leaves them

    Raises ValueError where more than a twentieth would be filled in.
    """
    if not fill and deviations is None:
        return heights, ()
    notes = []
    if fill:
        for value in sentinels(heights):
            same = heights == value
            notes.append(
                f"{_share(np.count_nonzero(same), heights)} are {_in_words(value)}, far off all others, and count "
                "as missing"
            )
            heights = np.where(same, np.nan, heights)
    else:
        refuse_missing(heights)
    holes = ~np.isfinite(heights)
    if count := _checked(holes, "missing"):
        notes.append(f"{_share(count, heights)} were missing and are filled in")
    if deviations is not None:
        off = outliers(filled(heights, pixel), deviations) & ~holes
        _checked(off | holes, "outliers or missing")
        heights = np.where(off, np.nan, heights)
        notes.append(
            f"{_share(np.count_nonzero(off), heights)} were more than {deviations:g} robust standard deviations "
            "off the median around them and are filled in"
        )
    return filled(heights, pixel), tuple(notes)


def _checked(holes, what):
    """Number of the heights that are filled in. Raises ValueError for too many."""
    count = np.count_nonzero(holes)
    if count > MOST_FILLED * holes.size:
        raise ValueError(
            f"{_share(count, holes)} {what}: at most {100 * MOST_FILLED:g} % are filled in{_crop(holes)}"
        )
    return count


def _share(count, heights):
    return f"{count} of {heights.size} heights ({100 * count / heights.size:.3g} %)"


def _in_words(value):
    written = _written(value)
    return f"{value:g} m{f' ({written})' * bool(written)}"


def _remedy(count, heights):
    if count > MOST_FILLED * heights.size:
        return f'missing = "fill" fills in at most {100 * MOST_FILLED:g} %{_crop(heights)}'
    return f'missing = "fill" fills them in{_crop(heights)}'


def _crop(heights):
    return ", crop = [x from, x to, y from, y to] keeps a part of the map" if heights.ndim > 1 else ""


def sentinels(heights: np.ndarray) -> list[float]:
    """Heights [m] that lie so far off all others that they stand for none: exact numbers, one at each end at most.

    A number that programs write for none, as -9999, 32767 or 1e38 in m, mm, um or nm, has to lie farther from all
    others than those lie from one another; another one a hundred times as far if it is there more than once, a
    thousand times if not, and to be ten times as large as any. Beside heights that are all alike none is far off.
    """
    known = heights[np.isfinite(heights)]
    if not known.size:
        return []
    ends, found = (known.min(), known.max()), set()
    for taken in (ends, ends[:1], ends[1:]):
        rest = known[~np.isin(known, taken)] if len(taken) < 2 else known[(known != ends[0]) & (known != ends[1])]
        if rest.size and rest.min() < rest.max():
            found |= {float(end) for end in taken if _far(end, rest, np.count_nonzero(known == end))}
    return sorted(found)


def _far(value, rest, count):
    # Numbers of Python overflow without a word.
    value, low, high = float(value), float(rest.min()) / 2, float(rest.max()) / 2  # their difference is a number
    off, span = max(value / 2 - high, low - value / 2), high - low
    if _written(value) and off > _PROGRAMS * span:
        return True
    return abs(value) > 2 * _FARTHER * max(-low, high) and off > (_REPEATED if count > 1 else _ALONE) * span


def _written(value):
    """A number as a program writes it for a missing height, with its unit; empty of any other."""
    for unit, metre in _METRES.items():
        number = abs(value) / metre
        nines = 10.0 ** np.round(np.log10(number + 1)) - 1
        exact = [abs(each) for each in _NONES if value and (each > 0) == (value > 0)]
        if number >= _ENDLESS or any(abs(number - each) <= 1e-9 * each for each in (*exact, max(nines, 9999.0))):
            return f"{value / metre:.10g} {unit}"
    return ""


def outliers(heights: np.ndarray, deviations: float) -> np.ndarray:
    """Whether heights of a whole map are farther off the median of the square around them than so many deviations.

    The standard deviation is the robust one of all these distances, 1.4826 times the median of their sizes. Raises
    ValueError where more than half of them are 0, which leaves none.
    """
    # Only who asks for it needs it.
    from scipy.ndimage import median_filter

    # Beyond its sides the map goes on as it came: a slope is no outlier there.
    beyond = NEIGHBOURS // 2
    around = median_filter(np.pad(heights, beyond, mode="reflect", reflect_type="odd"), size=NEIGHBOURS)
    off = np.abs(heights - around[beyond:-beyond, beyond:-beyond])
    deviation = NORMAL * np.median(off)
    if not deviation:
        raise ValueError(
            f"outliers = {deviations:g}: more than half of the heights are the median of the {NEIGHBOURS} x "
            f"{NEIGHBOURS} pixels around them, so that they do not scatter: leave outliers out"
        )
    return off > deviations * deviation


def filled(heights: np.ndarray, pixel: tuple[float, float]) -> np.ndarray:
    """Heights of a map or a line with those that are not finite filled in harmonically; the others as they were.

    Over the holes Laplace's equation holds, in differences of neighbours, which is a straight line along a line of
    heights; where they reach a side, nothing leaves through it. pixel : sides along x and along y, in any unit
    """
    # Only maps with holes need them.
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import splu

    holes = ~np.isfinite(heights)
    if not holes.any():
        return heights
    if heights.ndim == 1:
        return filled(heights[None], pixel)[0]
    rows, columns = np.nonzero(holes)
    numbers = np.full(heights.shape, -1)
    numbers[holes] = np.arange(len(rows))
    # Over a height of their own, so that no sum of them is beyond numbers.
    most = np.abs(heights[~holes]).max() or 1.0
    diagonal, known, pairs = np.zeros(len(rows)), np.zeros(len(rows)), []
    for down, right in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        weight = (min(pixel) / pixel[0 if right else 1]) ** 2
        inside = (rows + down >= 0) & (rows + down < heights.shape[0])
        inside &= (columns + right >= 0) & (columns + right < heights.shape[1])
        here, there = np.flatnonzero(inside), (rows[inside] + down, columns[inside] + right)
        diagonal[here] += weight
        open_ = holes[there]
        known[here[~open_]] += weight * (heights[there][~open_] / most)
        pairs.append((here[open_], numbers[there][open_], np.full(np.count_nonzero(open_), -weight)))
    pairs.append((np.arange(len(rows)), np.arange(len(rows)), diagonal))
    place_, other, value = (np.concatenate(each) for each in zip(*pairs, strict=True))
    matrix = coo_array((value, (place_, other)), shape=(len(rows),) * 2).tocsc()
    found = heights.copy()
    found[holes] = most * splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve(known)
    return found
