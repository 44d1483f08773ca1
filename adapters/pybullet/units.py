"""The unit of length of a plan for PyBullet, whose limits of distance are fixed numbers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

Plan = dict[str, Any]
LENGTHS = ("centre", "vertices", "half", "velocity", "load")  # of the first power of a length
MOMENTS = ("inertia", "moments")


def in_units_of_blocks(plan: Plan) -> Plan:
    """The plan with lengths in the power of two next to the size of its largest block; unit [m].

    The limits in PyBullet's source suit bodies of about a metre. A power of two leaves all digits
    as they are, and blocks of 0.71 to 1.41 m in metres.
    """
    unit = 2.0 ** round(math.log2(plan["size"]))
    scaled = {
        "size": plan["size"] / unit,
        "gravity": _over(plan["gravity"], unit),
        "shaking": _sines(plan["shaking"], unit),
        "blocks": [_body(block, unit) for block in plan["blocks"]],
        "walls": [
            {**_body(wall, unit), "motion": _sines(wall["motion"], unit)} for wall in plan["walls"]
        ],
    }
    return {**plan, **scaled, "unit": unit}


def _body(body: Plan, unit: float) -> Plan:
    lengths = {name: _over(body[name], unit) for name in LENGTHS if name in body}
    moments = {name: _over(body[name], unit**2) for name in MOMENTS if name in body}
    return {**body, **lengths, **moments}


def _sines(sines: list[list[Any]], unit: float) -> list[list[Any]]:
    """Sines with amplitudes in the unit."""
    return [[_over(amplitude, unit), *rest] for amplitude, *rest in sines]


def _over(values: Any, unit: float) -> list[Any]:
    return list((np.array(values) / unit).tolist())
