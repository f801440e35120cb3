"""Rheology: models, modes of Prony series, tables of moduli, and what continues them."""
