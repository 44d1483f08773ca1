"""Spheres and springs that stand for blocks and rigid contact in codes that have neither.

May import: base, scene, ask.
"""
