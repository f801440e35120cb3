"""What accuracy costs in time: ladders of settings, measured against what is known better."""
