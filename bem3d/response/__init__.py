"""What pressure does to the surface: kernels of half-space, layer and line, and the products with them."""
