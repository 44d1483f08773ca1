"""Reference solutions for bonded spheres."""
