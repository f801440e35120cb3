"""Demands of journals on figures: widths of their columns, least text, least line."""

from dataclasses import dataclass, replace
from difflib import get_close_matches

MILLIMETRE, POINT = 1 / 25.4, 1 / 72


@dataclass(frozen=True)
class Journal:
    """A journal, or the house style of a publisher.

    title : as printed
    single, double : widths of a figure across one column and across the page [inch]
    text, least : of axis labels, and of the smallest text [point]; indices of formulas are 0.7 of their text
    line : thinnest line [point]
    source : where the publisher says so, and what it leaves open
    """

    title: str
    single: float
    double: float
    text: float
    least: float
    line: float
    source: str


# Widths of the default, for publishers that name none.
COLUMN, PAGE = 3.5, 7.2
# Of columns [mm], from that of the narrowest journal on: narrower ones cut titles.
WIDTHS = 80, 200

JOURNALS = {
    "default": Journal("no journal in particular", COLUMN, PAGE, 8.0, 6.0, 0.3, "fits most with little change"),
    "acs": Journal(
        "American Chemical Society", 240 * POINT, 504 * POINT, 7.0, 4.5, 0.5,
        "researcher-resources.acs.org, Author Guidelines: 240 points (3.33 in.), 300 to 504 points (7 in.); "
        "lettering from 4.5 points, lines from 0.5",
    ),
    "aip": Journal(
        "AIP Publishing", 3.37, 6.69, 8.0, 8.0, 0.5,
        "publishing.aip.org, Author Instructions: 3.37 in. and 6.69 in.; labels from 8 points, lines from 0.5",
    ),
    "aps": Journal(
        "American Physical Society", 3.375, 7.0, 8.0, 8.0, 0.18 * MILLIMETRE / POINT,
        "journals.aps.org, Style Basics: 3 3/8 in.; capitals and numerals from 2 mm (8 points here), lines from "
        "0.18 mm; no width of two columns is named: that of the text in REVTeX, 7 in.",
    ),
    "elsevier": Journal(
        "Elsevier", 90 * MILLIMETRE, 190 * MILLIMETRE, 8.0, 7.0, 0.25,
        "elsevier.com, Artwork sizing: 90 mm and 190 mm; text of 7 points, lines of 0.25",
    ),
    "ieee": Journal(
        "IEEE", 3.5, 7.16, 9.0, 8.0, 0.3,
        "journals.ieeeauthorcenter.ieee.org, Resolution and Size: 3.5 in. and 7.16 in.; text of 9 to 10 points at "
        "best; no least text (here 8 points) or line is named",
    ),
    "iop": Journal(
        "IOP Publishing", 85 * MILLIMETRE, 150 * MILLIMETRE, 8.0, 8.0, 0.3,
        "publishingsupport.iopscience.iop.org, Figures for journal articles: typically 8.5 cm and 15 cm; text of "
        "8 to 12 points; no least line is named",
    ),
    "nature": Journal(
        "Nature Portfolio", 89 * MILLIMETRE, 183 * MILLIMETRE, 7.0, 5.0, 0.25,
        "research-figure-guide.nature.com: 89 mm and 183 mm; text of 5 to 7 points, lines from 0.25",
    ),
    "royal-society": Journal(
        "Royal Society", 84 * MILLIMETRE, 175 * MILLIMETRE, 8.0, 6.0, 0.3,
        "at second hand, from figure settings for Proceedings B of 2014: columns of 84 mm, 7 mm apart; no least "
        "text or line is known",
    ),
    "sage": Journal(
        "Sage", COLUMN, PAGE, 8.0, 6.0, 0.3,
        "no width, least text or line of all journals is known: those of the default",
    ),
    "springer": Journal(
        "Springer", 84 * MILLIMETRE, 174 * MILLIMETRE, 8.0, 8.0, 0.3,
        "springer.com, Artwork guidelines: 84 mm and 174 mm; lettering of 8 to 12 points, lines from 0.3",
    ),
    "taylor-francis": Journal(
        "Taylor & Francis", COLUMN, PAGE, 8.0, 6.0, 0.3,
        "authorservices.taylorandfrancis.com, Submission of electronic artwork: lines from 0.3 points; widths are "
        "left to each journal: those of the default",
    ),
    "wiley": Journal(
        "Wiley", 80 * MILLIMETRE, 180 * MILLIMETRE, 8.0, 6.0, 0.3,
        "authorservices.wiley.com, Guidelines for the Preparation of Figures (2016): 80 mm and 180 mm; no least "
        "text or line is named",
    ),
}  # fmt: skip


def journal(name: str, width: str | float | None = None) -> Journal:
    """Journal by its name in the table.

    width : of a column, as "84 mm" or in metres, with the page as much wider or narrower; that of the journal if
        absent

    Raises ValueError of another name, which lists the names, and of a width that is no length or out of WIDTHS.
    """
    from scene.printable import brief  # whoever lists journals needs no scene
    from scene.quantities import METRE, argument

    if name not in JOURNALS:
        meant = get_close_matches(name, JOURNALS, 1)
        hint = f"; did you mean {meant[0]}?" if meant else "."
        raise ValueError(f"no journal {brief(repr(name))}{hint} Known are {', '.join(JOURNALS)}.")
    found = JOURNALS[name]
    if width is None:
        return found
    millimetres = 1e3 * float(argument("width", width, METRE.value))
    if not WIDTHS[0] <= millimetres <= WIDTHS[1]:
        raise ValueError(f"width = {brief(repr(width))}: {WIDTHS[0]} mm to {WIDTHS[1]} mm are allowed")
    column = millimetres * MILLIMETRE
    return replace(found, single=column, double=column / found.single * found.double)
