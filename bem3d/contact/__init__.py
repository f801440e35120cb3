"""Contact area: the search for it, its Krylov solvers and sums, and partial slip."""
