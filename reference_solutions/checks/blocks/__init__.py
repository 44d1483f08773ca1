"""Second routes to the references of blocks."""
