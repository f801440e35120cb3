"""Solving: tasks, worker processes, a cluster, the store of what is solved, and results as Datasets."""
