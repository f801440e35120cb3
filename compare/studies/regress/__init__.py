"""Accuracy against stored values: crosscheck regress."""
