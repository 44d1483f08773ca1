"""A block that tumbles freely off its principal axes lands on a corner."""

from __future__ import annotations

import functools

import numpy as np

from reference_solutions.hard import tumbling
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, Vector, Wall, box_geometry, polyhedron_inertia

AXES = np.array([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]]) / 3  # of the block
SIDES, DENSITY = np.array([1.0, 0.6, 0.35]), 2500.0  # m; kg/m3, which does not enter the answer
# times w, about the block's axes: close to that of the middle inertia
SPIN = np.array([0.3, 2.5, -0.6])
Z = np.array([0.0, 0.0, 1.0])
BLOCK, OUTPUTS = Displacement(1), 20


def _declare(variant: str, p: Parameters) -> Trial:
    vertices, faces = box_geometry(p["height"] * Z, SIDES / 2, AXES)
    mass, inertia = polyhedron_inertia(vertices, faces, DENSITY)
    body = tumbling.Body(
        mass, np.diag(AXES @ inertia @ AXES.T), (vertices - p["height"] * Z) @ AXES.T, AXES
    )
    free = np.ones(3, bool)
    block = Block(
        "block", vertices, faces, mass, inertia, velocity=-p["V"] * Z,
        free=free, free_spin=free, spin=p["w"] * SPIN @ AXES,
    )  # fmt: skip
    scene = Scene((Wall(np.zeros(3), Z), block), Contact(np.inf))
    goal = History(p["duration"], p["duration"] / OUTPUTS)
    coarsest = COARSEST / p["w"]
    kn = (
        KN * max(1.0, p["w"]) ** 2
    )  # as deep as with w = 1: a corner sinks by its speed times sqrt(m/kn)
    rungs = tuple(Knobs(coarsest / 2**i, kn) for i in range(4))
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    steps = tuple(rung.dt for rung in rungs)
    return Trial(Ladder(scene, goal, (BLOCK,), levels), _measured(p, body, goal, steps))


def _measured(
    p: Parameters, body: tumbling.Body, goal: History, steps: tuple[float | None, ...]
) -> tuple[Quantity, ...]:
    """Displacement of the centre and time of landing; steps [s]: of all levels, longest first."""

    @functools.cache  # only where a run is measured: it takes longer than judging what is stored
    def met() -> tumbling.Landing:
        found = tumbling.landing(
            body, p["w"] * SPIN, Z, height=p["height"], V=p["V"], latest=p["duration"]
        )
        for step in (None, *steps):  # outputs fall on whole steps
            _check_outputs(goal.times(step), found.t)
        _check_flight(p, body, found)
        return found

    def path(t: Vector) -> Vector:
        return tumbling.height_gained(t, met(), p["V"])[:, None]

    second = Tolerance(
        1e-4 * max(1.0, p["w"] * 0.2 / p["V"] * _turned(p) / _turned({"w": 1.0, "duration": 1.6})),
        "the orientation has an error of a part of (w dt)^2, w = 2.6 1/s, times the angle w t, and "
        "so has the position of the corner that lands, relative to the displacement V t; after the "
        "landing the velocity is off by as much of w times the corner's arm, and the displacement "
        "by w t more",
        dt=steps[0], order=2, floor=1e-9,
    )  # fmt: skip
    up = Motion(BLOCK, Z[None], path, goal.times(None), "m").component(
        0, "z", "displacement away from the plane", Exact(
            {Method.SECOND_ORDER: second},
            not_judged=dict.fromkeys((Method.FIRST_ORDER, Method.PENALTY, Method.LAGGING), SPRUNG),
        ),
    )  # fmt: skip
    lands = Scalar(
        "lands", "t_1", "s", "time of landing: where lines through z before and after it cross",
        lambda run: _crossing(run, met().t), lambda: met().t, lambda: met().t, Exact(
            {Method.SECOND_ORDER: second, Method.PENALTY: SPRINGS},
            not_judged={Method.FIRST_ORDER: SPRUNG, Method.LAGGING: UNTURNED},
        ),
    )  # fmt: skip
    return up, lands


