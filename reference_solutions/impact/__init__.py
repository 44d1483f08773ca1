"""Impacts of a sphere on a wall or on another sphere: exact and numerically exact solutions."""
