"""The pages on data of one's own: their files are those of their laws, and their commands print what they show."""

import re

import pytest
import yourdata

PAGES = sorted(yourdata.FOLDER.glob("*.md"))
# Of a machine: seconds and bytes.
MEASURED = re.compile(r"^(?:time|memory) .*$", re.MULTILINE)


@pytest.mark.parametrize("name", yourdata.FILES)
def test_a_file_is_that_of_its_law_and_small(name):
    stored = (yourdata.FOLDER / name).read_text(encoding="utf-8")
    assert stored == yourdata.FILES[name]()
    assert len(stored.encode()) < 30_000


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_commands_print_what_the_page_shows(page):
    for output, block in yourdata.printed(page):
        assert MEASURED.sub("", block[2]).strip() == MEASURED.sub("", output).strip()


def test_every_page_shows_a_command_and_every_file_is_shown():
    texts = {page.stem: page.read_text(encoding="utf-8") for page in PAGES}
    index = texts.pop("index")
    assert all(f"]({name}.md)" in index and "```sh\ncrosscheck " in text for name, text in texts.items())
    assert all(any(f"`{name}`" in text for text in texts.values()) for name in yourdata.FILES)
