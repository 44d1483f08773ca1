"""Exact motion of one body on rigid contact whose slip changes direction, by Taylor series."""
