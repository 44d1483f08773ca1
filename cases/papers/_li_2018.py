"""Statements of Li et al. (2018) on their four single-contact tests."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, exp, pi
from typing import Any

import numpy as np

from cases._papers import LI_2018
from reference_solutions.contact import single_contact
from vv.ask import Knobs
from vv.case.published import Assessment, Computed, Figure, Paper, Statement

ROCK: dict[str, float] = {"rho": 2500.0, "r": 50.0, "kn": 5.5e9}  # Table 1
ETA = 3e8  # N s/m
PRESSED: dict[str, Any] = {**ROCK, "ks": 5.5e9, "mu": 0.1, "eta": ETA, "v_b": 1.0}
M = single_contact.mass(ROCK["rho"], ROCK["r"])
T1 = single_contact.separation(**ROCK, eta=0.0, v_a=-0.1)
T2 = single_contact.separation(**ROCK, eta=ETA, v_a=-0.1)
T3, T4 = single_contact.t3_slip(**PRESSED), single_contact.t4_slip(**PRESSED)
K, N = (ROCK["kn"] / M) ** 0.5, ETA / (2.0 * M)
WD = (K * K - N * N) ** 0.5
C1 = T3.v + T3.a * T3.begin
C3 = -(T4.v + T4.a / (2 * N)) / (2 * N) * exp(2 * N * T4.begin)
C4 = T4.y1 + T4.a / (2 * N) * T4.begin - C3 * exp(-2 * N * T4.begin)
ROUNDED = "only the last digit differs, since it follows from rounded values before it"


def _number(
    place: str, what: str, printed: str, unit: str, exact: Callable[[], float], why: str = ""
) -> Statement:
    """A number that is printed correctly or, with `why`, a misprint."""
    assessment = Assessment.MISPRINT if why else Assessment.REPRODUCED
    return Statement(place, what, printed, assessment, why, unit, exact)


def _worst(variant: str) -> Computed:
    """The largest error of a test at the paper's step, over its largest displacement, in %."""
    return Computed("single-contact", variant, "y", Figure.ERROR, 100.0, Knobs(1e-3))


def _left_of_error() -> float:
    """T4's error at the end over its largest, by Eqs. 4 to 12 at the paper's step."""
    y, v, shear, dt = [0.0], PRESSED["v_b"], 0.0, 1e-3
    limit = PRESSED["mu"] * ROCK["kn"] * single_contact.overlap(**PRESSED)
    for _ in range(400):
        v += (shear - ETA * v) / M * dt
        y.append(y[-1] + v * dt)
        shear = float(np.clip(shear - PRESSED["ks"] * v * dt, -limit, limit))
    error = np.abs(np.array(y) - single_contact.t4(dt * np.arange(401), **PRESSED))
    return float(error[-1] / error.max())


def _said(
    place: str,
    what: str,
    assessment: Assessment,
    why: str = "",
    computed: tuple[Computed, ...] = (),
) -> Statement:
    return Statement(place, what, "", assessment, why, computed=computed)


