"""What a step costs as scenes grow, in each code, beside what the memory of the machine allows.

May import: scene, ask, codes.
"""
