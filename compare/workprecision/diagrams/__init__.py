"""The diagrams: what each setting of a solver buys, a module each with its `DIAGRAM`."""
