"""From what a user selects to the jobs to run: project, content, settings, keys.

May import: base, scene, ask, case, codes, store.
"""
