"""Displacement of a block that friction drags along on a shaking foundation.

Yagoda-Biran and Hatzor (2016), Secs. 3.4 and 4.5: the base moves by d1 = D (1 - cos 2 pi f t) [m]
along each axis (Eqs. 11, 16), D [m], f [Hz]; the block lies on it with friction mu [-] under
gravity g [m/s2] and starts with it at rest. Displacements d2 [m] are absolute.

The block sticks to the base while it has the same velocity and |a1| <= mu (g + a1z), with the
horizontal acceleration a1 and the vertical acceleration a1z of the base. Otherwise friction
accelerates it by mu (g + a1z) along the velocity of the base relative to it, and along a1 where a
slip begins (Eqs. 12, 13, 17 corrected). Vertically the block follows the base. The equations are
solved in the frame of the base, with w = d2' - d1'. Every function raises ValueError for a
parameter out of range.
"""

from functools import lru_cache
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.blocks import harmonic_slip, turning_slip
from reference_solutions.blocks.harmonic_slip import Law, Phase
from reference_solutions.blocks.turning_slip import Interval, Step
from reference_solutions.parameters import require_at_least_0, require_positive, require_times

Array = NDArray[np.float64]


def base(t: ArrayLike, *, D: float, f: float) -> Array:
    """The displacement d1 [m] of the base at times t [s] (Eq. 11)."""
    moved: Array = 2.0 * D * np.sin(pi * f * np.asarray(t, dtype=np.float64)) ** 2
    return moved


def one_direction(t: ArrayLike, *, D: float, f: float, mu: float, g: float) -> Array:
    """The displacement d2 [m] at times t >= 0 [s] of any shape; see `harmonic_slip`.

    The displacement is summed in the fixed frame: on a fast base the block hardly moves, so that
    the difference of base and lag would lose digits.
    """
    t = require_times(t)
    drive = _drive(D, f, mu, g)
    found = harmonic_slip.phases(drive, 0.0, float(t.max(initial=0.0)), steady=0.0)
    which = np.searchsorted([phase.begin for phase in found], t, side="right") - 1
    moved, d2 = np.empty(t.shape), 0.0
    for i, phase in enumerate(found):
        times = np.append(t[which == i], phase.end)
        if phase.direction:
            since = times - phase.begin
            pull = drive.law(phase.direction).p
            v = phase.v + 2.0 * pi * f * D * np.cos(phase.angle)
            way = v * since + pull * since**2 / 2.0
        else:
            way = base(times, D=D, f=f) - base(phase.begin, D=D, f=f)
        moved[which == i] = d2 + way[:-1]
        d2 += float(way[-1])
    return moved


def one_direction_phases(
    duration: float, *, D: float, f: float, mu: float, g: float
) -> tuple[Phase, ...]:
    """The slips and rests of `one_direction` until `duration` [s].

    They are relative to the base, as are their d, v and a.
    """
    end = float(require_times(duration))
    return harmonic_slip.phases(_drive(D, f, mu, g), 0.0, end, steady=0.0)


def two_directions(
    t: ArrayLike, *, Dx: float, fx: float, Dy: float, fy: float, mu: float, g: float
) -> Array:
    """The displacement d2 [m], x and y along the last axis, at times t >= 0 [s].

    See `turning_slip`.
    """
    moved: Array = three_directions(
        t, Dx=Dx, fx=fx, Dy=Dy, fy=fy, Dz=0.0, fz=max(fx, fy), mu=mu, g=g
    )[..., :2]
    return moved


def two_directions_phases(
    duration: float, *, Dx: float, fx: float, Dy: float, fy: float, mu: float, g: float
) -> tuple[Interval, ...]:
    """The slips and rests of `two_directions` relative to the base until `duration` [s]."""
    return three_directions_phases(
        duration, Dx=Dx, fx=fx, Dy=Dy, fy=fy, Dz=0.0, fz=max(fx, fy), mu=mu, g=g
    )


# The case passes its parameters by name, one for one.
def three_directions(
    t: ArrayLike,
    *,
    Dx: float,
    fx: float,
    Dy: float,
    fy: float,
    Dz: float,
    fz: float,
    mu: float,
    g: float,
) -> Array:
    """The displacement d2 [m], x, y, z along the last axis, at times t >= 0 [s].

    See `turning_slip`. Raises ValueError if Dz (2 pi fz)^2 >= g: the block would leave the base.
    """
    t = require_times(t)
    steps = _steps(Dx, fx, Dy, fy, Dz, fz, mu, g, float(t.max(initial=0.0)))
    moved = np.stack([base(t, D=D, f=f) for D, f in ((Dx, fx), (Dy, fy), (Dz, fz))], axis=-1)
    moved[..., :2] += turning_slip.displacement(t, steps)
    return moved


# The case passes its parameters by name, one for one.
def three_directions_phases(
    duration: float,
    *,
    Dx: float,
    fx: float,
    Dy: float,
    fy: float,
    Dz: float,
    fz: float,
    mu: float,
    g: float,
) -> tuple[Interval, ...]:
    """The slips and rests of `three_directions` relative to the base until `duration` [s]."""
    end = float(require_times(duration))
    return turning_slip.intervals(_steps(Dx, fx, Dy, fy, Dz, fz, mu, g, end))


@lru_cache(maxsize=16)
# The parameters are positional, so that the cache is keyed by all of them.
def _steps(
    Dx: float,
    fx: float,
    Dy: float,
    fy: float,
    Dz: float,
    fz: float,
    mu: float,
    g: float,
    end: float,
) -> tuple[Step, ...]:
    require_at_least_0("m", Dx=Dx, Dy=Dy, Dz=Dz)
    require_positive("Hz", fx=fx, fy=fy, fz=fz)
    require_at_least_0("[-]", mu=mu)
    require_positive("m/s2", g=g)
    omega = 2.0 * pi * np.array([fx, fy, fz])
    ax, ay, az = omega**2 * [Dx, Dy, Dz]
    if not az < g:
        raise ValueError(
            f"Dz = {Dz} m; Dz (2 pi fz)^2 = {az:.6g} m/s2 must be below g = {g} m/s2, "
            "or the block leaves the base"
        )
    drive = turning_slip.Drive(
        omega=omega,
        constant=np.array([0.0, 0.0, mu * g]),
        sine=np.zeros((3, 3)),
        cosine=np.diag([-ax, -ay, mu * az]),
    )
    return turning_slip.history(drive, end)


def _drive(D: float, f: float, mu: float, g: float) -> harmonic_slip.Drive:
    require_positive("m", D=D)
    require_positive("Hz", f=f)
    require_at_least_0("[-]", mu=mu)
    require_positive("m/s2", g=g)
    omega = 2.0 * pi * f
    pushed, held = D * omega**2, mu * g  # -a1 = pushed sin(omega t - pi/2)
    return harmonic_slip.Drive(omega, -pi / 2.0, Law(-held, pushed), Law(held, pushed))
