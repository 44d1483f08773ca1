"""What YADE is given of each term of a scene: see `table`."""
