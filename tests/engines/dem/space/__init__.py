"""Claims about the parts of the general model of DEM."""
