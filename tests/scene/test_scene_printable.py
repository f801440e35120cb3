import pytest

from scene.printable import LONGEST, brief, printable

# Escape, bell, return, the C1 form of an escape, direction of reading, no width, half a letter.
CONTROLS = ["\x1b[31m", "\a", "\r", "\b", "\x9b31m", "\u202e", "\u2066", "\u200b", "\ufeff", "\ud800", "\0"]


@pytest.mark.parametrize("control", CONTROLS)
def test_what_controls_a_terminal_is_written_out(control):
    assert printable(control).isprintable()
    assert printable(printable(control)) == printable(control)


def test_letters_of_people_and_line_ends_stay():
    text = "µ = 0.3 °C, naïve 摩擦\nnext"
    assert printable(text) == text
    assert printable("20\u202f000\xa0N") == "20 000 N"
    assert brief(text) == text.replace("\n", "\\n")


@pytest.mark.parametrize("letter", ["a", "\n", "\x1b", "\ud800", "\U000e0001"])
def test_a_brief_text_is_short_and_has_both_of_its_ends(letter):
    found = brief(f"first{letter * 10_000}last")
    assert found.isprintable()
    assert len(found) <= LONGEST
    assert found.startswith("first")
    assert found.endswith("last")
