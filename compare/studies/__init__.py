"""Studies: many points of a few scenes in both dimensionalities, and what becomes of each claim there."""
