"""The size of the house: no part of it is larger than its ceiling, and ceilings are only ever lowered."""

import ast
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).parents[2]
LARGEST = 5  # files that a failure names


class Size(NamedTuple):
    """Size of a part of the repository.

    lines : of all files; they are reported and hold nothing, so that docstrings and short lines cost nothing
    amount : nodes of the syntax tree, of which a docstring is two however long; of pages, words
    files : number of files
    """

    lines: int
    amount: int
    files: int


# A change that makes a part smaller lowers its numbers to what it reached. None is ever raised.
# fmt: off
CEILINGS = {
    "scene":   Size(  8_442,  60_497,  50),
    "mdr1d":   Size(  3_674,  26_125,  25),
    "bem3d":   Size(  6_345,  50_404,  45),
    "compare": Size( 21_384, 160_187, 149),
    "tests":   Size( 25_755, 226_833, 164),
    "docs":    Size(  4_115,  36_098,  29),
    "pages":   Size(  5_218,  48_075,  40),
}
# fmt: on


def files_of(part: str, root: Path = ROOT) -> list[Path]:
    """Files of a part: Python of a folder, or README and the pages of the documentation."""
    if part == "pages":
        return [root / "README.md", *sorted((root / "docs").rglob("*.md"))]
    return sorted((root / part).rglob("*.py"))


def size_of(file: Path) -> Size:
    """Size of one file."""
    text = file.read_text(encoding="utf-8")
    amount = len(text.split()) if file.suffix == ".md" else sum(1 for _ in ast.walk(ast.parse(text)))
    return Size(text.count("\n"), amount, 1)


def excess(part: str, ceiling: Size, root: Path = ROOT) -> str:
    """Size of a part above its ceiling and its largest files in words; empty where it keeps the ceiling."""
    sizes = {file: size_of(file) for file in files_of(part, root)}
    found = Size(*map(sum, zip(*sizes.values(), strict=True)))
    unit = "words" if part == "pages" else "nodes"
    told = "; ".join(
        f"{name} {number:,}, ceiling {most:,}"
        for name, number, most in zip(("lines", unit, "files"), found, ceiling, strict=True)
    )
    print(f"{part}: {told}")
    if found.amount <= ceiling.amount and found.files <= ceiling.files:
        return ""
    largest = sorted(sizes, key=lambda file: sizes[file].amount, reverse=True)[:LARGEST]
    named = ", ".join(f"{file.relative_to(root)} {sizes[file].amount:,}" for file in largest)
    return f"{part} is above its ceiling: {told} (lines do not count). Its largest files by {unit}: {named}"


@pytest.mark.parametrize("part", CEILINGS)
def test_no_part_of_the_house_is_above_its_ceiling(part):
    above = excess(part, CEILINGS[part])
    assert not above, above


def test_a_docstring_counts_two_nodes_whatever_its_length(tmp_path):
    found = {}
    for name, lines in (("none", []), ("short", ['"""One."""']), ("long", ['"""One.', "", 'Many words."""'])):
        file = tmp_path / f"{name}.py"
        file.write_text("\n".join([*lines, "a = 1"]), encoding="utf-8")
        found[name] = size_of(file).amount
    assert found["short"] == found["long"] == found["none"] + 2


def test_a_part_above_its_ceiling_is_named_with_its_largest_files(tmp_path):
    for part, name, text in (("scene", "large.py", "a = 1 + 2\n"), ("docs", "page.md", "Four words are here.\n")):
        (tmp_path / part).mkdir()
        (tmp_path / part / name).write_text(text, encoding="utf-8")
    (tmp_path / "README.md").write_text("Two words.\n", encoding="utf-8")
    assert not excess("scene", Size(0, 8, 1), tmp_path)
    assert not excess("pages", Size(0, 6, 2), tmp_path)
    for ceiling in (Size(9, 7, 1), Size(9, 8, 0)):
        assert "scene is above its ceiling: lines 1, ceiling 9; nodes 8" in excess("scene", ceiling, tmp_path)
        assert "scene/large.py 8" in excess("scene", ceiling, tmp_path)
    assert "page.md 4" in excess("pages", Size(9, 5, 2), tmp_path)
