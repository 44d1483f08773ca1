"""Scenes of spheres: in contact, in oblique impacts, on bonds."""
