"""Independent second routes to the references of contacts of spheres."""
