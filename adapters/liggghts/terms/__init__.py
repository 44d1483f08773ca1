"""The translation of each term of a scene for LIGGGHTS: see `table`."""
