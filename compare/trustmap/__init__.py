"""The trust map: what a 1D answer is worth in three dimensions, from tables that come with the package."""
