"""Where a body touches: the search for the contact, its Krylov solvers and sums, and partial slip."""
