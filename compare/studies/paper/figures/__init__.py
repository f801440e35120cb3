"""Figures of the paper."""

from . import contacts, law, sketch, studies

__all__ = ["contacts", "law", "sketch", "studies"]
