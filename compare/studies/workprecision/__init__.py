"""What accuracy costs: error against processor time, of any models on any scene."""
