"""The general model: spheres that move and turn in space."""
