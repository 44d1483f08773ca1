"""Claims about the references of contacts of spheres."""
