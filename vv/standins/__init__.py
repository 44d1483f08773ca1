"""What stands for blocks, walls and rigid contact in codes without: spheres, springs, boxes.

May import: base, scene, ask.
"""
