"""What a benchmark is: variants, what is done with their scenes, what is judged, and how.

May import: base, scene, ask.
"""

from vv.case.case import Case, Check, Parameter, Parameters, Source, Trial, Variant
from vv.case.common_quantities import Motion, largest_step, last_stable
from vv.case.judges import (
    LOOSEST,
    Exact,
    Interval,
    Invariant,
    Judge,
    Norm,
    Shown,
    Tolerance,
    judge_of,
)
from vv.case.quantity import Count, Quantity, Scalar, Series, number, size_of
from vv.case.study import Grid, Ladder, Level, Search, Study, grid, put_in, too_long

__all__ = [
    "LOOSEST",
    "Case",
    "Check",
    "Count",
    "Exact",
    "Grid",
    "Interval",
    "Invariant",
    "Judge",
    "Ladder",
    "Level",
    "Motion",
    "Norm",
    "Parameter",
    "Parameters",
    "Quantity",
    "Scalar",
    "Search",
    "Series",
    "Shown",
    "Source",
    "Study",
    "Tolerance",
    "Trial",
    "Variant",
    "grid",
    "judge_of",
    "largest_step",
    "last_stable",
    "number",
    "put_in",
    "size_of",
    "too_long",
]
