"""The figures and parameter studies of Popov et al., Sci. Rep. 4, 3750 (2014), simulated again."""
