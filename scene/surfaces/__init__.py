"""Roughness: self-affine, waves, spectra, maps and lines of heights, and what describes them."""
