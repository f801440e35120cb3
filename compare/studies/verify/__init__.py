"""Scorecard of a code of contact: `crosscheck verify`."""
