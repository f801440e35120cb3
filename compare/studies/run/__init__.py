"""Scenes in one and in three dimensions: crosscheck run."""
