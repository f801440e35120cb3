"""Which term a number, a column or a word on a page is, and which of them a page has to define."""

from collections.abc import Iterator

from .terms import TERMS, Term

# What a column adds to the name of the number that it belongs to.
ENDINGS = ("_error", "_deviation")


class Unknown(KeyError):
    """A name that no term defines."""


def of_number(name: str) -> Term:
    """The term of a number of a judgement, by its name. Raises Unknown."""
    for term in TERMS.values():
        if term.numbers and name.startswith(term.numbers):
            return term
    raise Unknown(name)


def of_column(name: str) -> Term | None:
    """The term of a column of a table, that of the number for its error; None of one that explains itself."""
    if name in _COLUMNS:
        return _COLUMNS[name]
    stems = (name.removesuffix(ending) for ending in ENDINGS if name.endswith(ending))
    return next((_COLUMNS[stem] for stem in stems if stem in _COLUMNS), None)


class Definitions:
    """The terms that one page uses, in the order of the glossary."""

    def __init__(self) -> None:
        self._used: set[str] = set()

    def use(self, name: str) -> Term:
        """The term of an id, which the page then defines. Raises Unknown."""
        if name not in TERMS:
            raise Unknown(name)
        self._used.add(name)
        return TERMS[name]

    def number(self, name: str) -> Term:
        """The term of a number of a judgement, which the page then defines. Raises Unknown."""
        return self.use(of_number(name).id)

    def column(self, name: str) -> Term | None:
        """The term of a column, which the page then defines; None of one that explains itself."""
        found = of_column(name)
        return found and self.use(found.id)

    def __iter__(self) -> Iterator[Term]:
        return (term for name, term in TERMS.items() if name in self._used)


_COLUMNS = {column: term for term in TERMS.values() for column in term.columns}
