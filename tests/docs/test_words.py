"""The English of user texts: phrases that take two readings are in no page, docstring, ready scene or study."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("scene", "mdr1d", "bem3d", "compare")
# Phrase: what to write instead.
BANNED = {
    r"\bas of\b": "like that of, or from",
    r"\bin the place of\b": "in place of",
    r"\bbut for\b": "except",
    r"^\s*The same\.": "the thing itself",
    r"\b(obviously|of course|needless to say|basically)\b": "nothing",
    r"\b(in order to|utili[sz]e|thereof|whereby)\b": "to, use, of it, by which",
}
# A sentence whose subject is a clause: "What has faded is dropped." A question may begin so.
WHAT = {r"(?:^|[.;:]\s+|^\s*- )What\b(?![^.?]*\?)": "the noun that is meant"}
CODE = re.compile(r"^```.*?^```|`[^`\n]*`|^\$\$.*?\$\$|^#.*?$|^\|.*?$", re.DOTALL | re.MULTILINE)


def pages() -> Iterator[tuple[str, str]]:
    """Prose of README, CONTRIBUTING and pages: without code, formulas, headings, tables and history."""
    written = (path for path in sorted((ROOT / "docs").rglob("*.md")) if path.name != "changelog.md")
    for path in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *written):
        yield str(path.relative_to(ROOT)), CODE.sub("", path.read_text(encoding="utf-8"))


def docstrings() -> Iterator[tuple[str, str]]:
    """Docstrings of the packages, and texts of ready scenes and studies."""
    for path in (each for package in PACKAGES for each in sorted((ROOT / package).rglob("*.py"))):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and (text := ast.get_docstring(node)):
                yield f"{path.relative_to(ROOT)}:{getattr(node, 'name', '')}", text
    for path in sorted((ROOT / "compare").rglob("*.toml")):
        yield str(path.relative_to(ROOT)), path.read_text(encoding="utf-8")


def found(texts: Iterator[tuple[str, str]], phrases: dict[str, str]) -> list[str]:
    """Each banned phrase with its place, its surroundings, and what to write instead."""
    return [
        f"{place}: ...{text[max(0, match.start() - 30) : match.end() + 30]}... (say: {instead})".replace("\n", " ")
        for place, text in texts
        for phrase, instead in phrases.items()
        for match in re.finditer(phrase, text, re.MULTILINE)
    ]


def test_pages_take_one_reading():
    assert found(pages(), BANNED | WHAT) == []


def test_docstrings_take_one_reading():
    assert found(docstrings(), BANNED) == []


@pytest.mark.parametrize("text", ["Pressure as of `solve`.", "- What has faded is dropped.", "The same."])
def test_a_banned_phrase_is_found(text):
    assert len(found(iter([("page", text)]), BANNED | WHAT)) == 1


@pytest.mark.parametrize("text", ["What does it cost?", "It says what it costs."])
def test_a_sentence_that_takes_one_reading_is_not_found(text):
    assert found(iter([("page", text)]), BANNED | WHAT) == []


def test_the_readme_has_at_most_600_words():
    words = re.findall(r"\S*\w\S*", (ROOT / "README.md").read_text(encoding="utf-8"))
    assert len(words) <= 600
