"""Models that come with the judge, beside the two solvers: closed forms, and theories of rough friction."""
