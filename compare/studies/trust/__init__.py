"""The trust map: what friction, depth and force of 1D are worth, learned from scenes that both have solved."""
