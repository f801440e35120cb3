"""Hard cases: crosscheck stability."""
