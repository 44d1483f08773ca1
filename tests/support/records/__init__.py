"""Records that tests make up."""
