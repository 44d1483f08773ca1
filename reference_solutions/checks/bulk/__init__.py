"""Second routes to the references of many spheres."""
