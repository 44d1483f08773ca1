"""References of bonded spheres."""
