"""Scenes and studies to begin with, and how a scene that a user names is found and read."""
