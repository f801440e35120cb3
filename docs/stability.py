"""Examines the collection of hard cases at its large size, and writes docs/stability.md.

python docs/stability.py
"""

import sys
import tempfile
from pathlib import Path

from tables import table

from compare.stability import report

INTRODUCTION = (
    "# Hard cases\n\n"
    "{count} cases in which a solver of contacts may fail, each with what must hold: a closed form, a limit, "
    "exact scaling, a balance, or the conditions of contact computed anew by plain sums, in both "
    "dimensionalities wherever both can be asked. Tolerances are part of the law and say where they come from; N "
    "is the number of points of the "
    "grid. What cannot be answered must be refused by an error that names what is wrong.\n\n"
    "Small, they are tests (`tests/test_compare_stability.py`). This page is the large size, written by `python "
    "docs/stability.py` in {seconds:.0f} s of processor time. A row shows the check that came nearest to its "
    "bound, or the message of a refusal; found and allowed are relative numbers unless the law says otherwise."
)
FOUND = (
    "## What the cases changed\n\n"
    "- Rings of points that push one another made sets of contact follow one another in a cycle until the 3D "
    "solver gave up. It now notices a set that comes again and joins those in between (`contact-set-cycles`). "
    "The number of sets "
    "tried before it gives up grows with the grid, and the error carries the violation that is left.\n"
    "- Roughness of less than 1e-160 m was refused in 3D, as its square is no number; a surface is now drawn of "
    "unit "
    "height (`height-zero`).\n"
    "- A smooth contact between the centres of pixels passed for an empty one, of zero force; it is now an error "
    "of "
    "its own (`extents-that-miss`).\n"
    "- Moduli so far apart that their ratio is no number lost their modes, and a glassy solid was answered as a "
    "rubbery "
    "one; they are now refused (`moduli-300-decades-apart`).\n"
    "- A profile pressed in with forces beyond the range of numbers passed for an empty contact in 1D, of zero "
    "force; it is now an error (`speed-beyond-numbers`, `huge`, `denormal`).\n"
    "- A stage lost to rounding beside a longer one ended in an error of arithmetic in 3D; the error now names "
    "the "
    "durations (`stages-apart`).\n\n"
    "Refused, and not answered: lines far beyond v τ/a = 10⁴, depths whose squares are no numbers, memories "
    "beyond 1e150 pixels, contacts of less than nine pixels in 3D or five in 1D."
)


def main() -> None:
    """Examine everything and write the page; ends with an error if a law is broken."""
    with tempfile.TemporaryDirectory() as folder:
        found = report.conduct("large", Path(folder), Path(folder), workers=1)
    groups = list(dict.fromkeys(record.group for record in found))

    def rows():
        for group in groups:
            verdicts = [record.verdict for record in found if record.group == group]
            counts = (verdicts.count(verdict) for verdict in (report.HELD, report.REFUSED, report.BROKEN))
            checks = sum(record.count for record in found if record.group == group)
            yield group, str(len(verdicts)), str(checks), *map(str, counts)

    summary = table("group|cases|checks|held|refused as they should|broken", rows())
    seconds = sum(record.seconds for record in found)
    parts = [INTRODUCTION.format(count=len(found), seconds=seconds), summary, FOUND, report.markdown(found)]
    Path(__file__).with_suffix(".md").write_text("\n\n".join(parts), encoding="utf-8")
    if broken := [record.name for record in found if record.verdict == report.BROKEN]:
        sys.exit(f"broken: {', '.join(broken)}")


if __name__ == "__main__":
    main()
