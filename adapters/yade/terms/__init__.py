"""The translation of each term of a scene for YADE: see `table`."""
