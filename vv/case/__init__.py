"""The classes that declare a benchmark: cases, variants, studies, quantities, judges.

May import: base, scene, ask.
"""

from vv.case.case import (
    Case,
    Check,
    EnergyAllowance,
    Parameters,
    Source,
    Trial,
    Variant,
)
from vv.case.code_to_code import CodeToCode, Printed
from vv.case.common_quantities import Motion, largest_step, last_stable_step
from vv.case.judges import (
    LARGEST_TOLERANCE,
    Exact,
    Interval,
    Invariant,
    Judge,
    Norm,
    Shown,
    Tolerance,
    judge_at_other_parameters,
    judge_for_method,
)
from vv.case.measured import Measured, Measurement
from vv.case.motion_readers import ComponentAlong, RotationAbout
from vv.case.parameter import Parameter, Sign
from vv.case.quantity import Count, Quantity, Scalar, Series, at_rest, error_scale, evaluated
from vv.case.region_map import RegionMap
from vv.case.remembered import remembered
from vv.case.study import (
    Grid,
    Ladder,
    Level,
    Search,
    Study,
    has_setting,
    knob_grid,
    knobs_in_scene,
    settings_of,
    why_too_long,
)
from vv.case.wide_bounds import NOTHING, shown_if_wide

__all__ = [
    "LARGEST_TOLERANCE",
    "NOTHING",
    "Case",
    "Check",
    "CodeToCode",
    "ComponentAlong",
    "Count",
    "EnergyAllowance",
    "Exact",
    "Grid",
    "Interval",
    "Invariant",
    "Judge",
    "Ladder",
    "Level",
    "Measured",
    "Measurement",
    "Motion",
    "Norm",
    "Parameter",
    "Parameters",
    "Printed",
    "Quantity",
    "RegionMap",
    "RotationAbout",
    "Scalar",
    "Search",
    "Series",
    "Shown",
    "Sign",
    "Source",
    "Study",
    "Tolerance",
    "Trial",
    "Variant",
    "at_rest",
    "error_scale",
    "evaluated",
    "has_setting",
    "judge_at_other_parameters",
    "judge_for_method",
    "knob_grid",
    "knobs_in_scene",
    "largest_step",
    "last_stable_step",
    "remembered",
    "settings_of",
    "shown_if_wide",
    "why_too_long",
]