def _turned(p: Parameters) -> float:
    """One and the angle of rotation: an error of orientation as the landing and its speed see it.

    Only the time after the landing counts, but it is known only once a run is measured.
    """
    return 1.0 + float(np.linalg.norm(SPIN)) * p["w"] * p["duration"]


def _check_flight(p: Parameters, body: tumbling.Body, met: tumbling.Landing) -> None:
    """Raise ValueError where a corner nearly misses the plane, or meets it again before the end."""
    if met.approach < p["V"]:
        raise ValueError(
            f"w = {p['w']!r}; a corner meets the plane at {met.approach:.3g} m/s, slower than the "
            f"centre, {p['V']:g} m/s: it nearly misses the plane, so that any error of the "
            "orientation moves the landing by much more"
        )
    t = np.linspace(0.0, p["duration"] - met.t, 100)[1:]
    after = tumbling.Body(body.mass, body.inertia, body.corners, met.axes)
    centre = p["height"] + tumbling.height_gained(met.t + t, met, p["V"])
    if (centre[:, None] + tumbling.clearance(t, after, met.w, Z)).min() <= 0.0:
        raise ValueError(f"duration = {p['duration']!r} s; a corner meets the plane a second time")


def _check_outputs(times: Vector, lands: float) -> None:
    """Raise ValueError unless lines can be laid through outputs on both sides of the landing."""
    before, after = (times < BEFORE * lands).sum(), (times > AFTER * lands).sum()
    if min(before, after) < 2:
        raise ValueError(
            f"duration = {times[-1]:g} s; a corner lands after {lands:.4g} s, too near one end for "
            "two outputs well before it and two well after"
        )


def _crossing(run: Run, about: float) -> float:
    """Where lines through the outputs well before and well after a time cross [s]."""
    t, z = run.times, run.values[BLOCK] @ Z
    (a, b), (c, d) = (
        np.polyfit(t[one], z[one], 1) for one in (t < BEFORE * about, t > AFTER * about)
    )
    return float((d - b) / (a - c))


COARSEST, KN = 5e-3, 1e8  # rad; N/m up to w = 1
BEFORE, AFTER = 0.95, 1.05  # times the time of landing: outputs that are well away from it
SPRUNG = "springs return a part of the energy of the impact that depends on their damping"
UNTURNED = "a code of this class leaves out the gyroscopic torque, and says so"
SPRINGS = Tolerance(
    2e-2,
    "contact springs reverse the motion within pi sqrt(m/kn), and a landing falls within a step dt",
)
CASE = Case(
    name="tumbling",
    title="A tumbling block lands",
    source=Source(
        "Landau and Lifshitz (1976), Mechanics, 3rd ed., Butterworth-Heinemann",
        "",
        "Section 37, the asymmetrical top, until the first corner meets the plane; then a rigid "
        "impact without friction or restitution. The block spins almost about the axis of its "
        "middle moment of inertia, so that the gyroscopic torque turns it over. There is no "
        "gravity.",
    ),
    parameters=(
        Parameter("w", 1.0, "", "spin over (0.3, 2.5, -0.6) 1/s about the axes of the block"),
        Parameter("height", 0.8, "m", "height of the centre above the plane at the start"),
        Parameter("V", 0.2, "m/s", "speed of the centre towards the plane at the start"),
        Parameter("duration", 1.6, "s", "time simulated"),
    ),
    variants=(
        Variant(
            "corner", "a box of 1 x 0.6 x 0.35 m, on a smooth plane",
            "w1 ~ cn, w2 ~ sn, w3 ~ dn of a (t - t0); z = -V t + (P/m) (t - t_1), P the impulse",
        ),
    ),
    declare=_declare,
)  # fmt: skip
