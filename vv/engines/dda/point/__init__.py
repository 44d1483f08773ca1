"""The reduced model: one block that cannot rotate, on one wall or none."""
