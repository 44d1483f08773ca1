"""Claims about the references of bonded spheres."""
