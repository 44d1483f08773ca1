"""The augmented Lagrangian: multipliers that bear contact, and slides that turn in its steps."""
