"""What knows nothing of mechanics: digests, files, what a source imports, norms, errors.

May import: nothing of ours.
"""
