"""Random scenes and packs of many spheres: scatter of laws, and divergence of codes."""
