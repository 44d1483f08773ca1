"""Claims about bonds in DEM, and lattices of them."""
