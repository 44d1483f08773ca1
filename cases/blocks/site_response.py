"""The steady motion of the top of elastic layers, over that of the shaking base."""

from __future__ import annotations

import functools

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.shear_wave import X, column, soil, speed
from reference_solutions.blocks import shear_wave
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)

LAYERS = {"five-layers": 5}
MANY, UNLIKE = 15, "unlike"
FINEST = 8e-3  # s, of the steps
LASTING = 0.7  # of the duration: motion after that counts as steady
LEFT = 0.02  # of the free oscillation then, a part of which is a tenth of the motion


def _declare(variant: str, p: Parameters) -> Trial:
    layers = LAYERS.get(variant, MANY)
    _check(p)
    goal = History(p["duration"], FINEST)
    unlike = variant == UNLIKE
    scene = column(p, layers, unlike)
    study = Ladder(scene, goal, (Displacement(layers),), dict.fromkeys(Level, RUNGS))
    return Trial(study, _ratios(p, layers, unlike))


def _check(p: Parameters) -> None:
    """Raise ValueError if the step leaves more than LEFT of the free oscillation."""
    first = np.pi * speed(p) / (2 * p["H"])  # of the column, 1/s; its damping ratio is w dt/4
    needed = np.log(1 / LEFT) / (LASTING * first**2 * FINEST / 4)
    if not p["duration"] >= needed:
        raise ValueError(
            f"duration = {p['duration']!r} s; the column's free oscillation dies out in "
            f"{needed:.3g} s, before which its motion is not steady"
        )


def _ratios(p: Parameters, layers: int, unlike: bool) -> tuple[Quantity, ...]:
    shape, listed = {"height": p["H"], "c": speed(p)}, soil(p, layers, unlike)
    damped = shear_wave.unlike_continuous_ratio(F=p["F"], layers=listed, damping=p["shake"])

    def exact(run: Run) -> float:
        dt = float(run.times[1])
        if unlike:
            return abs(shear_wave.unlike_ratio(F=p["F"], dt=dt, layers=listed))
        return abs(shear_wave.layered_ratio(F=p["F"], dt=dt, layers=layers, **shape))

    ratio = functools.partial(_ratio, p, layers)
    return (
        Scalar("ratio", "R/R_dt", "", "amplitude of the top layer over that of the base, relative "
               "to the exact answer of the "
               "step", lambda run: ratio(run) / exact(run), 1.0, 1.0, STEPPED),
        Scalar("spectral ratio", "R", "", "amplitude of the top layer over that of the "
               "base", ratio, None,
               1.0, Shown("it depends on the step, whose damping ratio is w dt/4")),
        Scalar("over SHAKE's", "R/R_z", "", "the same, relative to SHAKE's answer at a constant "
               "damping ratio",
               lambda run: ratio(run) / damped, None, 1.0, Shown(CONSTANT)),
    )  # fmt: skip


def _ratio(p: Parameters, layers: int, run: Run) -> float:
    """The fitted amplitude of the steady sine of the top layer's centre, over that of the base."""
    late = run.times >= LASTING * run.times[-1]
    t = 2.0 * np.pi * p["F"] * run.times[late]
    known = np.stack([np.cos(t), np.sin(t), np.ones_like(t)], axis=1)
    u = run.values[Displacement(layers)][late] @ X
    a, b, _ = np.linalg.lstsq(known, u)[0]
    return float(np.hypot(a, b) / p["D"])


STEPPED = Exact(
    {
        Method.PENALTY: Tolerance(
            1e-2, "the reference is exact for the step. Springs in the joints soften the column, "
            "and the step damps its free oscillation until that is below a hundredth",
        ),
    },
    not_judged={
        Method.LAGGING: "formulations of this class may have the shear springs that are usual in "
        "DDA, 0.4 kn, which soften the column and move its resonance",
    },
)  # fmt: skip
CONSTANT = (
    "the damping ratio of the step, w dt/4, grows with the frequency: it agrees with a constant "
    "ratio at one frequency only"
)
RUNGS = (Knobs(1.6e-2, 1e12), Knobs(FINEST, 1e12))
RATIO = (
    "R = (1 + cos qh)/(2 cos qH), cos qh = (1 - W^2h^2/3c^2)/(1 + W^2h^2/6c^2), "
    "W^2 = (4/dt^2) sin(w dt/2) tan(w dt/2) exp(-i w dt/2)"
)
INERT = frozenset({"nu", "width", "mu", "g", "D", "shake"})
SLOW = dict.fromkeys(
    ("rho", "G"),
    "below its first natural frequency the column follows the base, and the ratio hardly changes",
)
CASE = Case(
    name="site-response",
    title="What layers make of a shaking base",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Secs. 3.5 and 5.1.3, Fig. 10: layers and record are not given. Here layers are equal or "
        "unlike, and the base moves as a lasting sine, for which the step itself has an exact "
        "answer. SHAKE's answer, with the constant damping of 2.3 % that the paper takes for that "
        "of the step, is shown beside it.",
    ),
    parameters=(
        Parameter("H", 30.0, "m", "height of the column"),
        Parameter("rho", 2000.0, "kg/m3", "density"),
        Parameter("G", 1.8e8, "Pa", "shear modulus"),
        Parameter("nu", 0.25, "", "Poisson's ratio"),
        Parameter("width", 600.0, "m", "width of the layers"),
        Parameter("D", 1e-4, "m", "amplitude of the base"),
        Parameter("F", 1.5, "Hz", "its frequency"),
        Parameter("shake", 0.023, "", "damping ratio of SHAKE's model"),
        Parameter("mu", 1000.0, "", "friction coefficient: no joint slips"),
        Parameter("g", 9.81, "m/s2", "gravity, which presses the joints"),
        Parameter("duration", 20.0, "s", "time simulated"),
    ),
    variants=(
        Variant("five-layers", "five layers of 6 m at 1.5 Hz", RATIO, inert=INERT, unseen=SLOW),
        *(
            Variant(
                f"{F:g}hz", f"fifteen layers of 2 m at {F:g} Hz", RATIO, {"F": F}, INERT,
                Level.DEFAULT if F in (2.5, 7.5) else Level.PAPER,
            )
            for F in (1.5, 2.5, 4.0, 7.5)
        ),
        Variant(
            UNLIKE, "fifteen unlike layers of 2 m, each softer than the one below, at 2.5 Hz",
            "Z = a - b^2/(a + Z') from the top down, a = G/h - W^2 rho h/3, b = G/h + W^2 rho h/6",
            {"F": 2.5}, INERT, Level.DEFAULT,
        ),
    ),
    declare=_declare,
    published={"Fig. 10": "2D-DDA agrees with SHAKE at 2.3 % damping, steps of 1e-3 s."},
)  # fmt: skip
