"""A hundred spheres in a row on a base: modes, pulse speed and reflection at a jump of mass."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np

from cases.stability.parts._phase import MORE, hastened
from cases.stability.parts._pulse import FAR, NEAR, Pulse, returned_energy, speed
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
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall

N, RADIUS = 100, 0.1  # spheres; m, which does not enter the answer
X = np.array([1.0, 0.0, 0.0])
CROSSED = 100.0  # times 1/w0 = sqrt(m/kn): the time in which a wave crosses the chain
WIDTH = 8.0  # spheres: the width of a pulse
LARGEST = 0.42  # of x exp(-x^2), just below its maximum
# What rounding of positions may cause, of the pulse: it adds to the error of a step, and is then
# within the 5 % that a bound allows beyond that, 9e-6 for sphere 25 at the finest step. Beside
# lighter spheres all steps are shorter, and their errors smaller as the jump.
NOISY = 3e-7
# Rounding r of all velocities changes a sum S of squares of k of them by 2 r sqrt(k S) at most. Of
# 200 outputs half are late, and the sum before is twice the square of the largest velocity.
SQUARED = 14.0
COARSE, OUTPUT = 0.2, 0.5  # w0 dt; w0 times the time between outputs


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
    _require_large(p)
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


def _require_large(p: Parameters) -> None:
    """Raise ValueError unless rounded positions cause less motion than the shortest step."""
    if not p["jump"] > 0:
        raise ValueError(f"jump = {p['jump']!r}; masses must be positive")
    moved, limit = _rounding(p, p["jump"]), NOISY * min(1.0, p["jump"])
    if not moved < limit:
        raise ValueError(
            f"part = {p['part']!r}, load = {p['load']!r} N, kn = {p['kn']!r} N/m, jump = "
            f"{p['jump']!r}; rounding of positions would move the spheres by {moved:.4g} of the "
            f"motion; it must be below {limit:.4g}"
        )


def _mode(j: int, p: Parameters) -> Trial:
    """The chain with initial velocities in the shape of a mode, in which it stays."""
    w, shape = closed.frequency(j, N, p["m"], p["kn"]), closed.shape(j, N)
    scene = _scene(p, p["part"] * p["load"] / p["kn"] * w * shape, np.full(N, p["m"]))
    seen = Velocity(int(np.argmax(np.abs(shape))) + 1)
    levels = _levels(_coarsest(p))
    frequency = Scalar(
        "frequency", f"w/w_{j}", "", "frequency from the outputs, over that of the mode",
        lambda run: _observed_frequency(run, seen) / w, 1.0, 1.0,
        _turning(w, _coarsest(p), _rounding(p)),
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
    whole, coarsest = CROSSED / w0, _coarsest(p, p["jump"])
    pulse = Pulse(thrown, masses, p["kn"], History(whole, OUTPUT / w0))
    path, scale, rounding = pulse.path(), float(thrown.max()), _rounding(p, p["jump"])
    t = pulse.goal.times(None)

    def scalar(
        name: str, symbol: str, meaning: str, measure: Callable[[Vector, Vector], float],
        why: str, rounded: float,
    ) -> Scalar:  # fmt: skip
        return Scalar(
            name, symbol, "", meaning, lambda run: measure(run.times, _seen(run, seen)),
            lambda: measure(t, path(t)), 1.0,
            _stepped(pulse.error(measure, coarsest), coarsest, why, rounded),
        )  # fmt: skip

    def part(i: int, body: int) -> Series:
        bound = pulse.error(lambda _, v: v[:, i] / scale, coarsest)
        return Series(
            f"v{body}", f"v_{body}", "m/s", f"velocity of the sphere {body} from the base",
            lambda run: _seen(run, seen)[:, i], lambda t: path(t)[:, i],
            _stepped(bound, coarsest, LATE, rounding), scale=scale,
        )  # fmt: skip

    back = math.sqrt(returned_energy(t, path(t), whole))
    quantities: tuple[Quantity, ...] = (
        part(0, NEAR),
        part(1, FAR),
        scalar(
            "returned", "R^2", "energy that returns past sphere 25, over the energy sent",
            lambda t, v: returned_energy(t, v, whole), PASSED, SQUARED * rounding * back,
        ),
    )  # fmt: skip
    if p["jump"] == 1.0:
        going = scalar(
            "speed", "c/w0", "number of spheres that the centre of the pulse passes in 1/w0",
            lambda t, v: speed(t, v) / w0, SPREADS, rounding,
        )  # fmt: skip
        quantities = (*quantities, going)
    return Trial(Ladder(scene, pulse.goal, seen, _levels(coarsest)), quantities)


def _seen(run: Run, seen: tuple[Observable, ...]) -> Vector:
    return np.stack([run.values[what] @ X for what in seen], axis=1)


def _coarsest(p: Parameters, jump: float = 1.0) -> float:
    """The longest step [s]: lighter spheres need shorter ones, which divide the time of outputs."""
    part = COARSE if jump >= 1.0 else OUTPUT / math.ceil(OUTPUT / (COARSE * math.sqrt(jump)))
    return part * math.sqrt(p["m"] / p["kn"])


def _rounding(p: Parameters, jump: float = 1.0) -> float:
    """The velocity that rounded positions cause, over the largest at the start.

    The overlap of a contact is off by the spacing of numbers at the far end, and the spheres beside
    it oscillate by as much, the faster the lighter they are. The pulse is LARGEST of `part`.
    """
    size = LARGEST * p["part"] * p["load"] / p["kn"]
    return float(np.spacing(2 * N * RADIUS)) / size / math.sqrt(min(1.0, jump))


def _levels(coarsest: float) -> dict[Level, tuple[Knobs, ...]]:
    rungs = tuple(Knobs(coarsest / 2**i) for i in range(4))
    return {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}


def _turning(w: float, coarsest: float, rounding: float) -> Exact:
    """For the frequency w [1/s] of a mode, which a leapfrog has at every step below 2/w."""

    def bound(dt: float) -> float:
        return MORE * hastened(w * dt)

    own = bound(coarsest)
    floor = _floor(own, rounding)
    return _judge(Tolerance(own, TURNS, coarsest, order=2, floor=floor, least=bound), rounding)


def _stepped(bound: float, coarsest: float, reason: str, rounding: float) -> Exact:
    """bound, rounding: relative errors at the coarsest step [s], and at any.

    A step of twice that has an error of 4 bound (1 + 3 x^2/10), x = w dt, which is 5 % more at most
    for the waves of the pulse, and within bounds.
    """
    floor = _floor(bound, rounding)
    value = max(1.05 * bound, floor)
    return _judge(Tolerance(value, reason, dt=coarsest, order=2, floor=floor), rounding)


def _floor(bound: float, rounding: float) -> float:
    return max(min(1e-8, bound / 20), rounding)


def _judge(second: Tolerance, rounding: float) -> Exact:
    """The bound of a leapfrog, which holds for one with late forces too."""
    first = dataclasses.replace(second, reason=BALANCED + second.reason)
    return Exact({
        Method.EXACT: Tolerance(max(1e-8, rounding), ROUNDED),
        Method.LEAPFROG: second,
        Method.LATE_LEAPFROG: first,
    }, not_judged=dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER), OTHERS))  # fmt: skip


OTHERS = "the bounds are those of the phase of waves in a leapfrog"
BALANCED = "the load only balances the contacts at the start, and does not lower the order; "
TURNS = (
    "the phase of a leapfrog is too fast by 2 asin(w dt/2)/(w dt) - 1, which is (w dt)^2/24 in "
    "short steps; 3 % more is allowed"
)
STEPPED = (
    "the bound is the error of that leapfrog, computed as the sum of its modes, whose phase in a "
    "step is 2 asin(w dt/2), at this jump, and 5 %"
)
LATE = (
    "waves with a phase of q per sphere are ahead by (q w0 dt)^2/24 of the distance q x: a pulse "
    "of eight spheres, mostly with q < 0.25, by 1e-3 radians, and by as much of its size, at w0 dt "
    f"= 0.2; {STEPPED}"
)
PASSED = (
    "at each phase per sphere a leapfrog reflects the exact part, but its waves are faster by "
    f"(w dt)^2/8, and the faster ones pass sphere 25 in less time; {STEPPED}"
)
ROUNDED = "positions in the row are rounded, to 1e-9 of the amplitude at the defaults"
SPREADS = (
    "waves in a leapfrog are faster by (w dt)^2/8, 3e-4 at a phase of 0.25 per sphere; " + STEPPED
)
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
