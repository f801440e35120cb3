"""Heading of the columns of a table: names and units, in one line or two, or in a comment."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from .dialect import BLANK, EMPTY, NUMBER, STRONG, WORD, Dialect, comment, unquoted
from .printable import brief

_STATEMENT = re.compile(r"[^\W\d][^:=;\t,|]{0,80}[:=].*")  # "Width: 20 µm", "T = 25 °C"
# Ways to write a unit behind a name: "F_N [mN]", "F_N (mN)", "F_N / (N/m)", "F_N / mN", "F_N in mN"; "F_N, mN" and
# "F(mN)" where it is one, as what is behind a comma or in brackets may belong to the name; "G' MPa", "freq_Hz".
_SURE = re.compile(
    r"(?P<name>.+?)(?:\s*\[(?P<a>[^\[\]]*)\]|\s+\((?P<b>[^()]*(?:\([^()]*\)[^()]*)*)\)|\s*/\s*\((?P<c>[^()]+)\)"
    r"|\s*/\s*(?P<d>[^()\[\]/]+(?:/[^()\[\]/]+)?)|\s+in\s+(?P<e>\S+))"
)
_MAYBE = re.compile(r"(?P<name>.+?)(?:,\s*(?P<a>\S+)|\((?P<b>[^()]+)\))")
_PER = "(?:/|_per_|_)"  # a slash stands in no name of a variable
_BEHIND = re.compile(
    r"(?P<name>.+?)[_ ](?P<a>[mkMGµμu]?(?:[hH]z|[pP]a)|[nuµμmk]m|[uµμmk]N"
    rf"|(?:[nuµμmck]?m|rad){_PER}s|[uµμm]s|°C|deg_?[CF])"
)
# A unit of one letter counts only behind what needs it: "F_N" is a force, and "T_g" a temperature.
_LETTER = re.compile(
    r"(?P<name>(?:.*[_ ])?[^\W_]{2,}(?=[_ ]N$)|[tT](?:emp(?:erature)?)?(?=[_ ][CKF]$))[_ ](?P<a>[NCKF])"
)
_UNIT = re.compile(r"[\[(]?\s*(?P<unit>[^\[\]]*?)\s*[\])]?")
_NONE = "", "-", "1"  # in a line of units
# Names of several words are parted by two blanks, or a unit in brackets ends them.
_BLANKS = re.compile(r"\s{2,}|\t"), re.compile(r"\s+(?![\[(/])(?<!/\s)(?![^\[(]*[\])])")


@dataclass(frozen=True)
class Heading:
    """What stands above a block of numbers.

    names : headings of the columns without their units; none without a heading
    units : of the columns as they are written, "" where none is
    before : the other lines above the block, marks of comments off
    commented : whether the heading stands in a comment
    unread : text right above the numbers that is neither a heading of as many columns nor a comment; else ""
    """

    names: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    before: tuple[str, ...] = ()
    commented: bool = False
    unread: str = ""

    @classmethod
    def of(cls, lines: Sequence[str], width: int, dialect: Dialect) -> "Heading":
        """The heading among the lines above so many columns. Raises ValueError for units that are stated twice."""
        said = [(comment(line), line.strip(" ")) for line in lines if line.strip(' \t;,|"-=_+')]
        texts = [line if remark is None else remark for remark, line in said]
        remarks = [remark is not None for remark, _ in said]
        unread = [(k, text) for k, text in enumerate(texts) if not remarks[k] and not is_statement(text)][-1:]
        # The lowest line of as many cells as columns; below it there may be rulers and remarks.
        places = [k for k, text in enumerate(texts) if _may_name(text, width, dialect)]
        if not places:
            text = unread[0][1] if unread else ""
            return cls(before=tuple(texts), commented=remarks[-1:] == [True], unread=text)
        place = first = places[-1]
        names, units = zip(*map(named, parted(texts[place], width, dialect)), strict=True)
        # A line of units below one of names; below both, some programs repeat a remark of words in each column.
        remark = all(dialect.kind(cell) in (WORD, EMPTY) for cell in parted(texts[place], width, dialect))
        for units_at in (place, place - 1)[: 1 + remark]:
            above = {units_at - 1, units_at} <= set(places) and parted(texts[units_at], width, dialect)
            if above and _are_units(above):
                first = units_at - 1
                names, units = _with_units(texts[first], texts[units_at], width, dialect)
                break
        below = unread[0][1] if unread and unread[0][0] > place else ""
        return cls(names, units, (*texts[:first], *texts[place + 1 :]), remarks[place], below)

    def of_columns(self, kept: Sequence[int]) -> "Heading":
        """The heading of some of the columns."""
        if not self.names:
            return self
        return replace(self, names=tuple(self.names[k] for k in kept), units=tuple(self.units[k] for k in kept))


def is_statement(line: str) -> bool:
    """Whether a line states something of the whole table, as "T = 25 °C"."""
    return _STATEMENT.fullmatch(line) is not None


def named(cell: str) -> tuple[str, str]:
    """Name and unit of a heading, as "F_N [mN]" has them; an empty unit where it has none."""
    cell = " ".join(cell.split())
    for way, certain in ((_MAYBE, False), (_SURE, True), (_BEHIND, True), (_LETTER, True)):
        if found := way.fullmatch(cell):
            unit = next((each for each in found.groups()[1:] if each is not None), "").strip()
            if way is _BEHIND:
                unit = unit.replace("deg_", "deg").replace("_per_", "/").replace("_", "/")
            if certain or _is_unit(unit):
                return found["name"].rstrip(" /"), unit
    return cell, ""


def parted(line: str, width: int, dialect: Dialect) -> list[str]:
    """Cells of a heading, as many as columns; none where it has not as many.

    A heading may be parted otherwise than the numbers, as by commas above blanks. A number in it, say of an axis,
    gets a decimal point.
    """
    ways = []
    for separator in dict.fromkeys((dialect.separator, *STRONG, ",")):
        if separator != BLANK and (width > 1 or not any(map(line.count, STRONG))):
            # Quotes within quotes, as of G", are not doubled by every program.
            ways.append([unquoted(each.strip()) for each in line.split(separator)])
            ways.append(Dialect(separator, ".").cells(line))
    # Above cells that are parted otherwise, words with a unit in brackets are a heading, and no sentence.
    if dialect.separator == BLANK or "[" in line:
        ways += [[unquoted(each) for each in blanks.split(line.strip())] for blanks in _BLANKS]
        ways.append(dialect.cells(line))
    cells = next((each for each in ways if len(each) == width and not _torn(each)), [])
    return [cell.replace(",", ".") if dialect.kind(cell) == NUMBER else cell for cell in cells]


def _torn(cells):
    """Whether units in brackets are parted from the names before them."""
    inside = [each.startswith(("[", "(")) for each in cells]
    return any(inside) and not all(
        each or _unit(cell) in _NONE or _is_unit(cell) for each, cell in zip(inside, cells, strict=True)
    )


def _may_name(line, width, dialect):
    """Whether a line may be a heading, or the units of one."""
    cells = parted(line, width, dialect)
    stated = is_statement(line) and (width == 1 or dialect.separator in (BLANK, ","))
    return cells and not stated and any(map(str.isalpha, line))


def _with_units(line, below, width, dialect):
    """Names of a line, and units of the line below it or of its own. Raises ValueError where both have some."""
    pairs = [named(each) for each in parted(line, width, dialect)]
    units = [_unit(each) for each in parted(below, width, dialect)]
    for (name, own), unit in zip(pairs, units, strict=True):
        if own and unit not in (*_NONE, own):
            raise ValueError(f"{brief(name)} has the units {brief(own)} and, below, {brief(unit)}: state one")
    both = zip(pairs, units, strict=True)
    return tuple(name for name, _ in pairs), tuple(own or unit for (_, own), unit in both)


def _unit(cell):
    found = _UNIT.fullmatch(cell.strip())
    return found["unit"] if found else cell.strip()


def _are_units(cells):
    """Whether a line is one of units: all are in brackets, or known, or say that there is none."""
    stated = [each for each in cells if each.strip()]
    if stated and all(each[0] + each[-1] in ("[]", "()") for each in stated):
        return True
    units = [_unit(each) for each in cells]
    said = [each for each in units if each not in (*_NONE, "%")]
    # The unit may be unknown of columns that nobody asks for.
    return len(said) > 0 and sum(map(_is_unit, said)) > len(said) / 2


def _is_unit(text):
    # Units take time to load, and only what has them needs them.
    from .units import Unreadable, known

    try:
        return known(text)
    except Unreadable:
        return False
