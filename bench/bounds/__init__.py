"""Benches of bounds: what they let pass, and how far they are above the errors of codes."""
