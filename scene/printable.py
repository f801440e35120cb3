"""Text as a terminal or a page may show it: what controls one, or turns the direction of reading, is spelt out."""

from unicodedata import category

LONGEST = 200  # letters of a name or a value in a message


def printable(text: str) -> str:
    r"""A text whose unprintable characters, line ends aside, are written as escapes, as \x1b; blanks are alike."""
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() or each == "\n" else _escape(each) for each in text)


def brief(text: str, most: int = LONGEST) -> str:
    """A text in one printable line of so many letters at most, its middle left out where it is longer."""
    ends = text if len(text) <= most else text[:most] + text[-most:]
    line = printable(ends).replace("\n", "\\n")
    if len(line) <= most and ends is text:
        return line
    half = (most - 3) // 2
    return f"{line[:half]}...{line[-half:]}"


def shown(text: object) -> str:
    """A value in a message, a text in quotes, its middle left out where it is long."""
    return brief(repr(text), 80)


def _escape(letter):
    return " " if category(letter) == "Zs" else letter.encode("unicode_escape").decode("ascii")
