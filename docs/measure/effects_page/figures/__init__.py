"""Figures of the page on effects."""
