"""References of many spheres."""
