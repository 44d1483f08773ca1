"""The general model: blocks that move and turn, in steps cut at events."""
