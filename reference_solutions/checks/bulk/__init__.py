"""Second, independent solutions for the references of many spheres."""
