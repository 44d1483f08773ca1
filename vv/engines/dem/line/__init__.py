"""The reduced model with one unknown: the displacement of a sphere along a line."""
