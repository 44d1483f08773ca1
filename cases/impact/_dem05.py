"""DEM05 of MFiX: impacts at its angles, by laws that are exact here, beside what MFiX prints."""

from __future__ import annotations

import math

from cases.impact import _printed
from cases.impact._oblique import Impacts, at_angles, judged
from cases.impact.kharaz import ALUMINA, GLASS
from reference_solutions.impact import hertz
from reference_solutions.impact.rebound import Sphere
from vv.ask import History, Knobs
from vv.case import Ladder, Level, Parameters, Trial
from vv.scene import Contact, Hertz

ACROSS = 1.48 / 1.72  # ks over kn
STEPS = (100, 200, 400, 1600)  # in the duration of a normal impact
STRIDE, LASTS = 20, 1.1  # coarsest steps between outputs; duration over the longest contact


def contact(law: str, p: Parameters) -> Contact:
    """Linear springs, or the moduli of aluminium oxide and glass together."""
    if law == "linear":
        return Contact(p["kn"], ACROSS * p["kn"], p["mu"])
    normal, shear = (
        1.0 / sum(1.0 / of(*stuff) for stuff in (ALUMINA, GLASS))
        for of in (hertz.effective_modulus, hertz.effective_shear_modulus)
    )
    return Contact(0.0, mu=p["mu"], hertz=Hertz(normal, shear))


def struck(law: str, p: Parameters) -> Trial:
    """A sphere strikes a wall at each angle."""
    sphere = Sphere(p["R"], p["rho"] * 4.0 / 3.0 * math.pi * p["R"] ** 3)
    impacts = Impacts(sphere, contact(law, p), at_angles(p["v"], iter(_printed.KEPT[law])))
    known = impacts.law
    unit = (
        math.pi * math.sqrt(sphere.mass / known.K)
        if known.p == 1.0
        else hertz.lasting(m=sphere.mass, K=known.K, v=p["v"])
    )
    interval = unit / STEPS[0] * STRIDE
    goal = History(interval * math.ceil(LASTS * impacts.longest() / interval), interval)
    rungs = tuple(Knobs(dt=unit / n) for n in STEPS)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    path = judged(
        1.0 / STEPS[0] ** 2, unit, STEPS[0],
        "(w dt)^2/24 of the swings along the normal and across it, which is up to twice as quick, "
        "and as much where contact, stick or slip begins and ends within a step",
    )  # fmt: skip
    exact = impacts.worst(path), impacts.nearest(path), impacts.lasting(path)
    ladder = Ladder(impacts.scene(), goal, impacts.seen(), levels)
    return Trial(ladder, (*exact, *_printed.kept(law, impacts)))
