"""Second routes to the references of contacts of spheres."""
