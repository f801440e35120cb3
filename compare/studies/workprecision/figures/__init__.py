"""Figures of work and precision."""
