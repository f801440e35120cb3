"""Measured surfaces: crosscheck topography."""
