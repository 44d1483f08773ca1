"""The scenes of MFiX's DEM01 to DEM04 and DEM06, their exact answers and the errors of steps."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from cases.impact.parts import _mfix_errors
from cases.impact.parts._materials import require_shallow
from reference_solutions.impact import pressed_pair as pressed
from reference_solutions.impact import slip_to_roll
from reference_solutions.impact.dropped import Drop, path
from reference_solutions.impact.sinking import Sinking, motion
from vv.ask import Displacement, Run, Velocity
from vv.case import LARGEST_TOLERANCE, ComponentAlong, Parameters
from vv.scene import Contact, Fluid, Scene, Spheres, Vector, Wall

X, Y, Z = np.eye(3)
PRESSED, SINKS = 1e-3, 0.35  # s
FINE = 1001  # times at which overlaps of the pressed pair are computed
LAST = 1.15  # the pressed pair's duration over the time of its last output, at most
FLOOR_LEVEL = np.zeros(3)
SeriesParts = tuple[str, str, str, str, Callable[[Run], Vector], Callable[[Vector], Vector]]


class Setting(NamedTuple):
    """The data of a variant.

    series: each by name, symbol, unit, meaning, what is observed and the exact answer; unit: 1/w
    [s] of the fastest oscillation; steps: of the ladder, times w; square: tolerance of each series
    over (w dt)^2; late: what forces half a step late add to all, over w dt.
    """

    scene: Scene
    series: tuple[SeriesParts, ...]
    duration: float
    unit: float
    steps: tuple[float, ...]
    square: tuple[float, ...]
    late: float


def _mass(p: Parameters) -> float:
    return p["rho"] * 4.0 / 3.0 * math.pi * p["R"] ** 3


def _spheres(places: tuple[float, ...], p: Parameters, masses: Vector, speed: float) -> Spheres:
    """Spheres at these heights of their centres [m], that move up and down, or along x and turn."""
    count, slips = len(places), speed != 0.0
    return Spheres(
        position=np.outer(places, Z),
        velocity=np.tile(speed * X, (count, 1)),
        radius=np.full(count, p["R"]),
        mass=np.array(masses),
        free=np.tile([slips, slips, True], (count, 1)),
        free_spin=np.full((count, 3), slips),
    )


def dropped(bounces: int, p: Parameters) -> Setting:
    """A sphere that falls on a wall, and bounces."""
    m, fall = _mass(p), p["h"] - p["R"]
    drop = Drop(m, p["kn"], p["z"], p["g"])
    sphere = _spheres((p["h"],), p, np.array([m]), 0.0)
    contact = Contact(p["kn"], eta_n=drop.viscous)
    pieces = drop.pieces(fall, bounces)
    sunk, last = _mfix_errors.deepest(drop, pieces), pieces[-1]
    if not sunk < p["R"]:
        raise ValueError(
            f"kn = {p['kn']!r} N/m; the sphere sinks by {sunk:.4g} m; it must be less than the "
            f"radius, {p['R']:g} m, or its centre goes through the wall"
        )
    height = (
        "height", "h", "m", "upward displacement of the sphere",
        ComponentAlong(Displacement(0), Z),
        lambda t: path(t, fall, bounces, drop) - fall,
    )  # fmt: skip
    return Setting(
        Scene((sphere, Wall(FLOOR_LEVEL, Z)), contact, gravity=-p["g"] * Z), (height,),
        last.since + last.speed / p["g"], math.sqrt(m / p["kn"]), (0.08, 0.04, 0.02, 0.005, 0.001),
        (_mfix_errors.delay(bounces, p["g"] / math.sqrt(2 * p["g"] * fall * p["kn"] / m)),),
        _mfix_errors.half_steps(drop, pieces),
    )  # fmt: skip


def pressed_pair(p: Parameters) -> Setting:
    """Two spheres between two walls."""
    masses = _mass(p) * np.array([1.0, p["rho2"] / p["rho"]])
    start = p["h"], p["h2"]
    pair = _spheres(start, p, masses, 0.0)
    walls = Wall(FLOOR_LEVEL, Z), Wall(p["H"] * Z, -Z)
    law = {"k": p["kn"], "R": p["R"], "H": p["H"], "g": p["g"]}

    def moved(t: Vector, i: int) -> Vector:
        both = (float(masses[0]), float(masses[1]))
        return pressed.heights(t, start, masses=both, **law)[..., i] - start[i]

    unit = math.sqrt(float(masses.min()) / (3.0 * p["kn"]))
    y = np.array(start) + np.stack([moved(np.linspace(0.0, PRESSED, FINE), i) for i in (0, 1)], -1)
    gaps = y[:, 0] - p["R"], y[:, 1] - y[:, 0] - 2.0 * p["R"], p["H"] - p["R"] - y[:, 1]
    require_shallow(-float(np.min(gaps)), p["R"])
    ahead, steps = _mfix_errors.ahead(PRESSED / unit), (0.08, 0.04, 0.02, 0.005, 0.001)
    # all of the motion may be dt/2 late
    late = LAST * unit / 2 * max(_quickest(y[:, i] - start[i]) for i in (0, 1))
    worst = (late + ahead * steps[0]) * steps[0]
    parts = 1 << max(0, math.ceil(math.log2(worst / LARGEST_TOLERANCE)))
    series = tuple(
        (
            f"y{i + 1}", f"y{i + 1}", "m", f"upward displacement of the {which} sphere",
            ComponentAlong(Displacement(i), Z),
            lambda t, i=i: moved(t, i),
        )
        for i, which in enumerate(("lower", "upper"))
    )  # fmt: skip
    return Setting(
        Scene((pair, *walls), Contact(p["kn"]), gravity=-p["g"] * Z), series,
        PRESSED, unit, tuple(step / parts for step in steps), (ahead,) * 2,
        late,
    )  # fmt: skip


def _quickest(moved: Vector) -> float:
    """The largest speed over the largest displacement [1/s] of one of the pressed pair."""
    speed = np.gradient(moved, PRESSED / (FINE - 1))
    return float(np.abs(speed).max() / np.abs(moved).max())


def slipping(p: Parameters) -> Setting:
    """A sphere that starts to slide, in equilibrium on its normal spring."""
    m, sunk = _mass(p), _mass(p) * p["g"] / p["kn"]
    require_shallow(sunk, p["R"])  # the laws of codes differ by their arms, as far as it sinks
    arm = 1.0 - 0.5 * sunk / p["R"]
    slide = slip_to_roll.Sliding(m, p["kn"], p["mu"], p["g"], p["v"], 1.0 + 2.5 * arm**2)
    sphere = _spheres((p["R"] - sunk,), p, np.array([m]), p["v"])
    speed = (
        "speed", "v", "m/s", "velocity along the wall",
        ComponentAlong(Velocity(0), X), lambda t: slip_to_roll.speed(t, slide),
    )  # fmt: skip
    contact = Contact(p["kn"], p["kn"], p["mu"])
    return Setting(
        Scene((sphere, Wall(FLOOR_LEVEL, Z)), contact, gravity=-p["g"] * Z), (speed,),
        1.4 * slide.rolls, 1.0 / slide.w, (0.2, 0.1, 0.05, 0.02, 0.005), (0.04,), 0.1,
    )  # fmt: skip


def sinking(p: Parameters) -> Setting:
    """A sphere that sinks in gas at rest, which bears a part of its weight."""
    m, fluid = _mass(p), Fluid(p["rho_f"], p["viscosity"])
    sinking = Sinking(2.0 * p["R"], p["rho"], p["rho_f"], p["viscosity"], p["g"], p["v"])
    unit = min(1.0 / sinking.quickest, SINKS)
    borne = m * p["rho_f"] / p["rho"] * p["g"]
    sphere = dataclasses.replace(
        _spheres((0.0,), p, np.array([m]), 0.0),
        velocity=-p["v"] * Z[None],
        load=borne * Z[None],
    )
    series = (
        (
            "height", "h", "m", "upward displacement of the sphere",
            lambda run: run.values[Displacement(0)] @ Z, lambda t: -motion(t, sinking)[0],
        ),
        (
            "speed", "v", "m/s", "upward velocity",
            lambda run: run.values[Velocity(0)] @ Z, lambda t: -motion(t, sinking)[1],
        ),
    )  # fmt: skip
    return Setting(
        Scene((sphere,), Contact(p["kn"]), gravity=-p["g"] * Z, fluid=fluid), series,
        SINKS, unit, (0.1, 0.05, 0.025, 0.005, 0.001), _mfix_errors.lags(sinking, SINKS, unit), 0.2,
    )  # fmt: skip
