"""Terms of the one-dimensional foundation: how it treats a part of a scene; heating as in every solver."""

from scene import Result, terms
from scene.effects.terms import Heated


class Term(terms.Term):
    """A part of a scene as the one-dimensional foundation treats it."""

    def completed(self, result: Result) -> Result:
        """The answer with what the part adds once the normal contact is found."""
        return result


class HeatedContact(Heated, Term):
    """A contact that its friction heats, solved again until it is as warm as that makes it, if asked for."""
