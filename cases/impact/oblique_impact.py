"""Elastic spheres strike walls and each other at angles and with spins: tests 4 to 8."""

from __future__ import annotations

import math
from dataclasses import replace

from cases.impact.parts._materials import CHUNG_OOI_2011, defaults, mass, moduli
from cases.impact.parts._oblique import LEAST, Blow, Impacts, at_angles, judged
from reference_solutions.impact import hertz, spring, viscous
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
SLIPS = (0.5, 2.0, 4.0, 8.0, 16.0)  # initial slip of the surfaces over mu times the normal speed
STICKS = 4.0  # the largest of them with which a sphere comes to stick
STEPS = (100, 200, 400, 1600)  # in the duration of a normal impact
FINE = 6400  # on springs with losses too, at the finest level: dashpots leave larger errors
LARGE = 5.0  # radii of the larger of two spheres
LOSSY = 2.0  # times the tolerance without losses
ROUGH = 0.4  # friction above which the bounds grow in proportion
STRIDE, LASTS = 20, 1.1  # coarsest steps between outputs; duration over the longest contact


def _impacts(variant: str, p: Parameters) -> Impacts:
    """The impacts of a variant: spheres, contact law and starts."""
    sphere, kind = Sphere(p["R"], mass(p)), variant.partition("-")[0]
    partner = {
        "pair": Sphere(p["R"], mass(p)), "large": Sphere(LARGE * p["R"], LARGE**3 * mass(p)),
    }.get(kind, WALL)  # fmt: skip
    contact = _contact(variant, p, sphere, partner)
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


def _contact(variant: str, p: Parameters, sphere: Sphere, partner: Sphere) -> Contact:
    """The law, with the damping that leaves the restitution e along the normal.

    Linear springs yield as far as elastic spheres do without losses, with the same ratio of
    stiffnesses.
    """
    elastic = moduli(p, 1 if partner is WALL else 2)
    if not variant.endswith("linear"):
        law = replace(
            elastic,
            damping=viscous.damping(p["e"]),
            micro_slip=variant.endswith("micro-slip"),
        )
        return Contact(0.0, mu=p["mu"], hertz=law)
    reduced = Impacts(sphere, Contact(1.0), {}, partner).reduced
    radius = 1.0 / (1.0 / sphere.radius + 1.0 / partner.radius)
    factor = hertz.normal_factor(modulus=elastic.modulus, radius=radius)
    kn = reduced * (p["v"] / hertz.deepest(m=reduced, K=factor, v=p["v"])) ** 2
    slowed = 2.0 * spring.damping(p["e"]) * math.sqrt(kn * reduced)
    return Contact(kn, 4.0 * elastic.shear_modulus / elastic.modulus * kn, p["mu"], slowed)


def _declare(variant: str, p: Parameters) -> Trial:
    impacts = _impacts(variant, p)
    law, reduced = impacts.law, impacts.reduced
    linear = math.pi * math.sqrt(reduced / law.K)
    unit = linear if law.p == 1.0 else hertz.contact_time(m=reduced, K=law.K, v=p["v"])
    interval = unit / STEPS[0] * STRIDE
    goal = History(interval * math.ceil(LASTS * impacts.longest() / interval), interval)
    steps = (*STEPS, FINE) if law.z and law.p == 1.0 else STEPS
    rungs = tuple(Knobs(dt=unit / n) for n in steps)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    # friction changes the tangential velocity by mu times the normal one
    grown = max(1.0, p["mu"] / ROUGH)
    lossy = grown * (LOSSY if law.z else 1.0)
    rubbed = grown if p == CASE.defaults(variant) else max(1.0, _swung(p))
    path = judged(
        4.0 * lossy / STEPS[0] ** 2, unit, STEPS[0],
        "an error of (w dt)^2/24 of the oscillations along the normal and across it, which is up "
        "to twice as fast; and as much for each of several steps in which contact, stick or slip "
        "begins, twice as much where a viscous force ends it",
        late=LEAST * (grown - 1.0) + rubbed * (math.pi if law.p == 1.0 else 2.4) * law.z,
    )  # fmt: skip
    quantities = (impacts.worst(path), impacts.nearest(path), impacts.lasting(path))
    return Trial(Ladder(impacts.scene(), goal, impacts.seen(), levels), quantities)


def _swung(p: Parameters) -> float:
    """The error of a tangential velocity by late viscous forces, over the fraction of the mass.

    A mass that is smaller by a fraction f makes contacts shorter by f/2. A sphere that comes to
    stick oscillates across the normal with up to STICKS mu v at its surface, 2/7 of it as
    translation, by a phase of pi times the ratio of both frequencies.
    """
    softer = 2.0 * (1.0 - p["poisson"]) / (2.0 - p["poisson"])  # ks/kn
    return 2.0 / 7.0 * STICKS * p["mu"] * math.pi * math.sqrt(3.5 * softer) / 2.0


