"""Second routes to the reference solutions for bonded spheres."""
