"""Tables in dialects of text files, drawn at random: what spreadsheets, instruments and people write."""

from dataclasses import dataclass

import numpy as np

UNITS = {
    "frequency": {"Hz": 1.0, "kHz": 1e3, "mHz": 1e-3},
    "storage": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    "loss": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6},
}
CALLED = {
    "frequency": ("f", "Frequency", "freq", "FREQUENCY"),
    "storage": ("G'", "Storage modulus", "storage_modulus"),
    "loss": ("G''", 'G"', "Loss Modulus", "loss modulus"),
}
STRANGERS = ("Temp. set", "Status", "Torque", "n°", "Strain (%)", "date")
WORDS = ("ok", "12.03.2024", "2024-03-12 10:15", "10:15:07", "n. b.", "A 1")
METADATA = (
    "Sample: rubber 7",
    "Operator;A. Ruiz",
    "T = 25 °C",
    "Instrument\tRheo 5",
    "Probekörper µ-7",
    "Created 2024-11-02",
)


@dataclass(frozen=True)
class Drawn:
    """A table as it was written.

    content : of the file
    columns : numbers in SI by field, NaN where a cell was left empty
    damaged : the same file with one cell of those columns made unreadable
    """

    content: bytes
    columns: dict[str, np.ndarray]
    damaged: bytes


def draw(seed: int) -> Drawn:
    """A table of the seed."""
    rng = np.random.default_rng(seed)

    def one(*choices):
        return choices[rng.integers(len(choices))]

    def often(share):
        return rng.random() < share

    separator = one(",", ";", "\t", " ", "|", ", ", " ; ", "  ")
    decimal, newline = one(".", ","), one("\n", "\r\n")
    encoding = one("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "cp1252")
    heads, quote, align = often(0.85), one("", "", "", '"'), one(0, 0, 0, 14)
    unit_line = heads and often(0.3)
    in_heading = heads and not unit_line and often(0.8)
    rows = int(rng.integers(1, 40))
    form = one("%.3f", "%.6g", "%.4e", "%.2f", "%d", "%.1f", "%g", "%.17g")
    columns, cells, headings, units = {}, [], [], []
    for field in rng.permutation(list(UNITS)) if heads else UNITS:
        written = [form % each for each in 10 ** rng.uniform(-3, 6, rows) * rng.choice([1.0, 1.0, -1.0], rows)]
        empty = rng.random(rows) < (0.1 if often(0.2) else 0.0)
        unit = one(*UNITS[field])
        numbers = np.array([np.nan if gone else float(text) for text, gone in zip(written, empty, strict=True)])
        columns[str(field)] = numbers, UNITS[field][unit] if unit_line or in_heading else 1.0
        gaps = "", "nan", "-", "NaN", "n/a"
        cells.append(
            [one(*gaps) if gone else text.replace(".", decimal) for text, gone in zip(written, empty, strict=True)]
        )
        headings.append(one(*CALLED[field]))
        units.append(unit)
    own = [*cells]
    for _ in range(int(rng.integers(0, 3)) if heads else 0):
        place, strange = int(rng.integers(0, len(cells) + 1)), rng.normal(size=rows)
        words = often(0.5)
        cells.insert(place, [one(*WORDS) if words else (form % each).replace(".", decimal) for each in strange])
        headings.insert(place, one(*STRANGERS))
        units.insert(place, "")
    if in_heading:
        headings = [
            one(f"{name} [{unit}]", f"{name} ({unit})", f"{name} / {unit}", f"{name} in {unit}") if unit else name
            for name, unit in zip(headings, units, strict=True)
        ]
    doubled = one('"', '""')
    mark = one("", "", "", "# ", "#", "% ")
    tail = separator if often(0.1) and separator.strip() else ""
    lines = [one("", "# ", "") + one(*METADATA) for _ in range(int(rng.integers(0, 4)))]
    lines += [""] * (len(lines) > 0 and often(0.5))
    if heads:
        lines.append(
            mark
            + separator.join(
                f"{quote}{name.replace(chr(34), doubled) if quote else name}{quote}" for name in headings
            )
            + tail
        )
    if unit_line:
        said = [one(unit, f"[{unit}]") if unit else one("-", "") for unit in units]
        lines.append(mark + separator.join(said) + tail)
    pause = int(rng.integers(0, rows + 1)) if often(0.1) else None
    between = one("", "# a pause", "   ")

    def written(columns):
        body = [
            separator.join(f"{quote}{cell}{quote}".rjust(align) for cell in row) + tail
            for row in zip(*columns, strict=True)
        ]
        if pause is not None:
            body.insert(pause, between)
        return newline.join([*lines, *body, ""]).encode(encoding, errors="replace")

    hurt, row = one(*own), int(rng.integers(0, rows))
    spoilt = [
        [
            one("1.2.3", "x", "1e", "12,5,1") if column is hurt and k == row else cell
            for k, cell in enumerate(column)
        ]
        for column in cells
    ]
    return Drawn(
        written(cells), {name: numbers * unit for name, (numbers, unit) in columns.items()}, written(spoilt)
    )
