"""What people and other programs read: terminal, JUnit, Markdown, explanations, exports.

May import: base, scene, ask, case, codes, records, store, plan, gate, insight.
"""
