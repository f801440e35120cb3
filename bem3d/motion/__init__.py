"""Motion of the contact: steady sliding, and steps in time with the memory of the elastomer."""
