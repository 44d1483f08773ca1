"""Claims about the cases of contacts of spheres."""