FORMULA = (
    "m U'' = -Fn, Fn = 4/3 E sqrt(R) U^(3/2); T' = -8 G sqrt(R U) s until |T| = mu Fn, s the slip "
    "in the middle of the overlap; m vt' = T, 2/5 m R^2 w' = -(R - U/2) T"
)
VISCOUS = FORMULA.replace("U^(3/2);", "U^(3/2) + 2 z sqrt(m kn) U' >= 0;", 1)
LINEAR = (
    "m U'' = -Fn, Fn = kn U + eta U' >= 0; T' = -ks s until |T| = mu Fn, s the slip in the middle "
    "of the overlap; m vt' = T, 2/5 m R^2 w' = -(R - U/2) T"
)
MICRO_SLIP = (
    "m U'' = -Fn, Fn = 4/3 E sqrt(R) U^(3/2); T = -8 G sqrt(R) int_0^sqrt(U) u dx, u' = s' once "
    "U > x^2, cut to mu E/(4 G) (U - x^2), s the slip in the middle of the overlap; "
    "m vt' = T, 2/5 m R^2 w' = -(R - U/2) T"
)
IN_PART = ("angle-alumina", "spun-alloy", "pair-alloy", "large-alloy")
SPUN = {**defaults("alloy"), "R": 0.1, "mu": 0.4, "v": 0.2}
SMALL = {"R": 1e-5, "mu": 0.3, "v": 5.0}
ELASTIC: dict[str, tuple[str, dict[str, float]]] = {
    "angle-alumina": ("test 4: aluminium oxide on a wall, 5 to 85 degrees", defaults("alumina")),
    "angle-alloy": ("test 4: aluminium alloy on a wall, 5 to 85 degrees", defaults("alloy")),
    "along-steel": (
        "test 5: steel on a wall, with tangential velocity", {**defaults("steel"), **SMALL},
    ),
    "along-polyethylene": (
        "test 5: polyethylene on a wall, with tangential velocity",
        {**defaults("polyethylene"), **SMALL},
    ),
    "spun-alloy": ("test 6: spinning aluminium alloy on a wall", SPUN),
    "pair-alloy": ("test 7: two spheres of aluminium alloy that spin alike", {**SPUN, "v": 0.4}),
    "large-alloy": ("test 8: a spinning sphere and one five times as large", SPUN),
}  # fmt: skip
LOSSES = {  # restitution in the paper
    "angle-alumina": 0.98, "angle-alloy": 0.98,
    "spun-alloy": 0.5, "pair-alloy": 0.5, "large-alloy": 0.5,
}  # fmt: skip
QUICK = ("angle-alumina", "spun-alloy", "pair-alloy", "spun-alloy-0.5", "pair-alloy-linear")
LEVELS = dict.fromkeys(QUICK, Level.QUICK)
CONVENTIONS = (
    "Codes differ in where surfaces meet: in the middle of the overlap, with arms of R - U/2; on "
    "the wall, with arms of R - U; or on the wall for slip alone. They also differ in the shear "
    "spring of a contact that unloads: by increments alone it keeps its force, with the current "
    "stiffness it loses force. Friction is limited by the whole normal force, dashpot included, "
    "which never pulls: with losses, contact ends before the overlap does. There is no viscosity "
    "across the normal. The paper has a restitution of 0.98 in test 4 and 0.5 in tests 6 to 8, as "
    "have the variants with these numbers and those on springs; the others have 1, which shows the "
    "contact law alone. Test 5 has spheres of 10 um. The slips of tests 5 to 8, the size of the "
    "larger sphere and all springs are chosen."
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
        Parameter("e", 1.0, "", "restitution along the normal"),
    ),
    variants=(
        *(
            Variant(name, meaning, FORMULA, values, level=LEVELS.get(name, Level.DEFAULT))
            for name, (meaning, values) in ELASTIC.items()
        ),
        *(
            Variant(
                f"{name}-{LOSSES[name]:g}", f"{meaning}, restitution {LOSSES[name]:g}", VISCOUS,
                {**values, "e": LOSSES[name]},
                level=LEVELS.get(f"{name}-{LOSSES[name]:g}", Level.DEFAULT),
            )
            for name, (meaning, values) in ELASTIC.items()
            if name in LOSSES
        ),
        *(
            Variant(
                f"{name}-linear", f"{meaning}, on springs", LINEAR,
                {**values, "e": LOSSES.get(name, 1.0)},
                level=LEVELS.get(f"{name}-linear", Level.DEFAULT),
            )
            for name, (meaning, values) in ELASTIC.items()
        ),
        *(
            Variant(
                f"{name}-micro-slip", f"{ELASTIC[name][0]}, with micro-slip", MICRO_SLIP,
                ELASTIC[name][1], level=LEVELS.get(f"{name}-micro-slip", Level.DEFAULT),
            )
            for name in IN_PART
        ),
    ),
    declare=_declare,
)  # fmt: skip
