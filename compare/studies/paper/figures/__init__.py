"""Figures of the paper."""

from . import contacts, law, studies

__all__ = ["contacts", "law", "studies"]
