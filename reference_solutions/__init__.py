"""Answers that need no code under test: closed forms, event-located solutions, static lattices.

May import: nothing of ours.
"""
