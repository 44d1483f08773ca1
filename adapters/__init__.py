"""The codes: one file or folder each, ending in ADAPTER; a leading underscore marks a helper.

May import: scene, ask, codes, standins, engines.
"""
