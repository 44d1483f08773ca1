"""The general model: blocks that move, turn and strain, with all the unknowns they have."""
