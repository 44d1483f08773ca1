"""The reduced model: one block that cannot rotate, on at most one wall, as a point mass."""
