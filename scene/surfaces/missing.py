"""Missing heights of a map or a line: what was not measured, what stands for it, and filling in."""

import re

import numpy as np

MOST_FILLED = 0.05  # of all heights
# Numbers that programs write where they have no height, whatever its unit, and any from 1e30 on.
_NONES = re.compile(r"-999|-32768|32767|65535|-2147483648|2147483647|4294967295|-?9{4,}|-?[\d.]+e\+([3-9]|\d\d)\d")
_METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
# How far off all others a number stands for none: over their range, and over the largest of them.
_FAR, _FARTHER = 1000.0, 10.0


def refuse_missing(heights: np.ndarray) -> None:
    """Raise ValueError, with their number and share, where heights of a map or a line are missing.

    Missing is what is not finite, and what stands for none, see `sentinels`.
    """
    holes = ~np.isfinite(heights)
    few = np.count_nonzero(holes) <= MOST_FILLED * heights.size
    remedy = f'missing = "fill" fills {"them in" if few else f"in at most {100 * MOST_FILLED:g} %"}'
    if count := np.count_nonzero(holes):
        place = tuple(np.argwhere(holes)[0])
        at = "".join(f"[{each}]" for each in place)
        raise ValueError(f"heights{at} = {heights[place]:g}: {_share(count, heights)} missing: {remedy}")
    if found := sentinels(heights):
        count = np.count_nonzero(np.isin(heights, found))
        raise ValueError(
            f"{_share(count, heights)} are {' or '.join(map(_in_words, found))}, far off all others, as programs "
            f"write missing ones: {remedy}"
        )


def cleaned_heights(heights: np.ndarray, pixel: tuple[float, float]) -> tuple[np.ndarray, tuple[str, ...]]:
    """Heights of a map or a line with missing ones filled in, see `filled`; and what was done.

    Raises ValueError where more than a twentieth would be filled in.
    """
    notes = []
    for value in sentinels(heights):
        same = heights == value
        notes.append(
            f"{_share(np.count_nonzero(same), heights)} are {_in_words(value)}, far off all others, and count as "
            "missing"
        )
        heights = np.where(same, np.nan, heights)
    holes = ~np.isfinite(heights)
    count = np.count_nonzero(holes)
    if count > MOST_FILLED * heights.size:
        raise ValueError(f"{_share(count, heights)} missing: at most {100 * MOST_FILLED:g} % are filled in")
    if count:
        notes.append(f"{_share(count, heights)} were missing and are filled in")
    return filled(heights, pixel), tuple(notes)


def _share(count, heights):
    return f"{count} of {heights.size} heights ({100 * count / heights.size:.3g} %)"


def _in_words(value):
    written = _written(value)
    return f"{value:g} m{f' ({written})' * bool(written)}"


def sentinels(heights: np.ndarray) -> list[float]:
    """Heights [m] that lie so far off all others that they stand for none: exact numbers, one at each end at most.

    A number that programs write for none, as -9999, 32767 or 1e38 in m, mm, um or nm, has to lie farther from all
    others than those lie from one another; another one a thousand times as far, and be ten times as large as any.
    Where all other heights are equal, no height is far off.
    """
    known = heights[np.isfinite(heights)]
    ends, found = [float(each(known)) for each in (np.min, np.max) if known.size], set()
    for taken in (ends, ends[:1], ends[1:]):
        rest = known[~np.isin(known, taken)]
        if rest.size and rest.min() < rest.max():
            found |= {end for end in taken if _far(end, float(rest.min()), float(rest.max()))}
    return sorted(found)


def _far(value, low, high):
    off = max(value - high, low - value)
    if _written(value):
        return off > high - low
    return abs(value) > _FARTHER * max(-low, high) and off > _FAR * (high - low)


def _written(value):
    """A number as a program writes it for a missing height, with its unit; empty of any other."""
    texts = {unit: f"{value / metre:.10g}" for unit, metre in _METRES.items()}
    return next((f"{text} {unit}" for unit, text in texts.items() if _NONES.fullmatch(text)), "")


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
    rows, columns = np.nonzero(np.pad(holes, 1))
    # Over a height of their own, so that no sum of them is beyond numbers.
    most = np.abs(heights[~holes]).max() or 1.0
    values = np.pad(np.where(holes, 0.0, heights / most), 1)
    numbers = np.pad(
        np.where(holes, 0, -1), 1, constant_values=-2
    )  # of holes from 0 on, -1 known, -2 beyond a side
    numbers[rows, columns] = here = np.arange(len(rows))
    diagonal, known, pairs = np.zeros(len(rows)), np.zeros(len(rows)), []
    for down, right in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        weight, there = (min(pixel) / pixel[0 if right else 1]) ** 2, (rows + down, columns + right)
        diagonal += weight * (numbers[there] > -2)
        known += weight * values[there]
        hole = numbers[there] >= 0
        pairs.append((here[hole], numbers[there][hole], np.full(hole.sum(), -weight)))
    place, other, value = (np.concatenate(each) for each in zip(*pairs, (here, here, diagonal), strict=True))
    matrix = coo_array((value, (place, other)), shape=(len(rows),) * 2).tocsc()
    found = heights.copy()
    found[holes] = most * splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve(known)
    return found
