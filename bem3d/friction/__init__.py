"""Friction of a solved contact: its estimates, and the bound of their error by the grid."""
