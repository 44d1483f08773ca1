"""Claims about the references of many spheres."""
