"""Lines above a map of heights, as "Width: 20.00 µm": the name of the channel, its unit, its pixel."""

import re
from dataclasses import dataclass, field

from .heading import named
from .printable import brief
from .quantities import METRE
from .scan import EVEN
from .sheet import Sheet

CHANNEL = ("channel", "channel name")
UNIT = (
    "value units",
    "value unit",
    "z unit",
    "z units",
    "unit z",
    "height unit",
    "height units",
    "unit of heights",
    "unit",
    "units",
)
# Sides along x, along y, and both, of the whole map and of a pixel.
SIZES = (
    (
        "width",
        "x size",
        "size x",
        "scan size x",
        "x scan size",
        "x range",
        "x length",
        "x amplitude",
        "scan width",
    ),
    (
        "height",
        "y size",
        "size y",
        "scan size y",
        "y scan size",
        "y range",
        "y length",
        "y amplitude",
        "scan height",
    ),
    ("scan size", "scan range", "size", "image size", "field of view"),
)
PIXELS = (
    ("x pixel size", "pixel size x", "pixel width", "x step", "step x", "dx", "x spacing", "spacing x"),
    ("y pixel size", "pixel size y", "pixel height", "y step", "step y", "dy", "y spacing", "spacing y"),
    ("pixel size", "pixel", "pixel spacing", "spacing", "step size", "point spacing", "pitch", "xy calibration"),
)
_HEIGHTS = {"height", "heights", "z", "topography", "elevation"}
# A length that a line speaks of without a number.
_SPOKEN = re.compile(r"(?<![\d.,]\s)(?<![^\W_])(?:[pnuµμmc]m|Å|microns?|angstroms?)(?![^\W_])")
_LINE = re.compile(r"([^:=;\t]*[^\W\d][^:=;\t]*?)\s*[:=;\t,]\s*(.*?)[\s;,]*")
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_LENGTHS = re.compile(rf"({_NUMBER})\s*([^\W\d]+|Å)?(?:\s*[x×*]\s*({_NUMBER})\s*([^\W\d]+|Å)?)?")


