"""Represents blocks, walls and rigid contact in codes without them: spheres, springs, boxes.

May import: base, scene, ask.
"""
