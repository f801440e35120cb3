"""A named collection of hard cases: what is hard about each, what must hold, and whether it does."""
