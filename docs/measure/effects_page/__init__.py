"""What each effect does to a contact, asked of the solvers and held against references: the chapters of a page."""
