"""What a job came to: measured, compared with its reference, and how all others read it.

May import: base, scene, ask, case.
"""
