"""Second routes to the references of bonded spheres."""
