"""Writes results for people and programs: terminal, JUnit, Markdown, pages, exports.

May import: base, scene, ask, case, codes, records, store, plan, gate, insight.
"""
