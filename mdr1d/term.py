"""Term of the one-dimensional foundation: its treatment of one part of a scene."""

from scene import Result, terms


class Term(terms.Term):
    """A part of a scene as the one-dimensional foundation takes it up."""

    def completed(self, result: Result) -> Result:
        """The answer with what the part adds once the normal contact is found."""
        return result
