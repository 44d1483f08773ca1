"""Scenes of blocks, and second routes to how they move."""
