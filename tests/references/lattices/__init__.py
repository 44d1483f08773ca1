"""Claims about the references of bonded lattices."""
