"""Measured friction shifted onto one curve: crosscheck mastercurve."""
