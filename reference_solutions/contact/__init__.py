"""References of contacts of spheres."""
