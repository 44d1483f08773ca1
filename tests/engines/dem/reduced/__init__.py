"""Claims about the models of DEM with one and two unknowns."""
