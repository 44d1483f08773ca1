"""What a solver takes for a step: of blocks, bonds and many spheres, beside other codes."""
