"""The physical effects of a scene of spheres, one file for each term."""
