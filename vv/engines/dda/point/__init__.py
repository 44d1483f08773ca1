"""The reduced model: one block that cannot turn, on one wall or none."""
