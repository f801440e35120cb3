"""Names that are given and names that are known."""

from collections.abc import Collection

LONGEST = 100  # letters of a name that are compared


def suggestion(given: str, names: Collection[str]) -> str:
    """Known name that looks much like the given one, as the end of a sentence; empty if nothing does."""
    from difflib import get_close_matches

    close = get_close_matches(given[:LONGEST], names, n=1)
    return f"; did you mean {close[0]}?" if close else ""


def known(option: str, given: str, names: Collection[str], otherwise: str = "") -> None:
    """Raise InvalidInput where something is given that is not known."""
    if given not in names:
        from scene.printable import brief  # slow, and only a mistake needs it
        from scene.reading import InvalidInput

        near = suggestion(given, list(names)) or (otherwise and f"; {otherwise}")
        raise InvalidInput(f"{option} = {brief(given)}: allowed are {', '.join(names)}{near}")
