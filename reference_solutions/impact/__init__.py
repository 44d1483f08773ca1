"""A sphere strikes a wall or another sphere: exact and numerically exact answers."""