@dataclass(frozen=True)
class Header:
    """What the lines above a block of heights say.

    channel, unit : name of the block, and unit of its heights as it is written; empty where they are not stated
    lengths : sides by the names that they may have, of the map or of a pixel: one [m], or two along x and y
    notes : lines that seem to state a side, and do not, with the reason
    rest : lines that say nothing that is known
    """

    channel: str = ""
    unit: str = ""
    lengths: dict[tuple[str, ...], tuple[float, ...]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    rest: tuple[str, ...] = ()

    @classmethod
    def of(cls, sheet: Sheet, above: "Header | None" = None) -> "Header":
        """The header of a block; above : that of the block before, whose sides hold on. Raises ValueError."""
        own: dict[tuple[str, ...], tuple[float, ...]] = {}
        notes, rest, channel, unit = [], [], "", ""
        for line, key, written, value in _statements(sheet.before):
            names = [each for each in (*SIZES, *PIXELS) if key in each]
            if key in CHANNEL:
                channel, unit = _parted(value, unit)
            elif key in UNIT and value:
                unit = value
            elif names and (found := _lengths(sheet, line, value, written)):
                if own.setdefault(names[0], found) != found:
                    raise ValueError(f"{sheet.name}: {brief(repr(line))} is another {key} than above: keep one")
            elif not value and (found_unit := _of_heights(line)):
                unit = found_unit
            else:
                rest.append(line)
                if names:
                    notes.append(f"{sheet.name}: {brief(repr(line))} has no unit of length and is not used")
        lengths = (above.lengths if above else {}) | own
        return cls(channel, unit, lengths, tuple(notes), tuple(rest))

    @property
    def spoken(self) -> frozenset[str]:
        """Units of length in lines that say nothing else, where the unit of the heights is not stated."""
        lines = () if self.unit else self.rest
        ends = ({"m"} & {line.rpartition(mark)[2].strip()} for line in lines for mark in ":=")
        return frozenset().union(*map(_SPOKEN.findall, lines), *ends)

    @property
    def step(self) -> float | None:
        """Spacing of the points along a line [m]; None where it is not stated."""
        return next((self.lengths[each][0] for each in (PIXELS[0], PIXELS[2]) if each in self.lengths), None)

    def sides(self, name: str, columns: int, rows: int) -> tuple[float | None, float | None]:
        """Sides of a pixel of a map of so many [m], None where one is not stated.

        name : of the file. Raises ValueError where the size and the pixel contradict one another.
        """
        along_x, along_y = (
            self._agreed(name, self._side(PIXELS, k, True), self._side(SIZES, k, columns == rows), count)
            for k, count in enumerate((columns, rows))
        )
        return along_x, along_y

    def _agreed(self, name, pixel, size, count):
        # Some count from the first pixel to the last.
        spans = [] if size is None else [size / count, size / (count - 1)]
        if pixel and spans and min(abs(span - pixel) for span in spans) > 10 * EVEN * pixel:
            raise ValueError(
                f"{name} states pixels of {pixel:g} m and a size of {size:g} m, which is {spans[0]:g} m a "
                f"pixel of {count}"
            )
        return pixel or next(iter(spans), None)

    def _side(self, names, k, alike):
        """The side along x or y, one for both only if pixels are squares."""
        own, both = self.lengths.get(names[k], ()), self.lengths.get(names[2], ())
        if own or len(both) < 2:
            return next(iter(own or (both if alike else ())), None)
        return both[k]


def _statements(lines):
    """Lines with what they state: key, unit behind the key, value; empty where they state nothing."""
    lines = [line.replace('"', "").strip().lstrip("\\") for line in lines]
    stated = [_LINE.fullmatch(line) for line in lines]
    if _is_gwyddion(stated):
        keys = [CHANNEL[0], SIZES[0][0], SIZES[1][0], UNIT[0]]
        return [(line, key, "", each[2]) for line, key, each in zip(lines, keys, stated, strict=True)]
    keys = [named(each[1]) if each else ("", "") for each in stated]
    values = [each[2] if each else "" for each in stated]
    return [
        (line, " ".join(re.split(r"[\s_-]+", key.casefold())), written, value)
        for line, (key, written), value in zip(lines, keys, values, strict=True)
    ]


def _is_gwyddion(stated):
    """Whether four lines name a channel, its width, its height and its unit, in whatever language."""
    if len(stated) != 4 or None in stated:
        return False
    *sides, unit = (each[2] for each in stated[1:])
    return _is_length(unit) and all(_LENGTHS.fullmatch(side.replace(",", ".")) for side in sides)


def _of_heights(line):
    """The unit of a line like "Heights in nm" or "z [um]"; empty of any other."""
    name, written = named(line)
    return _parted(line, "")[1] if written and not set(name.casefold().split()).isdisjoint(_HEIGHTS) else ""


def _parted(value, unit):
    """Name of a channel, and the unit in brackets after it, if it is one of a length."""
    name, written = named(value)
    return (name, written) if _is_length(written) else (value, unit)


def _is_length(unit):
    try:
        METRE.scale(unit)
    except ValueError:
        return False
    return True


def _lengths(sheet, line, value, written):
    """One length [m] or two, along x and along y; none where there is no unit."""
    text = value if "." in value else re.sub(r"(?<=\d),(?=\d)", ".", value)
    found = _LENGTHS.fullmatch(" ".join(re.split(r"[\s;,]+", text)).strip())
    if found is None:
        return ()
    one, unit, other, others = found.groups()
    units = unit or others or written, others or unit or written
    if not units[0]:
        return ()
    try:
        numbers = [(one, units[0])] + ([(other, units[1])] if other else [])
        lengths = tuple(METRE.value(f"{number} {each}") for number, each in numbers)
    except ValueError as error:
        raise ValueError(f"{sheet.name}: {brief(repr(line))}: {error}") from None
    if min(lengths) <= 0:
        raise ValueError(f"{sheet.name}: {brief(repr(line))}: a length greater than 0 is needed")
    return lengths
