"""Statements of Yagoda-Biran and Hatzor (2016) on their benchmarks of DDA."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.published_settings import SETTINGS
from reference_solutions.blocks import elastic_block, first_motion, implicit_step, rocking
from vv.ask import Knobs
from vv.case.published import Assessment, Computed, Figure, Paper, Statement

PULSE = 2.0 * math.pi  # 1/s
REPRODUCED, DIFFERS, MISPRINT, WRONG, OPEN = Assessment


def _error(case: str, *variants: str, quantity: str = "d") -> tuple[Computed, ...]:
    """The largest error in % of the largest displacement, at the finest setting."""
    return tuple(Computed(case, v, quantity, Figure.ERROR, 100.0) for v in variants)


def _responding(*variants: str, quantity: str = "d2x") -> tuple[Computed, ...]:
    return _error("responding-block", *variants, quantity=quantity)


def _own(quantity: str, *variants: str) -> tuple[Computed, ...]:
    """A quantity in the paper's measure, at the paper's own settings and not at finer ones."""
    rungs = {v: Knobs(SETTINGS[v].steps[0], SETTINGS[v].kn) for v in variants}
    return tuple(Computed("published-settings", v, quantity, rung=rungs[v]) for v in variants)


def _agreeing(*variants: str) -> tuple[Computed, ...]:
    return tuple(Computed("failure-modes", v, "agree") for v in variants)


# A row of the table below, column by column.
def _said(
    place: str, what: str, printed: str, assessment: Assessment, why: str = "",
    computed: tuple[Computed, ...] = (), unit: str = "", exact: Callable[[], float] | str = "",
    close: float | None = None,
) -> Statement:  # fmt: skip
    return Statement(place, what, printed, assessment, why, unit, exact, computed, close)


def _damped_by(part: float) -> float:
    """The damping ratio [%] of a step that is `part` per cent of a period."""
    return 100.0 * implicit_step.damping_ratio(2.0 * math.pi * part / 100.0)


AS_IS = "largest E_N in % at the paper's settings, after 0.1 s"
OURS = "largest error in % of the largest displacement, at our settings"
STEP = (
    _said("Eq. 2", "six unknowns a block in the plane", "6", REPRODUCED, exact=lambda: 6.0),
    _said("Eq. 4", "the matrix T of first-order displacements", "", REPRODUCED,
          "derived again; a block that turns by it grows, (1 + (th/n)^2)^n in n steps of th/n"),
    _said("Eqs. 1, 3, 7, 9, 11, 13 to 16 and 18", "as printed", "", REPRODUCED,
          "definitions, or derived again"),
    _said("Eq. 6", "K^ d = f, with the f of Eq. 1", "", MISPRINT, "Eqs. 5 in Eq. 1 leave "
          "f + (2 M/D + C) d0' on the right: without it blocks would start each step from rest"),
    _said("Sec. 2", "stress and strain are uniform in a block", "", REPRODUCED,
          "by Eq. 4; therefore its first mode is too fast: shown is its frequency over that of the "
          "continuum, clamped at its base", (
              Computed("elastic-block", "ringing", "frequency-continuum"),),
          exact=lambda: elastic_block.STIFFER),
    _said("Sec. 2", "a dynamic parameter of 0.98 is a kinetic damping of", "2", REPRODUCED,
          "it is the part of the velocity that a step removes; in the same way 0.97 is 3 % "
          "(Sec. 5.1.3)", unit="%", exact=lambda: 100.0 * (1.0 - 0.98)),
    _said("Sec. 2", "the penalty method assures that blocks do not penetrate", "", WRONG,
          "a spring only acts when it is compressed: shown is the penetration of the block of "
          "Table 2 at rest, on springs of 1e9 N/m in all", unit="m",
          exact=lambda: 2.0 * 2.0 * 0.1 * 2250.0 * 9.81 / 1e9),
    _said("Eq. 5", "d'' = (2/D^2)(d - t d0')", "", MISPRINT,
          "d'' = (2/D^2)(d - D d0'): the step and not the time"),
    _said("Eq. 8", "displacement under a sine from rest at t = 0", "", MISPRINT,
          "it lacks (A/w)(cos alpha + sin alpha tan phi) t, without which the start is not at rest",
          _error("incline", "newmark-22", "newmark-30", "newmark-35")),
    _said("Eq. 10", "displacement while the yield acceleration is exceeded", "", REPRODUCED,
          "within each phase of slip", _error("incline", "newmark-30")),
    _said("Eq. 12", "d2 = mu g", "", MISPRINT, "it is the second derivative of d2"),
    _said("Eq. 17", "the second line takes the direction of d1", "", MISPRINT,
          "it is that of the acceleration of block 1, where slip begins"),
)  # fmt: skip
SLIDING = (
    _said("Fig. 2", "error of 2D-DDA at phi = 5", "0.05", DIFFERS,
          f"{OURS}; on an uncharged shear spring a block gains the speed mu g cos(alpha) "
          "sqrt(m/ks) at the start, 0.2 % at phi = 5 with a spring of 1e8 N/m; the stiffness of "
          "the paper's is not stated",
          _error("incline", "gravity-5"), "%"),
    _said("Fig. 2", "error of 2D-DDA at phi = 25", "< 8", REPRODUCED,
          f"{OURS}; it grows with phi where shear springs start uncharged",
          _error("incline", "gravity-25"), "%"),
    _said("Fig. 3", "error of 2D-DDA under the sine, most of the time", "< 1", REPRODUCED,
          f"{OURS}; A = 5 m/s2 and 1 Hz are chosen, the paper does not give them; E_N of its "
          "formulation at the 0.002 s of Sec. 5.2.2, on 1e8 N/m, is below 1 % at 73, 53 and 94 % "
          "of the outputs",
          _error("incline", "newmark-22", "newmark-30", "newmark-35"), "%"),
    _said("Fig. 12", "E_N of 3D-DDA after 0.2 s, phi 10, 20, 30", "< 1", DIFFERS,
          "at Table 1's settings the paper's formulation has 0.1, 0.4 and 1.6 %, below 1 % after "
          "0.31 s; it falls with time, and depends on shear springs, whose stiffness is not stated",
          _own("E_N", "fall-10", "fall-20", "fall-30"), "%"),
    _said("Sec. 4.1.2", "the block is thrown horizontally in the dip direction", "", WRONG,
          "a horizontal velocity leaves a plane that falls by 45 degrees; down the dip is meant"),
    _said("Fig. 13", "E_N of 3D-DDA 0.5 s after a launch", "< 1", REPRODUCED,
          "at Table 1's settings; phi = 20 is chosen, the paper does not give it",
          _own("E_N", "launch-0.01", "launch-0.1", "launch-1"), "%"),
    _said("Fig. 14", "part of the outputs with E_N below 3 % under the sine, said to be most", "",
          REPRODUCED, "after 0.2 s, at the paper's settings", _own("share", "sine")),
    _said("Sec. 4.1.3", "yield acceleration of phi = 50 on 45 degrees, which a sine of 2 m/s2 "
          "exceeds", "", REPRODUCED, "gravity alone would not move the block", unit="m/s2",
          exact=lambda: 9.81 * math.tan(math.radians(5.0))),
    _said("Sec. 5.2.2", "step of 3D-DDA on an incline", "0.0001 s", MISPRINT,
          "Table 1 has 0.001 s; 0.0001 s is said of launches and of the sine only"),
    _said("Fig. 15b", "the motion is 'along the X axis simultaneously'", "", MISPRINT,
          "along dip and strike; amplitudes and frequencies are not given"),
    _said("Fig. 15", "error of the final position under sines along dip and strike", "8", OPEN,
          f"the motion is not given; with chosen sines, {OURS}",
          _error("incline", "two-directions", quantity="distance"), "%"),
)  # fmt: skip
MODES = (
    _said("Sec. 3.2.1", "the border between toppling and sliding while it topples is dynamic "
          "(Yeung)", "", REPRODUCED, "tan(phi_c - delta) = tan(psi - delta)/4, derived again by "
          "trying all modes of contact; psi on it at phi = 20, delta = 10", unit="degrees",
          exact=lambda: first_motion.slip_joins(20.0, 10.0)),
    _said("Sec. 3.1.1", "yield acceleration of phi = 35 on 20 degrees, a_y = g tan(phi - alpha)",
          "", REPRODUCED, "down the slope; uphill the block slips below -g tan(phi + alpha), which "
          "the paper leaves out", unit="m/s2", exact=lambda: 9.81 * math.tan(math.radians(15.0))),
    _said("Sec. 3.1.1", "sliding begins at theta = asin(a_y/A)/w", "", REPRODUCED,
          "at A = 5 m/s2 and 1 Hz, which are chosen", unit="s", exact=lambda: math.asin(
              9.81 * math.tan(math.radians(15.0)) / 5.0) / PULSE),
    _said("Fig. 2", "the error grows with the friction angle", "", REPRODUCED, OURS,
          _error("incline", "gravity-5", "gravity-15", "gravity-25"), "%"),
    _said("Sec. 3.2", "with a level force the mode depends on psi = alpha + beta", "", REPRODUCED,
          "number of the 22 points of a chart that agree, on a slope of 10 "
          "degrees", _agreeing("2d-20", "2d-60")),
    _said("Sec. 3.2.2", "points of the chart where 2D-DDA agrees, of 110", "106", OPEN,
          "the points are not given; shown is how many of 22 agree, half a degree from the borders "
          "and all over the chart", _agreeing("2d-10", "2d-20", "2d-30", "2d-40", "2d-60")),
    _said("Sec. 4.3.1", "points where 3D-DDA agrees under gravity, of 51", "49", OPEN,
          "the points are not given; shown is how many of 17 agree in each variant",
          _agreeing("gravity-14", "gravity-32", "gravity-50")),
    _said("Sec. 4.3.2", "points where 3D-DDA agrees under a pseudo-static force, of 89", "89", OPEN,
          "the points are not given; shown is how many of 22 agree in each variant",
          _agreeing("3d-6", "3d-20", "3d-40", "3d-50")),
)  # fmt: skip
ROCKING = (
    _said("Sec. 3.3", "impacts of DDA's block are restrained by the damping of its step", "",
          REPRODUCED, "where w dt of the contacts is about 1, as at 1e10 N/m and 2.5e-4 s: shown "
          "is the restitution of the first impact, and Housner's; at other steps and stiffnesses "
          "it differs, and blocks may bounce", (
              Computed("rocking-restitution", "aspect-3", "restitution"),),
          exact=lambda: rocking.restitution(0.2, 0.6)),
    *(
        _said("Sec. 3.3", f"a pulse that {does} the block, as its equation for small angles has "
              f"it at g = {g:g} m/s2", printed, WRONG, f"it is {least} the threshold of that "
              "equation; shown is the largest amplitude that does not overturn the block itself",
              (Computed("rocking", "search", "threshold"),), "m/s2", functools.partial(
                  rocking.linear_threshold, b=0.2, h=0.6, g=g, w=PULSE))
        for does, printed, g, least in (("does not topple", "5.43", 9.80, "below"),
                                        ("topples", "5.44", 9.80665, "above"))
    ),
    _said("Sec. 3.3", "the least pulse that topples the block, of the equation itself", "", WRONG,
          "3.6 % above the paper's bracket", (Computed("rocking", "search", "threshold"),), "m/s2",
          functools.partial(rocking.threshold, b=0.2, h=0.6, g=9.81, w=PULSE)),
    _said("Sec. 3.3", "a penalty was found with which 2D-DDA topples from the same pulse on", "",
          REPRODUCED, "at 1e7 N/m the paper's formulation topples from 5.42 m/s2 on: soft contacts "
          "compensate the error of small angles", (
              Computed("rocking", "search-soft", "threshold"),), "m/s2"),
    _said("Sec. 3.3", "the acceleration is a_p sin(w t + psi) from t = 0 to 0.5 s", "", WRONG,
          "w = 2 pi 1/s; a half sine that starts at the phase psi ends at (pi - psi)/w, before "
          "0.5 s"),
    *(
        _said("Sec. 3.3", f"error of 2D-DDA after {after:g} s, until the first impact",
              f"< {limit:g}", OPEN, "the amplitudes of Fig. 6 and the penalty that was fitted are "
              "not given; shown is E_N at a thousandth below and above the threshold, at 1e10 N/m",
              tuple(Computed("rocking", v, f"E_N after {after:g} s")
                    for v in ("stands", "topples")),
              "%")
        for after, limit in ((0.3, 10.0), (0.5, 1.0))
    ),
    _said("Sec. 3.3", "2D-DDA deviates from the first impact on", "", REPRODUCED,
          f"three impacts after a release; {OURS}", _error("rocking", "released", quantity="x"),
          "%"),
    _said("Sec. 3.3", "error of the time to overturn, a tenth beyond the threshold", "", OPEN,
          "the paper shows it for amplitudes that it does not give",
          _error("rocking", "overturns-1e-1", quantity="time"), "%"),
)  # fmt: skip
RESPONDING = (
    _said("Sec. 4.5.1", "'similarly to Eq. (14)' the acceleration of block 2 is mu g", "", MISPRINT,
          "it is similar to Eq. 12"),
    _said("Sec. 4.5.1", "dimensions and properties of the blocks do not enter the solution", "",
          REPRODUCED, "the mass of block 2 cancels as long as it does not tip"),
    _said("Sec. 4.5.2", "block 2 is so flat that it does not turn; friction from which it tips", "",
          REPRODUCED, "its half length over its half height", exact=lambda: 2.0 / 0.1),
    _said("Sec. 4.5.2", "two seconds without motion, in which weight settles the springs", "",
          REPRODUCED, "our replica of the published scheme does so. Where the weight itself moves "
          f"a block, as it does the wedge, this starts the motion too early; of the wedge, {OURS}",
          _error("shaken-wedge", "along", quantity="s"), "%"),
    _said("Sec. 5.1.1", "the stiffness of contacts affects results; E_N at 1e7 and 1e9 N/m", "",
          REPRODUCED, AS_IS, _own("E_N", "3d-1e7", "3d-1e9"), "%"),
    _said("Sec. 3.4", "error of 2D-DDA on a shaking foundation, generally", "< 5", REPRODUCED, OURS,
          _responding("1d-mu-0.1", "1d-mu-1"), "%"),
    _said("Fig. 18", "E_N at 2 and 3 Hz, below 3 % most of the time; part of the outputs", "",
          REPRODUCED, "at the paper's settings, after 0.1 s", _own("share", "2hz", "3hz")),
    _said("Fig. 18", "E_N at 5 Hz", "< 10", REPRODUCED, AS_IS, _own("E_N", "5hz"), "%"),
    _said("Fig. 18", "E_N at 5 Hz grows with time; at the end", "", REPRODUCED, "the paper's "
          "formulation has 0.10 % at most between 0.5 and 1 s, 0.47 % between 4 and 4.5 s",
          _own("E_N at the end", "5hz"), "%"),
    _said("Fig. 19", "E_N at 0.3 m", "< 7", REPRODUCED, AS_IS, _own("E_N", "0.3m"), "%"),
    _said("Fig. 19", "E_N at 0.5 and 1 m, below 1 % most of the time; part of the outputs", "",
          REPRODUCED, "at the paper's settings, after 0.1 s", _own("share", "0.5m", "1m")),
    _said("Fig. 20", "E_N at mu = 1", "< 7", REPRODUCED, AS_IS, _own("E_N", "mu-1"), "%"),
    _said("Fig. 20", "E_N at mu = 0.6, which is 0.5 m of Fig. 19", "< 1", DIFFERS,
          f"{AS_IS}: the paper's formulation is above 1 % at one output of 490",
          _own("E_N", "0.5m"), "%"),
    _said("Fig. 20", "E_N at mu = 0.1", "< 1", REPRODUCED, AS_IS, _own("E_N", "mu-0.1"), "%"),
    _said("Fig. 21", "E_N in two directions", "< 10", REPRODUCED,
          f"{AS_IS}, of the resultant; mu = 0.6 is chosen", _own("E_N", "2d"), "%"),
    _said("Fig. 23", "E_N in three directions at 1e7 N/m, the entire analysis", "< 3", DIFFERS,
          f"{AS_IS}, of the resultant; mu = 0.6 is chosen", _own("E_N", "3d-1e7"), "%"),
    _said("Fig. 23", "E_N in three directions at 1e8 and 1e9 N/m, well", "< 10", REPRODUCED,
          f"{AS_IS}, of the resultant", _own("E_N", "3d-1e8", "3d-1e9"), "%"),
    _said("Fig. 23", "the best stiffness of contacts", "1e7", DIFFERS,
          "errors of the paper's formulation fall with the stiffness of contacts from 1e7 to 1e9 "
          "N/m; in the paper they are smallest at 1e7 "
          "N/m", _own("E_N", "3d-1e7", "3d-1e8", "3d-1e9"), "N/m"),
    _said("Sec. 4.5.5", "1e7 N/m over E L", "0.0003", OPEN, "E of Table 2 is not legible in the "
          "print that we have; with L = 2 m it would be 14 to 20 GPa"),
    _said("Sec. 4.5.5", "1e7 N/m over E A", "0.0001", REPRODUCED, "it follows from 0.0003 E L and "
          "the sides of 2 m of Sec. 4.5.2, for any E; 'not much different' is half",
          exact=lambda: 0.0003 * 2.0 / (2.0 * 2.0), close=5.001e-5),
    _said("Sec. 5.1.1", "the best stiffness is 2 to 4 orders of magnitude below E L", "", WRONG,
          "Sec. 4.5.5 has 0.0003 E L for 1e7 N/m: 1e9 to 1e7 N/m are 1.5 to 3.5 orders below"),
    _said("Sec. 4.5.1", "a script of steps of 1e-4 s gives the analytical solution", "", WRONG,
          "without located events such steps have errors of up to 3e-3, and of 8 % of y in three "
          "directions"),
)  # fmt: skip
WEDGE = (
    _said("Sec. 3.4", "the error depends on friction more than on the amplitude", "", OPEN,
          "the paper does not say which errors are "
          f"meant; {OURS}", _responding("1d-mu-0.1", "1d-mu-1")
          + _responding("1d-0.3m", "1d-1m"), "%"),
    _said("Fig. 18", "the error grows with the frequency", "", DIFFERS,
          "at the paper's settings the error of its formulation is smallest at 5 Hz",
          _own("E_N", "2hz", "3hz", "5hz"), "%"),
    _said("Fig. 21", "the deviation grows with time; at the end", "", OPEN,
          "the friction coefficient is not given; with 0.6", _own("E_N at the end", "2d"), "%"),
    _said("Sec. 4.5.5", "an upright motion of the base is equivalent to a change of g", "",
          REPRODUCED, OURS, _responding("3d", quantity="distance"), "%"),
    _said("Table 1", "contact stiffness over E L", "", REPRODUCED, "two orders below the rule of "
          "thumb E L of Sec. 5.1.1", exact=lambda: 4e8 / (40e9 * 1.0)),
    _said("Sec. 5.1.1", "the best stiffness was 1.5 and 2 orders below E L in studies of others",
          "", OPEN, "their models are not given"),
    _said("Sec. 4.4", "error for a wedge under a sine", "< 7", OPEN,
          "the angle between the sides, amplitude and frequency are not given; with chosen ones, "
          f"{OURS}", _error("shaken-wedge", "along", "level", quantity="s"), "%"),
    _said("Sec. 4.4", "the sine acts along the line of intersection", "", MISPRINT,
          "it is horizontal in Fig. 16"),
    _said("Sec. 4.4", "there is no analytical solution of a wedge that slides under a sine", "",
          WRONG, "a symmetric wedge slides like a block whose friction is 1/sin(xi/2) times as "
          "large, phase by phase", _error("shaken-wedge", "along", quantity="s")),
)  # fmt: skip
DAMPING = (
    _said("Sec. 5.1.3", "numerical damping grows with the step; its ratio over w dt/4", "",
          REPRODUCED, "from the decrement of a block that oscillates, over the closed form of the "
          "step",
          (Computed("elastic-block", "ringing", "damping"),), exact="1"),
    _said("Sec. 5.1.3", "the scheme's damping makes it of first order", "", REPRODUCED,
          "damping ratio of an oscillation at w dt = 0.005", (
              Computed("elastic-block", "ringing", "damping ratio"),),
          exact=functools.partial(implicit_step.damping_ratio, 0.005)),
    _said("Sec. 5.1.2", "for stability the step must be below h/c, by Courant, Friedrichs and Lewy",
          "", WRONG, "the step is implicit: its spectral radius is below 1 at any step; shown is "
          "the error of the radius at w dt from 4.1 to 1e4", (
              Computed("implicit-swing", "real", "radius", Figure.ERROR),), exact="any"),
    _said("Sec. 5.2.2", "without kinetic damping the step has no effect on the "
          "displacement", "", REPRODUCED,
          "1 m/s2 for 1 s, at any step", unit="m",
          exact=functools.partial(implicit_step.damped_drive, 1.0, 1e-3, 1000, 1.0)),
    _said("Sec. 5.2.2", "3 % damping and 1e-5 s make displacements several orders too small", "",
          REPRODUCED, "the right displacement over the damped one, after 1 s under a constant "
          "force",
          exact=lambda: 0.5 / implicit_step.damped_drive(1.0, 1e-5, 100000, 0.97)),
    _said("Sec. 5.2.2", "with 1 % kinetic damping displacements are still highly restrained; part "
          "of the right displacement", "", REPRODUCED, "1 m/s2 for 1 s, at 1e-5 s", unit="%",
          exact=lambda: 200.0 * implicit_step.damped_drive(1.0, 1e-5, 100000, 0.99)),
    _said("Sec. 5.2.2", "displacements fall as steps grow, by the damping of the step", "", WRONG,
          "only those of oscillations do: under a constant force the displacement of a mass is "
          "right at any step; shown for 1 m/s2 over 1 s, at 0.1 s", unit="m",
          exact=lambda: implicit_step.damped_drive(1.0, 0.1, 10, 1.0)),
    _said("Sec. 5.1.2", "steps that are too short may cause false oscillations at the front of a "
          "wave", "", OPEN, "this concerns models of others, which are not given"),
    _said("Sec. 3.5", "the blocks of DDA are not damped", "", WRONG,
          "its step damps them, as Sec. 5.1.3 says; the ratio over w dt/4",
          (Computed("elastic-block", "ringing", "damping"),), exact="1"),
    _said("Sec. 5.1.3", "2 % kinetic damping was needed for a stable solution of slopes", "", OPEN,
          "the model is not given"),
    _said("Sec. 5.2.2", "3D-DDA took steps 10 and 100 times shorter than 2D-DDA", "", OPEN,
          "this concerns models of others; our formulations need the same step in two and three "
          "directions"),
    _said("Sec. 5.2.2", "steps on an incline: 2D-DDA's of 0.002 s over 3D-DDA's of 0.0001 s", "",
          REPRODUCED, "twice, if Table 1's 0.001 s is taken for the latter",
          exact=lambda: 0.002 / 0.0001),
    _said("Sec. 5.1.3", "damping ratio of a step of 0.001 s", "2.3", WRONG,
          "it is w dt/4, so it grows with frequency: 2.3 % is true at 14.66 Hz only", unit="%",
          exact=lambda: 100.0 * implicit_step.damping_ratio(0.09213)),
    _said("Sec. 5.1.3", "it was found from the oscillations of a cantilever", "", OPEN,
          "DDA's joints bear no tension, and neither geometry nor joints are given"),
    *(
        _said("Sec. 5.1.2", f"a step of {part:g} % of the period is said to do", "", OPEN,
              "this is a rule for other schemes; shown is the damping ratio of DDA's step "
              "there", unit="%",
              exact=functools.partial(_damped_by, part))
        for part in (1.0, 5.0)
    ),
    _said("Sec. 5.1.2", "largest step over the period that avoids a bifurcation", "2/pi",
          REPRODUCED, "from w dt = 4 on the roots are real; shown is the error of the larger one, "
          "which approaches 1 again, so that stiff contacts oscillate undamped", exact="w dt = 4",
          computed=tuple(Computed("implicit-swing", v, "radius", Figure.ERROR)
                     for v in ("near-four", "real"))),
    *(
        _said("Fig. 25", "displacement of a mass under constant force with 3 % damping, dt "
              f"= {dt:g} s", "",
              REPRODUCED, "1 m/s2 for 1 s, where 0.5 m is right; the force is not given",
              unit="m", exact=functools.partial(
                  implicit_step.damped_drive, 1.0, dt, round(1.0 / dt), 0.97),
              computed=(Computed("kinetic-damping", "3-per-cent", "d", rung=Knobs(dt)),))
        for dt in (1e-2, 1e-3, 1e-4, 1e-5)
    ),
    _said("Sec. 5.2.2", "displacement with 1 % kinetic damping over that with 3 %, said to be not "
          "significantly different", "", WRONG, "it is three times as large, at 1e-5 s over 1 "
          "s", exact=lambda: (
              implicit_step.damped_drive(1.0, 1e-5, 100000, 0.99)
              / implicit_step.damped_drive(1.0, 1e-5, 100000, 0.97)),
          computed=(Computed("kinetic-damping", "1-per-cent", "d", rung=Knobs(1e-5)),
                Computed("kinetic-damping", "3-per-cent", "d", rung=Knobs(1e-5)))),
)  # fmt: skip
WAVES = (
    _said("Fig. 9", "the wave form is kept after tuning of blocks and steps", "", OPEN,
          "layers, material, amplitude and the tuned values are not given; with chosen ones, "
          f"{OURS}", _error("shear-wave", "5", "20", quantity="top")),
    _said("Sec. 3.5", "the amplitude at M1 is that of the incident wave", "", OPEN,
          "where M1 lies is drawn, not given; at a free surface it is twice the incident one"),
    _said("Fig. 10", "spectral ratios of 15 layers agree with SHAKE", "", OPEN,
          "layers and record are not given; shown are ratios of 15 equal layers over SHAKE's with "
          "2.3 % damping, at 1.5, 2.5 and 7.5 Hz", tuple(
              Computed("site-response", v, "over SHAKE's") for v in ("1.5hz", "2.5hz", "7.5hz"))),
    _said("Sec. 3.5", "they agree for layers that are not alike, too", "", OPEN,
          "neither layers nor record are given; shown is the ratio of a code over the exact answer "
          "of its own step, for 15 layers, each softer than the one "
          "below", (Computed("site-response", "unlike", "ratio"),),
          exact="1"),
    _said("Sec. 5.1.3", "amplification and resonance agree extremely well with SHAKE's at 2.3 % "
          "damping", "", OPEN, "the model is not given; codes agree with the answer of their own "
          "step at the resonance", (Computed("site-response", "2.5hz", "ratio"),), exact="1"),
)  # fmt: skip
MASONRY = (
    _said("Sec. 5.2.2", "blocks of the house at L'Aquila", "197", OPEN,
          "its geometry is drawn, not given"),
    _said("Sec. 5.2.2", "kinetic damping without which 3D-DDA did not converge", "3", OPEN,
          "this concerns the house, whose geometry is not given; open-close iterations of the "
          "published formulation leave most steps of such a house unconverged", unit="%"),
    _said("Sec. 5.2.2", "step above which 3D-DDA did not converge", "0.00001", OPEN,
          "this concerns the house, whose geometry is not given", unit="s"),
    _said("Sec. 5.2.1", "triangles that make a box", "12", REPRODUCED, exact=lambda: 2.0 * 6.0),
    _said("Sec. 6", "the size of blocks matters first of all for waves", "", REPRODUCED,
          f"with 5 and 20 layers, {OURS}", _error("shear-wave", "5", "20", quantity="top")),
    _said("Sec. 6", "DDA is proven to solve problems of rotation by rocking accurately", "", WRONG,
          "it was compared with the small-angle equation, whose threshold is 3.6 % below the "
          "block's own, with a penalty that was fitted to it"),
)  # fmt: skip
PAPER = Paper(
    "Yagoda-Biran and Hatzor (2016)",
    *YAGODA_BIRAN_2016,
    STEP + SLIDING + MODES + ROCKING + RESPONDING + WEDGE + DAMPING + WAVES + MASONRY,
)
