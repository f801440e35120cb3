"""Frictional heating in three dimensions: that of every solver."""

from scene.effects.terms import Heated

from .term import Term


class HeatedContact(Heated, Term):
    """A contact that its friction heats, solved again until it is as warm as that makes it, if asked for."""
