"""Claims about contacts in DEM: friction, dashpots, elastic spheres."""
