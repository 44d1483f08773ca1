"""The reduced model with two unknowns: a sphere moves along a wall's normal and one tangent."""
