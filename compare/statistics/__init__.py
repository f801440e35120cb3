"""Statistics of contacts: intervals over surfaces, collapse of curves, power laws, costs."""
