"""The reduced model of one unknown: a sphere on a line."""
