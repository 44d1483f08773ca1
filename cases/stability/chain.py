"""A hundred spheres in a row on a base: modes, pulse speed and reflection at a jump of mass."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference_solutions.contact import chain as closed
from vv.ask import History, Knobs, Method, Observable, Run, Velocity
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
    remembered,
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall

N, RADIUS = 100, 0.1  # spheres; m, which does not enter the answer
X = np.array([1.0, 0.0, 0.0])
NEAR, FAR = 25, 75  # the spheres that are observed: one before the jump, one beyond it
CROSSED = 100.0  # times 1/w0 = sqrt(m/kn): the time in which a wave crosses the chain
WIDTH = 8.0  # spheres: the width of a pulse
COARSE = 0.2  # w0 dt
Measure = Callable[[Vector, Vector], float]


def _scene(p: Parameters, thrown: Vector, masses: Vector) -> Scene:
    """A wall, the spheres on it in a row, and a load that keeps all contacts closed."""
    depth = p["load"] / p["kn"]
    load = np.zeros((N, 3))
    load[-1] = -p["load"] * X
    row = Spheres(
        position=np.outer(RADIUS - depth + (2 * RADIUS - depth) * np.arange(N), X),
        velocity=np.outer(thrown, X),
        radius=np.full(N, RADIUS),
        mass=masses,
        free=np.tile(X > 0, (N, 1)),
        load=load,
    )
    return Scene((Wall(np.zeros(3), X), row), Contact(p["kn"]))


def _declare(variant: str, p: Parameters) -> Trial:
    if not 0 < p["part"] < 0.2:
        raise ValueError(
            f"part = {p['part']!r}; it must be between 0 and 0.2, beyond which contacts may open"
        )
    _require_shallow(p)
    kind, _, mode = variant.partition("-")
    return _mode(int(mode), p) if kind == "mode" else _pulse(p)


def _require_shallow(p: Parameters) -> None:
    """Raise ValueError where one contact with the energy of all is deeper than a tenth of r."""
    deepest = (1 + p["part"]) * math.sqrt(N) * p["load"] / p["kn"]
    if not deepest < RADIUS / 10:
        raise ValueError(
            f"load = {p['load']!r} N, kn = {p['kn']!r} N/m; one contact with the energy of all "
            f"would overlap by {deepest:.4g} m; it must be below a tenth of the radius, "
            f"{RADIUS / 10:g} m"
        )


def _mode(j: int, p: Parameters) -> Trial:
    """The chain with initial velocities in the shape of a mode, in which it stays."""
    w, shape = closed.frequency(j, N, p["m"], p["kn"]), closed.shape(j, N)
    scene = _scene(p, p["part"] * p["load"] / p["kn"] * w * shape, np.full(N, p["m"]))
    seen = Velocity(int(np.argmax(np.abs(shape))) + 1)
    levels = _levels(p)
    frequency = Scalar(
        "frequency", f"w/w_{j}", "", "frequency from the outputs, over that of the mode",
        lambda run: _observed_frequency(run, seen) / w, 1.0, 1.0,
        _judge((w * _coarsest(p)) ** 2 / 24, _coarsest(p), TURNS),
    )  # fmt: skip
    return Trial(Ladder(scene, History(12.0 / w, 1.0 / w), (seen,), levels), (frequency,))


def _observed_frequency(run: Run, seen: Observable) -> float:
    """The frequency of data that obey v_(n+1) + v_(n-1) = 2 cos(w dt) v_n at equal intervals."""
    v = run.values[seen] @ X
    inner = v[1:-1]
    cosine = float(inner @ (v[2:] + v[:-2]) / (2 * inner @ inner))
    return math.acos(cosine) / float(run.times[1])


def _pulse(p: Parameters) -> Trial:
    """The chain with initial velocities near its base: a pulse runs along it, a part returns."""
    place = np.arange(1.0, N + 1.0)
    w0 = math.sqrt(p["kn"] / p["m"])
    shape = place / WIDTH * np.exp(-((place / WIDTH) ** 2))
    thrown = p["part"] * p["load"] / p["kn"] * w0 * shape
    masses = np.where(place > N / 2, p["jump"], 1.0) * p["m"]
    scene, seen = _scene(p, thrown, masses), (Velocity(NEAR), Velocity(FAR))
    goal = History(CROSSED / w0, 0.5 / w0)

    @remembered
    def path(t: Vector) -> Vector:
        return closed.motion(t, thrown, masses, p["kn"])[1][:, [NEAR - 1, FAR - 1]]

    t = goal.times(None)

    def measured(measure: Measure) -> tuple[Callable[[Run], float], Callable[[], float]]:
        """The measured quantities of a run, and of the exact motion."""
        return lambda run: measure(run.times, _seen(run, seen)), lambda: measure(t, path(t))

    def part(i: int, body: int) -> Series:
        return Series(
            f"v{body}", f"v_{body}", "m/s", f"velocity of the sphere {body} from the base",
            lambda run: _seen(run, seen)[:, i], lambda t: path(t)[:, i],
            _judge(2.4e-3, _coarsest(p), LATE), scale=float(np.abs(thrown).max()),
        )  # fmt: skip

    returned = Scalar(
        "returned", "R^2", "", "energy that returns past sphere 25, over the energy sent",
        *measured(_returned_energy), 1.0, _judge(RETURNED[p["jump"] != 1], _coarsest(p), PASSED),
    )  # fmt: skip
    quantities: tuple[Quantity, ...] = (part(0, NEAR), part(1, FAR), returned)
    if p["jump"] == 1.0:
        speed = Scalar(
            "speed", "c/w0", "", "number of spheres that the centre of the pulse passes in 1/w0",
            *measured(lambda t, v: _speed(t, v) / w0), 1.0, _judge(4e-4, _coarsest(p), SPREADS),
        )  # fmt: skip
        quantities = (*quantities, speed)
    return Trial(Ladder(scene, goal, seen, _levels(p)), quantities)


def _seen(run: Run, seen: tuple[Observable, ...]) -> Vector:
    return np.stack([run.values[what] @ X for what in seen], axis=1)


def _returned_energy(t: Vector, v: Vector) -> float:
    """The sum of squared velocities (k, 2) after half of the time, over that before."""
    late = t > t[-1] / 2
    squares = v[:, 0] ** 2
    return float(squares[late].sum() / squares[~late].sum())


def _speed(t: Vector, v: Vector) -> float:
    """Spheres per second, from the mean times at which energy passes the two that are observed."""
    near, far = (t @ v**2 / (v**2).sum(axis=0)).tolist()
    return float((FAR - NEAR) / (far - near))


def _coarsest(p: Parameters) -> float:
    return COARSE * math.sqrt(p["m"] / p["kn"])


def _levels(p: Parameters) -> dict[Level, tuple[Knobs, ...]]:
    rungs = tuple(Knobs(_coarsest(p) / 2**i) for i in range(4))
    return {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}


def _judge(bound: float, coarsest: float, reason: str) -> Exact:
    """bound: at the coarsest step [s]; rounding of positions leaves 1e-5 of most bounds."""
    floor = min(1e-8, bound / 20)
    second = Tolerance(1.05 * bound, reason, dt=coarsest, order=2, floor=floor)
    first = Tolerance(1.05 * bound, BALANCED + reason, dt=coarsest, order=2, floor=floor)
    return Exact({
        Method.EXACT: Tolerance(1e-8, "positions in the row are rounded to 1e-9 of the amplitude"),
        Method.LEAPFROG: second,
        Method.LATE_LEAPFROG: first,
    }, not_judged=dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER), OTHERS))  # fmt: skip


OTHERS = "the bounds are those of the phase of waves in a leapfrog"
BALANCED = "the load only balances the contacts at the start, and does not lower the order; "
TURNS = "the phase of a leapfrog is too fast by (w dt)^2/24"
LATE = (
    "waves with a phase of q per sphere are ahead by (q w0 dt)^2/24 of the distance q x: a pulse "
    "of eight spheres, mostly with q < 0.25, by 1e-3 radians, and by as much of its size, at w0 dt "
    "= 0.2"
)
PASSED = "the reflected part depends on the phase per sphere, whose error is (w dt)^2/24"
RETURNED = (5e-10, 2e-6)  # without a jump and with one
SPREADS = "waves in a leapfrog are faster by (w dt)^2/8, 3e-4 at a phase of 0.25 per sphere"
MODE = "w_j = 2 sqrt(kn/m) sin((2j - 1) pi/(2 (2N + 1))), N = 100"
WAVE = "m_i u_i'' = kn (u_(i-1) - 2 u_i + u_(i+1)), u_0 = 0, v_i(0) ~ i exp(-(i/8)^2); "
CASE = Case(
    name="chain",
    title="A chain on a base",
    source=Source(
        "Brillouin (1946), Wave propagation in periodic structures, McGraw-Hill, chapter 3",
        "",
        "The springs are contacts, which a load on the last sphere keeps closed; the base is fixed "
        "and the other end free. At a jump of the mass |R| = |sin((q - Q)/2)/sin((q + Q)/2)|, with "
        "the phase per sphere q before it and Q beyond it.",
    ),
    parameters=(
        Parameter("m", 1.0, "kg", "mass of a sphere"),
        Parameter("jump", 1.0, "", "mass beyond the middle of the chain over that before"),
        Parameter("kn", 1e6, "N/m", "contact stiffness"),
        Parameter("load", 100.0, "N", "load that keeps the contacts closed"),
        Parameter("part", 0.05, "", "amplitude of the motion, in overlaps at rest"),
    ),
    variants=(
        *(
            Variant(f"mode-{j}", f"initial velocities in the shape of mode {j} of 100", MODE,
                    inert=frozenset({"jump", "load", "part"}))
            for j in (3, 50, 100)
        ),
        Variant("pulse", "a pulse along equal masses", WAVE + "c = sqrt(kn/m) cos(q/2)"),
        Variant("jump", "a pulse that meets masses four times as large", WAVE + "R = -1/3 for "
                "long waves", {"jump": 4.0}),
    ),
    declare=_declare,
)  # fmt: skip
