"""Computes figures as plain arrays and draws them as SVG.

May import: base, scene, ask, case, records, gate, insight, output, reports.marks, reports.norms,
reports.outcomes, reports.text.
"""
