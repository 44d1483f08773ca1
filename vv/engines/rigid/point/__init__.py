"""The reduced model: one block that cannot turn, on one wall, as a point mass."""
