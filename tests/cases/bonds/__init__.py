"""Claims about the cases of bonded spheres."""
