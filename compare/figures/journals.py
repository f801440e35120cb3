"""Widths of the columns of journals; the style sheet of each, with its source, stands beside this module."""

from scene.quantities import METRE, argument

INCH = 0.0254

# Across one column and across the page [inch].
COLUMNS = {
    "default": (3.5, 7.2),
    "acs": (3.333, 7.0),
    "aip": (3.37, 6.69),
    "aps": (3.375, 7.0),
    "elsevier": (3.543, 7.480),
    "ieee": (3.5, 7.16),
    "iop": (3.346, 5.906),
    "nature": (3.504, 7.205),
    "royal-society": (3.307, 6.890),
    "sage": (3.5, 7.2),
    "springer": (3.307, 6.850),
    "taylor-francis": (3.5, 7.2),
    "wiley": (3.150, 7.087),
}
# Of columns that may be asked for [m], from that of the narrowest journal on: narrower ones cut titles.
NARROWEST, WIDEST = 80e-3, 200e-3


def columns(journal: str, width: str | float | None = None) -> tuple[float, float]:
    """Widths of a column and of the page [inch].

    width : of a column, as "84 mm" or in metres, with the page as much wider or narrower; that of the journal if
        absent

    Raises ValueError of a width that is no length, or out of what is allowed.
    """
    single, double = COLUMNS[journal]
    if width is None:
        return single, double
    metres = float(argument("width", width, METRE.value))
    if not NARROWEST <= metres <= WIDEST:
        raise ValueError(f"width = {width!r}: {1e3 * NARROWEST:g} mm to {1e3 * WIDEST:g} mm are allowed")
    return metres / INCH, metres / INCH * double / single
