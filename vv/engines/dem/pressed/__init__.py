"""The reduced model of two unknowns: a sphere on a wall that rises and slides one way."""
