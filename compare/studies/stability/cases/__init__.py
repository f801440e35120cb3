"""Contacts in which a solver may fail, each with the law that its answer must keep."""
