"""Response of the surface to pressure: kernels of half-space, layer and line, and products with them."""
