"""Accuracy over cost: errors, times and memory along ladders of settings."""
