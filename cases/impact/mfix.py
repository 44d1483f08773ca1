"""DEM01 to DEM06 of MFiX: spheres that fall, bounce, are pressed, slip, strike glass and sink."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

from cases.impact.parts import _dem05, _mfix_scenes, _printed
from vv.ask import Displacement, History, Knobs, Method, Velocity
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Scalar,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)

KINDS: dict[str, Callable[[Parameters], _mfix_scenes.Setting]] = {
    "dem01": functools.partial(_mfix_scenes.dropped, 1),
    "dem02": functools.partial(_mfix_scenes.dropped, 5),
    "dem03": _mfix_scenes.pressed_pair,
    "dem04": _mfix_scenes.slipping,
    "dem06": _mfix_scenes.sinking,
}
OUTPUTS = 400

PRINTED: dict[str, Callable[[Parameters], tuple[Scalar, ...]]] = {
    "dem01": _printed.falls,
    "dem02-0.9": _printed.tops,
    "dem06": _printed.sinks,
}


def _declare(variant: str, p: Parameters) -> Trial:
    if variant.startswith("dem05"):
        return _dem05.trial(variant.removeprefix("dem05-"), p)
    setting = KINDS[variant.partition("-")[0]](p)
    stride = max(1, round(setting.duration / (OUTPUTS * setting.steps[0] * setting.unit)))
    interval = stride * setting.steps[0] * setting.unit
    goal = History(interval * math.floor(setting.duration / interval), interval)
    rungs = tuple(Knobs(dt=step * setting.unit) for step in setting.steps)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    seen = {
        Velocity(0)
        if name == "speed"
        else Displacement(int(name[-1]) - 1 if name != "height" else 0)
        for name, *_ in setting.series
    }
    series = tuple(
        Series(name, symbol, unit, meaning, observe, answer, _judge(setting, square))
        for (name, symbol, unit, meaning, observe, answer), square in zip(
            setting.series, setting.square, strict=True
        )
    )
    printed = PRINTED[variant](p) if variant in PRINTED else ()
    ladder = Ladder(setting.scene, goal, tuple(sorted(seen, key=str)), levels)
    return Trial(ladder, (*series, *printed))


def _judge(setting: _mfix_scenes.Setting, square: float) -> Exact:
    step, unit = setting.steps[0], setting.unit
    return Exact({
        Method.EXACT: Tolerance(1e-11, "events located to rounding, some of which depend on "
                                       "earlier ones"),
        Method.SECOND_ORDER: Tolerance(
            square * step**2,
            "an error of (w dt)^2/24 of the phase of each oscillation, and of up to (w dt)^2/8 of "
            "the speed in each contact that begins and ends within a step, which shifts all that "
            "follows; of a speed that approaches its terminal value, (q dt)^2/12 of the rate q",
            dt=step * unit, order=2,
        ),
        Method.FIRST_ORDER: Tolerance(
            square * step**2,
            "the errors of second order; besides, forces at the start, and viscous forces, act "
            "half a step late, which delays all by dt/2; a viscous force begins within a step, and "
            "so changes the speed of each bounce by up to z w dt",
            dt=step * unit, order=2, late=setting.late / unit,
            slack="no force is late where all balance at the start",
        ),
    })  # fmt: skip


FALL = "m u'' = m g - max(0, kn u + c u'), c = 2 z sqrt(kn m), while the overlap u lasts"
NOTE = (
    "The numbers are those of MFiX's own tests. Its contact may pull until the overlap ends, where "
    "contact here never pulls; with such contact the given springs have MFiX's path of DEM01 to "
    "2e-8 m and its heights of DEM02 to 0.21 %, which differ by 6.4 % from the heights of rigid "
    "contact that the manual compares them with. DEM03 is without losses here, since MFiX gives "
    "each contact a dashpot of its own, and has a tenth of MFiX's overlaps, which are a fifth of "
    "the radius. DEM04 starts in equilibrium on the normal spring, where MFiX sets the sphere down "
    "without overlap; the sphere slips until 2/7 v0/(mu g) and then rolls at 5/7 v0, apart from "
    "the oscillation of the shear spring. DEM05, whose measurements are in the case kharaz, has "
    "exact laws here and the angles that MFiX prints. DEM06 is solved in the frame of the gas, "
    "which rises at 0.4 m/s in MFiX's case. The equation that MFiX integrates for comparison has "
    "all 8 printed digits of the answer, and its particle, coupled one way, is within 0.005 % of "
    "the velocity. Coupled both ways, the particle disturbs a gas of 5 cells across by 0.6 to 5 %, "
    "which is no answer for one particle in much gas."
)
TENTH = 0.03426520412623277  # damping that leaves a restitution of 0.9 if contact never pulls
DROPPED = {"R": 0.1, "rho": 2600.0, "h": 0.5, "kn": 5e4}
GAS = ("rho_f", "viscosity")
STRUCK = {"R": 2.5e-3, "rho": 4000.0, "kn": 1.72e7, "mu": 0.092, "v": 3.9}
SMALL = {"R": 5e-4, "h": 4.95e-4, "rho": 2e4, "kn": 1e3}
CASE = Case(
    name="mfix",
    title="Verification cases DEM01 to DEM06 of MFiX",
    source=Source(
        "MFiX Software Verification and Validation Manual, DEM01 to DEM06, National Energy "
        "Technology Laboratory (Garg, Galvin, Li and Pannala 2012, Powder Technology 220, 122-137)",
        "10.1016/j.powtec.2011.09.019",
        NOTE,
    ),
    parameters=(
        Parameter("R", 0.1, "m", "radius"),
        Parameter("rho", 2600.0, "kg/m3", "density, of the lower sphere if there are two"),
        Parameter("rho2", 1e4, "kg/m3", "density of the upper sphere"),
        Parameter("h", 0.5, "m", "initial height of the centre"),
        Parameter("h2", 1.485e-3, "m", "initial height of the centre of the upper sphere"),
        Parameter("H", 1.98e-3, "m", "distance of the walls between which two spheres are pressed"),
        Parameter("kn", 1e4, "N/m", "normal stiffness, and shear stiffness where there is "
                  "friction"),
        Parameter("z", 0.0, "", "damping over critical damping"),
        Parameter("mu", 0.2, "", "friction"),
        Parameter("v", 0.1, "m/s", "speed along the wall, or in gas"),
        Parameter("g", 9.80665, "m/s2", "gravity"),
        Parameter("rho_f", 1.2, "kg/m3", "density of the gas"),
        Parameter("viscosity", 1.8e-5, "Pa s", "viscosity of the gas"),
    ),
    variants=(
        Variant(
            "dem01", "DEM01: a sphere falls on a wall and rebounds", FALL, {"z": TENTH},
            inert=frozenset({"rho2", "h2", "H", "mu", "v", *GAS}),
        ),
        Variant(
            "dem02-1", "DEM02: five bounces without losses", FALL, DROPPED,
            inert=frozenset({"rho2", "h2", "H", "mu", "v", *GAS}),
        ),
        Variant(
            "dem02-0.9", "DEM02: five bounces, restitution 0.9", FALL, {**DROPPED, "z": TENTH},
            inert=frozenset({"rho2", "h2", "H", "mu", "v", *GAS}), level=Level.DEFAULT,
        ),
        Variant(
            "dem03", "DEM03: two spheres pressed between two walls",
            "m1 y1'' = k (R - y1) - k (2 R - y2 + y1) - m1 g, "
            "m2 y2'' = k (2 R - y2 + y1) - k (R - H + y2) - m2 g", SMALL,
            inert=frozenset({"z", "mu", "v", *GAS}),
        ),
        Variant(
            "dem04", "DEM04: a sphere slips on a wall until it rolls",
            "m v' = T, T' = -ks s until |T| = mu m g, s' = 7/2 T/m",
            {"R": 5e-4, "rho": 1e4}, inert=frozenset({"rho2", "h", "h2", "H", "z", *GAS}),
        ),
        Variant(
            "dem05-linear", "DEM05: aluminium oxide strikes glass, linear springs",
            "m U'' = -kn U; T' = -ks s until |T| = mu kn U; m vt' = T, 2/5 m R^2 w' = -(R - U/2) T",
            STRUCK, inert=frozenset({"rho2", "h", "h2", "H", "z", "g", *GAS}), level=Level.DEFAULT,
        ),
        Variant(
            "dem05-hertz", "DEM05: the same by Hertz's law, and Mindlin's without micro-slip",
            "m U'' = -4/3 E sqrt(R) U^(3/2); T' = -8 G sqrt(R U) s until |T| = mu Fn; m vt' = T, "
            "2/5 m R^2 w' = -(R - U/2) T",
            STRUCK, inert=frozenset({"rho2", "h", "h2", "H", "z", "g", "kn", *GAS}),
            level=Level.DEFAULT,
        ),
        Variant(
            "dem06", "DEM06: a sphere sinks in gas and approaches its terminal velocity",
            "m v' = (1 - rho_f/rho) m g - 6 pi mu R v (1 + 0.15 Re^0.687), Re = 2 rho_f R v/mu",
            {"R": 5e-5, "rho": 2000.0, "v": 0.4},
            inert=frozenset({"rho2", "h", "h2", "H", "kn", "z", "mu"}),
        ),
    ),
    declare=_declare,
)  # fmt: skip
