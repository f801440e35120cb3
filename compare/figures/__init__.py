"""Figures as functions of tables, a module a family, in one look that is safe for colour blindness and grey."""
