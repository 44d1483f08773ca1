"""Bonds between spheres: their law, their layout, and the sweep over all of them."""
