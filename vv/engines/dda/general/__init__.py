"""The general model of DDA: blocks that move, rotate and deform, with all their unknowns."""
