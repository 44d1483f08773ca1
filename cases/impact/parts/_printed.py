"""The numbers that MFiX prints for its cases DEM01, DEM02, DEM05 and DEM06.

They are answers of another code with a contact law of its own, not exact answers: a code that
agrees with them does the same. Tests compare them with the exact answers of MFiX's law.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from cases.impact.parts._oblique import Impacts
from vv.ask import Displacement, Run, Velocity
from vv.case import CodeToCode, Parameters, Printed, Scalar
from vv.scene import Vector

FALLS = {  # time [s]: height of the centre [m]
    0.28607148: 0.09872776, 0.31541214: 0.02559695, 0.34621984: 0.00307841,
    0.37556050: 0.04630117, 0.40490117: 0.11820900, 0.49585723: 0.29614061,
}  # fmt: skip
TOPS = 0.41930671, 0.35478084, 0.30210579, 0.26026070, 0.22626641  # m, after each bounce
SINKS = {  # time [s]: velocity upwards in the frame in which the gas rises at 0.4 m/s
    0.01: -0.01255313, 0.05: -0.04078975, 0.1: -0.05263160, 0.2: -0.05701005,
}  # fmt: skip
KEPT = {  # law: {angle of impact [degrees]: tangential restitution}
    "linear": {
        2.5: 0.8469, 5.0: 0.7981, 10.0: 0.6556, 15.0: 0.5971, 20.0: 0.5946, 30.0: 0.6813,
    },
    "hertz": {5.0: 0.9400, 10.0: 0.6903, 15.0: 0.6236, 20.0: 0.6150, 30.0: 0.6813, 45.0: 0.8160},
}  # fmt: skip
FROM = {"linear": 25.0, "hertz": 25.0}  # angle [degrees] from which all contacts slip, by any law
CLOSE = 3e-3  # of the value
SOURCE = "MFiX's verification tests {}, what the code computes"
PULLS = (
    "MFiX's contact may pull until the overlap ends, with the same restitution: the exact answer "
    "here is within 0.3 % of the heights that it prints, and within 0.12 mm in the impact; steps "
    "of every size are shown"
)
SAME = "the drag is the same, coupled one way; only MFiX's step differs, by 0.005 % of the velocity"
SPRUNG = {
    "linear": "the contact slips all the time, so that only friction matters; MFiX's step is a "
    "71st of the contact",
    "hertz": "the contact slips all the time, so that only friction matters",
}
OTHERWISE = {
    "linear": "the contact sticks for a part of the time. MFiX's Adams-Bashforth rule at a 71st of "
    "the contact has errors of up to 1.6 %, at 10 degrees, which that rule stepped by itself has "
    "to the last digit; its arms are R - U",
    "hertz": "the contact sticks for a part of the time; MFiX's shear spring has the current "
    "stiffness, so that it loses force as the contact opens, and its arms are R - U",
}


def falls(p: Parameters) -> tuple[Scalar, ...]:
    """Heights of a sphere that falls and rebounds, at the times of the print."""
    return tuple(
        _shown(
            f"at {when:g}", "h", "m", f"height of the centre at {when:g} s",
            partial(_height_at, when, p["h"]),
            Printed(height, 5e-9, "MFiX DEM01 (contact may pull)", SOURCE.format("DEM01")),
        )
        for when, height in FALLS.items()
    )  # fmt: skip


def tops(p: Parameters) -> tuple[Scalar, ...]:
    """Heights that a bouncing sphere reaches after each bounce."""
    return tuple(
        _shown(
            f"top {k + 1}", "h", "m", f"largest height of the centre after bounce {k + 1}",
            partial(_top, k, p["h"]),
            Printed(height, 5e-9, "MFiX DEM02 (contact may pull)", SOURCE.format("DEM02")),
        )
        for k, height in enumerate(TOPS)
    )  # fmt: skip


def sinks(p: Parameters) -> tuple[Scalar, ...]:
    """Velocities of a sphere that sinks in gas, in the frame in which the gas rises."""
    return tuple(
        Scalar(
            f"at {when:g}", "v", "m/s", f"upward velocity at {when:g} s, in the frame in which the "
            "gas rises",
            partial(_speed_at, when, p["v"]),
            None, 1.0,
            CodeToCode(
                Printed(speed, 5e-9, "MFiX DEM06 (coupled one way)", SOURCE.format("DEM06")),
                CLOSE * abs(speed), SAME,
            ),
        )
        for when, speed in SINKS.items()
    )  # fmt: skip


def kept(law: str, impacts: Impacts) -> tuple[Scalar, ...]:
    """Tangential restitutions at the angles of the print."""
    return tuple(
        Scalar(
            f"kept-{angle:g}", "et", "", f"tangential restitution at {angle:g} degrees",
            partial(_kept, impacts, f"{angle:g}"),
            None, 1.0,
            CodeToCode(
                Printed(
                    value, 5e-5, "MFiX DEM05", SOURCE.format("DEM05")
                ),
                *((CLOSE * value, SPRUNG[law]) if angle > FROM[law] else (None, OTHERWISE[law])),
            ),
        )
        for angle, value in KEPT[law].items()
    )  # fmt: skip


def _shown(
    name: str, symbol: str, unit: str, meaning: str,
    observe: Callable[[Run], float], printed: Printed,
) -> Scalar:  # fmt: skip
    judge = CodeToCode(printed, None, PULLS)
    return Scalar(name, symbol, unit, meaning, observe, None, 1.0, judge)


def _height_at(when: float, start: float, run: Run) -> float:
    return start + _between(run.times, _risen(run), when)


def _top(number: int, start: float, run: Run) -> float:
    return start + _tops(_risen(run))[number]


def _speed_at(when: float, wind: float, run: Run) -> float:
    return wind + _between(run.times, run.values[Velocity(0)][:, 2], when)


def _kept(impacts: Impacts, name: str, run: Run) -> float:
    return float(impacts.seen_after(name, run)[1] / impacts.blows[name].vt)


def _risen(run: Run) -> Vector:
    return np.asarray(run.values[Displacement(0)][:, 2])


def _between(times: Vector, rows: Vector, when: float) -> float:
    """Rows at a time between outputs, by the cubic through the four outputs around it."""
    first = int(np.clip(np.searchsorted(times, when) - 2, 0, len(times) - 4))
    near, value = times[first : first + 4], rows[first : first + 4]
    weights = [
        math.prod((when - other) / (one - other) for other in near if other != one) for one in near
    ]
    return float(weights @ value)


def _tops(rows: Sequence[float] | Vector) -> list[float]:
    """Tops of flights, by the parabola through three outputs: the last may lie beyond the end."""
    inner = [i for i in range(1, len(rows) - 1) if rows[i - 1] < rows[i] >= rows[i + 1]]
    if len(inner) < len(TOPS):
        inner.append(len(rows) - 2)
    return [_vertex(*rows[i - 1 : i + 2]) for i in inner]


def _vertex(before: float, at: float, after: float) -> float:
    bend = before - 2.0 * at + after
    return float(at - 0.125 * (after - before) ** 2 / bend)
