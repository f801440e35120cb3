"""Missing heights of a map: what was not measured, what stands for it, outliers, and filling in."""

import numpy as np

MOST_FILLED = 0.05  # of all pixels
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
    """Raise ValueError, with their number and share, where pixels have no height, or one that stands for none."""
    size, holes = heights.size, ~np.isfinite(heights)
    if count := np.count_nonzero(holes):
        row, column = np.argwhere(holes)[0]
        raise ValueError(
            f"heights[{row}][{column}] = {heights[row, column]:g}: every pixel needs a finite height, and "
            f"{_pixels(count, 'have', 'has')} no height, {_share(count, size)}: {_remedy(count, size)}"
        )
    if found := sentinels(heights):
        counts = [np.count_nonzero(heights == value) for value in found]
        raise ValueError(
            f"{' and '.join(map(_held, found, counts))}, {_share(sum(counts), size)}, far off all others: such "
            f"numbers stand for missing heights: {_remedy(sum(counts), size)}"
        )


def mended(
    heights: np.ndarray, pixel: tuple[float, float], fill: bool, deviations: float | None = None
) -> tuple[np.ndarray, tuple[str, ...]]:
    """Heights with those filled in that are missing, stand for none, or are outliers; and what was done, in lines.

    fill : whether what is missing is filled in; where not, whoever makes a map of it refuses it
    deviations : heights farther off their neighbours are outliers and filled in, see `outliers`; None leaves them

    Raises ValueError where more than a twentieth would be filled in.
    """
    notes = []
    if fill:
        for value in sentinels(heights):
            same = heights == value
            notes.append(f"{_held(value, np.count_nonzero(same))}, far off all others, and count as missing")
            heights = np.where(same, np.nan, heights)
    elif deviations is not None:
        refuse_missing(heights)
    holes = ~np.isfinite(heights)
    if not fill and deviations is None:
        return heights, ()
    count = _checked(holes, "have no height", "has no height")
    if count:
        notes.append(
            f"{_pixels(count, 'had', 'had')} no height, {_share(count, holes.size)}, and {_were(count)} filled in"
        )
    if deviations is not None:
        off = outliers(filled(heights, pixel), deviations) & ~holes
        beyond = np.count_nonzero(off)
        _checked(off | holes, "are outliers or have no height", "is an outlier or has no height")
        heights = np.where(off, np.nan, heights)
        off_by = f"more than {deviations:g} robust standard deviations off the median around"
        notes.append(f"{_pixels(beyond, 'were', 'was')} {off_by}, {_share(beyond, holes.size)}, and filled in")
    return filled(heights, pixel), tuple(notes)


def _checked(holes, are, is_):
    """Number of the pixels that are filled in. Raises ValueError for too many."""
    count = np.count_nonzero(holes)
    if count > MOST_FILLED * holes.size:
        raise ValueError(
            f"{_pixels(count, are, is_)}, {_share(count, holes.size)}, and at most {100 * MOST_FILLED:g} % are "
            "filled in: crop the map"
        )
    return count


def _pixels(count, are, is_):
    return f"{count} pixel{'' if count == 1 else 's'} {is_ if count == 1 else are}"


def _were(count):
    return "was" if count == 1 else "were"


def _share(count, size):
    return f"{100 * count / size:.3g} % of {size}"


def _held(value, count):
    written = _written(value)
    return f"{_pixels(count, 'hold', 'holds')} {value:g} m{f' ({written})' * bool(written)}"


def _remedy(count, size):
    part = "crop = [x from, x to, y from, y to] keeps a part of the map"
    if count > MOST_FILLED * size:
        return f'{part}; missing = "fill" fills in at most {100 * MOST_FILLED:g} %'
    return f'missing = "fill" fills them in, {part}'


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
    """Heights with those that are not finite filled in harmonically; the others are as they were.

    Over the holes Laplace's equation holds, in differences of neighbours, and where they reach a side of the map
    nothing leaves through it. pixel : sides along x and along y, in any unit
    """
    # Only maps with holes need them.
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import splu

    holes = ~np.isfinite(heights)
    rows, columns = np.nonzero(holes)
    if not len(rows):
        return heights
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
