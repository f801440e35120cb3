"""Models that the package has in addition to the two solvers: closed forms, and theories of rough friction."""
