"""The cost of a step as scenes grow, in each code, compared with the memory bandwidth.

May import: scene, ask, codes.
"""
