"""Where tasks are solved: processes of this machine, or the workers of a cluster."""
