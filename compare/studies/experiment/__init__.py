"""The experiment of the paper in three dimensions: `crosscheck study experiment`."""
