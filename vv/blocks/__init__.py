"""Convex blocks with friction: one geometry and contact detection, and the modes that use it."""
