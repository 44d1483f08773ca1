"""The general model: spheres that move and rotate in three dimensions."""
