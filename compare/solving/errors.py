"""Errors and warnings that whoever calls `compare` may catch; they are those of `scene`."""

from scene import Doubtful, InvalidInput, OutOfMemory, Refused, SolveError

__all__ = ["Doubtful", "InvalidInput", "OutOfMemory", "Refused", "SolveError"]
