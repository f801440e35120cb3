"""How the contact moves: steady sliding, and steps in time with what an elastomer remembers."""
