"""What the figures show as plain arrays, and how they are written as SVG.

May import: base, scene, ask, case, records, gate, insight, output, reports.marks, reports.norms,
reports.outcomes, reports.text.
"""
