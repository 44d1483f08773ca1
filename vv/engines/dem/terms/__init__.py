"""The terms of a scene of spheres, a file each."""
