"""Elastic spheres strike walls and each other at angles and with spins: tests 4 to 8."""

from __future__ import annotations

import math

from cases.impact._materials import CHUNG_OOI_2011, defaults, mass, moduli
from cases.impact._oblique import Blow, Impacts, at_angles, judged
from reference_solutions.impact import hertz
from reference_solutions.impact.rebound import WALL, Sphere
from vv.ask import History, Knobs
from vv.case import (
    Case,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Source,
    Trial,
    Variant,
)
from vv.scene import Contact

DEGREES = (5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 85.0)
SLIPS = (0.5, 2.0, 4.0, 8.0, 16.0)  # of the surfaces at first, over mu times the normal speed
STEPS = (100, 200, 400, 1600)  # in the duration of a normal impact
LARGE = 5.0  # radii of the larger of two spheres
STRIDE, LASTS = 20, 1.1  # coarsest steps between outputs; duration over the longest contact


def _impacts(variant: str, p: Parameters) -> Impacts:
    """What strikes what, and how."""
    sphere, kind = Sphere(p["R"], mass(p)), variant.partition("-")[0]
    partner = {
        "pair": Sphere(p["R"], mass(p)), "large": Sphere(LARGE * p["R"], LARGE**3 * mass(p)),
    }.get(kind, WALL)  # fmt: skip
    contact = Contact(0.0, mu=p["mu"], hertz=moduli(p, 1 if partner is WALL else 2))
    slips = {f"{slip:g}": slip * p["mu"] * p["v"] for slip in SLIPS}
    blows = {
        "angle": at_angles(p["v"], iter(DEGREES)),
        "along": {name: Blow(p["v"], vt=slip) for name, slip in slips.items()},
        "spun": {name: Blow(p["v"], spin=-slip / p["R"]) for name, slip in slips.items()},
        "pair": {
            name: Blow(p["v"], spin=-0.5 * slip / p["R"], partner_spin=-0.5 * slip / p["R"])
            for name, slip in slips.items()
        },
    }
    return Impacts(sphere, contact, blows[{"large": "spun"}.get(kind, kind)], partner)


def _declare(variant: str, p: Parameters) -> Trial:
    impacts = _impacts(variant, p)
    law = impacts.law
    unit = hertz.lasting(m=impacts.reduced, K=law.K, v=p["v"])
    interval = unit / STEPS[0] * STRIDE
    goal = History(interval * math.ceil(LASTS * impacts.longest() / interval), interval)
    rungs = tuple(Knobs(dt=unit / n) for n in STEPS)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    path = judged(
        4.0 / STEPS[0] ** 2, unit, STEPS[0],
        "(w dt)^2/24 of the swings along the normal and across it, which is up to twice as quick, "
        "and as much where contact, stick or slip begins within a step, of which there are several",
    )  # fmt: skip
    quantities = (impacts.worst(path), impacts.nearest(path), impacts.lasting(path))
    return Trial(Ladder(impacts.scene(), goal, impacts.seen(), levels), quantities)


FORMULA = (
    "m U'' = -Fn, Fn = 4/3 E sqrt(R) U^(3/2); T' = -8 G sqrt(R U) s until |T| = mu Fn, s the slip "
    "in the middle of the overlap; m vt' = T, 2/5 m R^2 w' = -(R - U/2) T"
)
CONVENTIONS = (
    "Codes differ in where surfaces meet: in the middle of the overlap, so that arms are R - U/2, "
    "or on the wall, R - U, or there for slip alone. And in what unloading does to a shear spring: "
    "with increments alone it keeps its force, with a spring of today's stiffness it gives way. "
    "Contact ends with the overlap, and friction is limited by the whole normal force. Restitution "
    "is 1 here, where the paper has 0.98 and 0.5; test 5 has spheres of 10 um. The slips of tests "
    "5 to 8 and the size of the larger sphere are chosen."
)
CASE = Case(
    name="oblique-impact",
    title="Elastic spheres strike walls and each other obliquely",
    source=Source(CHUNG_OOI_2011.citation, CHUNG_OOI_2011.doi, CONVENTIONS),
    parameters=(
        Parameter("young", 380e9, "Pa", "Young's modulus of the spheres"),
        Parameter("poisson", 0.23, "", "Poisson's ratio of the spheres"),
        Parameter("rho", 4000.0, "kg/m3", "density of the spheres"),
        Parameter("R", 0.0025, "m", "radius of the sphere"),
        Parameter("mu", 0.092, "", "friction"),
        Parameter("v", 3.9, "m/s", "speed of the sphere; in all but `angle`, along the normal"),
    ),
    variants=(
        Variant(
            "angle-alumina", "test 4: aluminium oxide on a wall, 5 to 85 degrees", FORMULA,
            defaults("alumina"),
        ),
        Variant(
            "angle-alloy", "test 4: aluminium alloy on a wall, 5 to 85 degrees", FORMULA,
            defaults("alloy"), level=Level.DEFAULT,
        ),
        Variant(
            "along-steel", "test 5: steel on a wall, moving along it too", FORMULA,
            {**defaults("steel"), "R": 1e-5, "mu": 0.3, "v": 5.0}, level=Level.DEFAULT,
        ),
        Variant(
            "along-polyethylene", "test 5: polyethylene on a wall, moving along it too", FORMULA,
            {**defaults("polyethylene"), "R": 1e-5, "mu": 0.3, "v": 5.0}, level=Level.DEFAULT,
        ),
        Variant(
            "spun-alloy", "test 6: spinning aluminium alloy on a wall", FORMULA,
            {**defaults("alloy"), "R": 0.1, "mu": 0.4, "v": 0.2},
        ),
        Variant(
            "pair-alloy", "test 7: two spheres of aluminium alloy that spin alike", FORMULA,
            {**defaults("alloy"), "R": 0.1, "mu": 0.4, "v": 0.4},
        ),
        Variant(
            "large-alloy", "test 8: a spinning sphere and one five times as large", FORMULA,
            {**defaults("alloy"), "R": 0.1, "mu": 0.4, "v": 0.2}, level=Level.DEFAULT,
        ),
    ),
    declare=_declare,
)  # fmt: skip
