"""Tables and maps in dialects drawn at random: what spreadsheets, instruments and people write."""

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
STRANGERS = "Temp. set", "Status", "Torque", "n°", "Strain (%)", "date"
WORDS = "ok", "12.03.2024", "2024-03-12 10:15", "10:15:07", "n. b.", "A 1"
REMARKS = (
    "Sample: rubber 7",
    "Operator;A. Ruiz",
    "T = 25 °C",
    "Instrument\tRheo 5",
    "Probekörper µ-7",
    "Of 2024-11-02",
)
GAPS = "", "nan", "-", "NaN", "n/a"
FORMS = "%.3f", "%.6g", "%.4e", "%.2f", "%d", "%.1f", "%g", "%.17g"
SPOILT = "1.2.3", "x", "1e", "12,5,1"


@dataclass(frozen=True)
class Drawn:
    """A file as it was written, and what it holds.

    content : of the file
    held : numbers, NaN where a cell was left empty; of a table in SI by field
    damaged : the same file with one cell made unreadable; of a table one of its fields
    """

    content: bytes
    held: dict[str, np.ndarray]
    damaged: bytes


class Writer:
    """Dialect and habits of one program."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng
        self.separator = self.one(",", ";", "\t", " ", "|", ", ", " ; ", "  ")
        self.decimal, self.newline = self.one(".", ","), self.one("\n", "\r\n")
        self.encoding = self.one("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "cp1252")
        self.quote, self.doubled = self.one("", "", "", '"'), self.one('"', '""')
        self.form, self.align = self.one(*FORMS), self.one(0, 0, 0, 14)
        self.mark = self.one("", "", "", "# ", "#", "% ")
        self.tail = self.separator if self.often(0.1) and self.separator.strip() else ""
        self.remarks = [self.one("", "# ", "") + self.one(*REMARKS) for _ in range(int(rng.integers(0, 4)))]
        self.remarks += [""] * (len(self.remarks) > 0 and self.often(0.5))

    def one(self, *choices):
        """One of some choices."""
        return choices[self.rng.integers(len(choices))]

    def often(self, share):
        """Whether something happens that does so in a share of cases."""
        return self.rng.random() < share

    def column(self, values, holes=0.0):
        """Numbers as they are read, and cells as they are written."""
        texts, gone = [self.form % each for each in values], self.rng.random(len(values)) < holes
        numbers = np.where(gone, np.nan, np.array(texts, float))
        cells = zip(texts, gone, strict=True)
        return numbers, [self.one(*GAPS) if lost else text.replace(".", self.decimal) for text, lost in cells]

    def heading(self, cells):
        """A line of names or units."""
        inside = [each.replace('"', self.doubled) if self.quote else each for each in cells]
        return self.mark + self.separator.join(f"{self.quote}{each}{self.quote}" for each in inside) + self.tail

    def rows(self, columns):
        """Lines of cells."""
        quoted = [[f"{self.quote}{cell}{self.quote}".rjust(self.align) for cell in each] for each in columns]
        return [self.separator.join(row) + self.tail for row in zip(*quoted, strict=True)]

    def file(self, *lines):
        """Bytes of lines."""
        return self.newline.join([*self.remarks, *lines, ""]).encode(self.encoding, errors="replace")

    def spoil(self, columns, place):
        """Columns with one unreadable cell in one of them."""
        spoilt, row = [list(each) for each in columns], int(self.rng.integers(0, len(columns[0])))
        spoilt[place][row] = self.one(*SPOILT)
        return spoilt


def draw_table(seed: int) -> Drawn:
    """A table of frequencies and moduli, maybe with strange columns among them."""
    writer = Writer(rng := np.random.default_rng(seed))
    heads, rows, holes = writer.often(0.85), int(rng.integers(1, 40)), 0.1 if writer.often(0.2) else 0.0
    told = writer.one("in heading", "in heading", "below", "nowhere") if heads else "nowhere"
    held, columns, names, units = {}, [], [], []
    fields = list(map(str, rng.permutation(list(UNITS)))) if heads else list(UNITS)
    for field in fields:
        values = 10 ** rng.uniform(-3, 6, rows) * rng.choice([1.0, 1.0, -1.0], rows)
        numbers, cells = writer.column(values, holes)
        unit = writer.one(*UNITS[field])
        held[field] = numbers * (1.0 if told == "nowhere" else UNITS[field][unit])
        for each, own in ((columns, cells), (names, writer.one(*CALLED[field])), (units, unit)):
            each.append(own)
    own = [*fields]
    for _ in range(int(rng.integers(0, 3)) if heads else 0):
        place = int(rng.integers(0, len(columns) + 1))
        words = [writer.one(*WORDS) for _ in range(rows)]
        columns.insert(place, words if writer.often(0.5) else writer.column(rng.normal(size=rows))[1])
        for each, stranger in ((names, writer.one(*STRANGERS)), (units, ""), (own, "")):
            each.insert(place, stranger)
    if told == "in heading":
        ways = "{} [{}]", "{} ({})", "{} / {}", "{} in {}"
        names = [
            writer.one(*ways).format(*each) if each[1] else each[0] for each in zip(names, units, strict=True)
        ]
    lines = [writer.heading(names)] if heads else []
    if told == "below":
        lines.append(writer.heading([writer.one(each, f"[{each}]") if each else "-" for each in units]))
    pause, between = (
        int(rng.integers(0, rows + 1)) if writer.often(0.1) else rows,
        writer.one("", "# a pause", "  "),
    )

    def written(columns):
        body = writer.rows(columns)
        return writer.file(*lines, *body[:pause], *([between] if pause < rows else []), *body[pause:])

    spoilt = writer.spoil(columns, own.index(writer.one(*fields)))
    return Drawn(written(columns), held, written(spoilt))


def draw_map(seed: int) -> Drawn:
    """Heights in rows and columns, without a word on them."""
    writer = Writer(rng := np.random.default_rng(seed))
    rows, count = rng.integers(4, 14, 2)
    scale, holes = 10 ** rng.uniform(-3, 4), 0.1 if writer.often(0.3) else 0.0
    numbers, columns = zip(
        *(writer.column(scale * rng.normal(size=rows), holes) for _ in range(count)), strict=True
    )
    held = {"heights": np.column_stack(numbers)}
    spoilt = writer.spoil(columns, int(rng.integers(0, count)))
    return Drawn(writer.file(*writer.rows(columns)), held, writer.file(*writer.rows(spoilt)))
