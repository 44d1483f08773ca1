"""Claims about the cases of many spheres."""
