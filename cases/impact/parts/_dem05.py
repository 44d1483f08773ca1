"""DEM05 of MFiX: impacts at its angles, judged by exact answers, and the numbers that it prints."""

from __future__ import annotations

import math

from cases.impact import kharaz
from cases.impact.parts import _printed
from cases.impact.parts._oblique import Impacts, at_angles
from reference_solutions.impact.rebound import Sphere
from vv.case import Parameters, Trial

ACROSS = 1.48 / 1.72  # ks over kn


def trial(law: str, p: Parameters) -> Trial:
    """A sphere strikes a wall at each angle."""
    sphere = Sphere(p["R"], p["rho"] * 4.0 / 3.0 * math.pi * p["R"] ** 3)
    impacts = Impacts(
        sphere,
        kharaz.contact(law, {**p, "ks": ACROSS * p["kn"]}),
        at_angles(p["v"], iter(_printed.KEPT[law])),
    )
    ladder, exact = kharaz.struck(impacts, p["v"])
    return Trial(ladder, (*exact, *_printed.kept(law, impacts)))
