"""Comparison of models on the same scenes: crosscheck run, sweep and study."""
