"""Bonds between spheres: their law, their arrangement in memory, and the sums of their forces."""