NUMBERS = (
    _number("Eq. 24", "mass m, a metre thick", "2.1651e7", "kg", lambda: M),
    _number("Eq. 25", "n = eta/(2m)", "6.9281", "1/s", lambda: N, ROUNDED),
    _number("Eq. 26", "k = sqrt(kn/m)", "15.9383", "1/s", lambda: K, ROUNDED),
    _number(
        "Eq. 27", "initial velocity of T1 and T2", "-0.0100", "m/s", lambda: -0.1,
        "Eqs. 29 and 31 and the text before Fig. 3 need -0.1",
    ),
    _number("Eq. 28", "t_n1, where T1's contact ends", "0.1971", "s", lambda: T1.t),
    _number("Eq. 29", "v_n1, velocity after T1's contact", "0.1000", "m/s", lambda: T1.v),
    _number("Eq. 30", "t_n2, where T2's contact ends", "0.2189", "s", lambda: T2.t),
    _number("Eq. 31", "v_n2, velocity after T2's contact", "0.0220", "m/s", lambda: T2.v),
    _number("Eq. 32", "initial velocity of T3 and T4", "1.0000", "m/s", lambda: PRESSED["v_b"]),
    _number(
        "Eq. 33", "overlap dx with the wall", "0.2206", "m",
        lambda: single_contact.overlap(**PRESSED),
    ),
    _number("Eq. 34", "y_1, where T3 begins to slip", "0.0221", "m", lambda: T3.y1),
    _number("Eq. 35", "t_s1, when T3 begins to slip", "0.0224", "s", lambda: T3.begin,
            "it belongs to a y_1 of 0.02196 m, as v_s1 does, and not to that of Eq. 34"),
    _number("Eq. 36", "v_s1, T3's velocity then", "0.9367", "m/s", lambda: T3.v,
            "it is cos(k t_s1) at 0.02244 s, the value behind Eq. 35"),
    _number("Eq. 37", "a, T3's deceleration in slip", "5.6033", "m/s2", lambda: T3.a),
    _number("Eq. 38", "t_s4, when T3's slip ends", "0.1896", "s", lambda: T3.end),
    _number("Eq. 39", "y_4, where T3's slip ends", "0.1003", "m", lambda: T3.y1 + T3.distance),
    _number("Eq. 40", "C_1", "1.0625", "m/s", lambda: C1),
    _number("Eq. 41", "C_2", "-0.0005", "m",
            lambda: T3.y1 + T3.a * T3.begin**2 / 2 - C1 * T3.begin),
    _number("Eq. 42", "b, how far T3 slips", "0.0782", "m", lambda: T3.distance),
    _number("Eq. 43", "y_2, where T4 begins to slip", "0.0221", "m", lambda: T4.y1),
    _number("Eq. 44", "t_s2, when T4 begins to slip", "0.0274", "s", lambda: T4.begin),
    _number("Eq. 45", "v_s2, T4's velocity then", "0.6115", "m/s", lambda: T4.v),
    _number("Eq. 46", "t_s3, when T4's slip ends", "0.0938", "s", lambda: T4.end),
    _number("Eq. 47", "y_3, where T4's slip ends", "0.0393", "m", lambda: T4.y1 + T4.distance),
    _number("Eq. 48", "C_3", "-0.1071", "m", lambda: C3),
    _number("Eq. 49", "C_4", "0.1064", "m", lambda: C4),
    _number("Eq. 50", "c, T4's deceleration by friction", "5.6033", "m/s2", lambda: T4.a),
    _number("Eq. 51", "d, how far T4 slips", "0.0173", "m", lambda: T4.distance),
    _number(
        "Shear Contact Force", "wd t at which T4 begins to slip, over pi", "0.125", "",
        lambda: WD * T4.begin / pi,
    ),
)  # fmt: skip
CLAIMS = (
    _said("Eq. 3", "distance of two centres, sqrt((x_a^2 - x_o^2) - (y_a^2 - y_o^2))",
          Assessment.MISPRINT, "it is sqrt((x_a - x_o)^2 + (y_a - y_o)^2)"),
    _said("Eq. 8", "the shear force is capped where it exceeds its largest value",
          Assessment.MISPRINT, "its size is to be capped and its sign kept; T1 to T4 do not show "
          "that a negative force is not capped, T3 and T4 mirrored do",
          (_worst("T3-mirrored"), _worst("T4-mirrored"))),
    _said("Below Eq. 8", "(F_n, F_s) is the force by which a acts on o", Assessment.MISPRINT,
          "along n and t of Eqs. 1, 2 and 6 it is that by which o acts on a: a repulsion that is "
          "positive along n, from o to a, moves a away; Eq. 9 needs the opposite"),
    _said("Eqs. 9 and 11", "velocities with the sign of the current step", Assessment.MISPRINT,
          "drag and the update take the mean velocity of the step before"),
    _said("Eq. 29", "v_n1 = v_ay", Assessment.MISPRINT, "v_n1 = -v_ay: the rebound turns the sign"),
    _said("The Normal Contact Force", "Eq. 14 begins from Eq. 15 and Eq. 16 from Eq. 17",
          Assessment.MISPRINT, "the later stages, Eqs. 15 and 17, begin where Eqs. 14 and 16 end"),
    _said("Shear Contact Force", "particle 2 moves along wall 1, the overlap is that of these two",
          Assessment.MISPRINT, "they are particle 4 and wall 3"),
    _said("Shear Contact Force", "y_2 = e^(-n t_s2) sin(wd t_s2)", Assessment.MISPRINT,
          "it lacks the factor v_by/wd of Eq. 13; and t_2 stands for t_s2 twice"),
    _said("Shear Contact Force", "'as with T2', T4 slides in its second stage", Assessment.MISPRINT,
          "as with T3: nothing slides in T2"),
    _said("Note below Eq. 23", "v_n1 and v_n2 are among the values of Eqs. 18 to 23",
          Assessment.MISPRINT, "v_s1 and v_s2 are, and a, b, c and d besides"),
    Statement("Shear Contact Force", "in its third stage T3 moves as in its first, about b", "",
              Assessment.REPRODUCED, "it oscillates with the amplitude y_1, and so returns to the "
              "limit of friction at 0.3867 s without slip: see the case "
              "`grazing`", "m", lambda: T3.y1, (_worst("T3"),)),
    _said("Shear Contact Force", "no movement in the x direction and no rotation",
          Assessment.REPRODUCED, "the scenes lock both; only its overlap presses particle 4 on its "
          "wall", (_worst("T3"), _worst("T4"))),
    _said("Figs. 3 and 5", "VBOX and PFC2D follow the analytical curves at dt = 1e-3 s",
          Assessment.REPRODUCED, "largest error in % of the largest displacement",
          tuple(map(_worst, ("T1", "T2", "T3", "T4")))),
    _said("Figs. 4 and 6", "the relative error grows as viscosity is introduced",
          Assessment.REPRODUCED, "by a factor of some 300 to 600 with the published scheme, whose "
          "drag is first order in the step; where drag is of second order T4's error is below T3's",
          tuple(map(_worst, ("T1", "T2", "T3", "T4")))),
    _said("Figs. 4 and 6", "the curves of the relative errors", Assessment.OPEN,
          "the error at a point over the displacement there has no bound where y crosses 0, as in "
          "T2 at 0.219 s; no number is printed"),
    _said("Shear Contact Force", "shear forces are less exact than normal ones, since increments "
          "accumulate error", Assessment.WRONG,
          "while it sticks, T3 follows the same recursion as T1 in contact, to the last bit apart "
          "from a factor; the steps in which slip begins or ends are less exact",
          (_worst("T1"), _worst("T3"))),
    _said("Figs. 3 and 5", "VBOX and PFC2D agree completely", Assessment.OPEN,
          "their results are drawn and not printed; both use Eqs. 4 to 12"),
    Statement("The Normal Contact Force", "T1 turns back as t approaches", "0.1",
              Assessment.REPRODUCED, unit="s", exact=lambda: pi / (2 * K)),
    Statement("The Normal Contact Force", "T2 comes to rest in the end", "", Assessment.REPRODUCED,
              "v_n2/(2n) from where its contact ends", "m", lambda: T2.v / (2 * N)),
    Statement("The Normal Contact Force", "viscosity reduces the extent of motion", "",
              Assessment.REPRODUCED,
              "how deep T2 goes, at wd t = atan(wd/n); T1 goes 6.27e-3 m", "m",
              lambda: 0.1 / K * exp(-N / WD * atan2(WD, N))),
    Statement("Shear Contact Force", "viscosity reduces the extent of motion", "",
              Assessment.REPRODUCED, "where T4 turns; T3 turns at y_4 = 0.1003 m", "m",
              lambda: T4.y1 + T4.distance),
    _said("Eqs. 1, 2, 4 to 7, 10 and 12", "as printed", Assessment.REPRODUCED,
          "derived again; our scheme `published` steps by them", tuple(
              map(_worst, ("T1", "T3")))),
    _said("Eqs. 13 to 23", "as printed but for names and order", Assessment.REPRODUCED,
          "solved phase by phase and by a second route", tuple(map(_worst, ("T2", "T4")))),
    _said("Shear Contact Force", "errors of T3 and T4 are greater than those of T1 and T2",
          Assessment.REPRODUCED, "of T3 than of T1 and of T4 than of T2 with the published scheme; "
          "but T2 errs more than T3", tuple(map(_worst, ("T1", "T2", "T3", "T4")))),
    Statement("Shear Contact Force", "the error is greater with greater time", "",
              Assessment.DIFFERS, "by Eqs. 4 to 12 at 1e-3 s T3's error grows until 0.3 s and T4's "
              "until 0.2 s, then both fall: T4's at the end over its largest", "", _left_of_error),
    _said("Table 1", "density, radius, stiffnesses, friction, viscosity and step",
          Assessment.REPRODUCED, "all cases of this paper use them as printed; r is 50 m"),
    _said("Introduction", "PFC2D and another code of its kind agree on problems of one and "
          "two particles (Chen and others)", Assessment.OPEN,
          "this is a statement of another paper; shown are T1 and T3 in all "
          "codes", (_worst("T1"), _worst("T3"))),
)  # fmt: skip
PAPER = Paper("Li et al. (2018)", *LI_2018, NUMBERS + CLAIMS)
