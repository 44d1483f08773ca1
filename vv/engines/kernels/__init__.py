"""What the kernels of all engines share: compilation, vectors of three, driven motion.

May import: base, scene.
"""
