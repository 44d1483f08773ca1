"""A block on springs that nothing damps vibrates while it rests, and slips farther for it.

A slip ends with the shear spring stretched by F/w^2, F the friction that its normal force allows,
over the mass, and w^2 = ks/m. The forces T along the plane are less: a = F - T is left and vibrates
about T, at any stiffness with that amplitude of the force. Where T + a or T - a exceeds F, the
block slips a little along the force, by which that end of the vibration returns to F. What vibrates
across T as it reaches F, by an angle th = a/F, lowers the mean friction along the slip:

    v' = T' t + F th^2/4, th' = -(w^2 v/2 F) th

In units t0 = (2 F/(T' w^2))^(1/3) and v0 = 2 F/(w^2 t0), this has no parameter but th^2 over
4 T' t0/F. It makes the block faster by 1.3 v0 times that, and by v0 at most, until the slip ends:
tests integrate the block on its spring.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from reference_solutions.blocks import incline
from vv.case import Parameters
from vv.scene import Vector

SHEAR = 25.0  # stiffness across contacts of springs that carry friction, over the normal one
GAINED = 1.3  # v0 times th^2/(4 T' t0/F), gained where th is small
BEFORE = 2.0  # t0 before slip begins, where what vibrates across T still can
STOPPING = 1e-3  # part of a slip in which its direction is that of its end
WAYS = 5  # directions in which the block may stop
FINE = 800  # times in a rest, closer to each other towards its end


class Onset(NamedTuple):
    """A slip that begins after a rest: F [m/s2], T' [m/s3], and how long it lasts [s].

    before, across: times before it [s], the last first, and amplitudes of the force across T then.
    """

    friction: float
    rate: float
    lasts: float
    before: Vector
    across: Vector

    def gains(self, square: float) -> float:
        """What the block slips too far [m], with w^2 [1/s2]."""
        t0 = (2 * self.friction / (self.rate * square)) ** (1 / 3)
        v0 = 2 * self.friction / (square * t0)
        angle = np.interp(BEFORE * t0, self.before, self.across) / self.friction
        part = GAINED * angle**2 * self.friction / (4 * self.rate * t0)
        return float(v0 * min(1.0, part) * self.lasts)


def resounding(frequency: float, square: float) -> float:
    """By which factor shaking stretches springs more; frequency [1/s], square: w^2 [1/s2]."""
    return float(max(1.0, 1 / max(abs(1 - frequency**2 / square), np.finfo(float).eps)))


def slips_on(p: Parameters, mass: float, slid: float) -> Callable[[float], float]:
    """The error that these vibrations leave, over `slid` [m], at a stiffness kn [N/m]."""

    @functools.cache  # only where a run is judged
    def onsets() -> tuple[Onset, ...]:
        return _onsets(p)

    return lambda kn: sum(one.gains(SHEAR * kn / mass) for one in onsets()) / slid


def _forces(p: Parameters, t: Vector) -> tuple[Vector, Vector]:
    """T (k,), down the dip and, as imaginary part, along the strike, and F (k,), over the mass."""
    dip, mu = np.radians(p["alpha"]), np.tan(np.radians(p["phi"]))
    along, aside = (
        p[size] * np.sin(2 * np.pi * p[often] * t) for size, often in (("A", "f"), ("Ay", "fy"))
    )
    pull = p["g"] * np.sin(dip) + along * np.cos(dip) + 1j * aside
    return pull, mu * (p["g"] * np.cos(dip) - along * np.sin(dip))


def _onsets(p: Parameters) -> tuple[Onset, ...]:
    """All slips that begin after a rest that ended a slip."""
    drive = {"ax": p["A"], "fx": p["f"], "ay": p["Ay"], "fy": p["fy"]}
    law = {name: p[name] for name in ("alpha", "phi", "g")}
    phases = incline.two_directions_phases(p["duration"], **drive, **law)
    found = []
    for slip, rest, again in zip(phases, phases[1:], phases[2:], strict=False):
        if slip.slips and not rest.slips and rest.end > rest.begin:
            last = rest.begin - STOPPING * (slip.end - slip.begin)
            times = np.array([last, rest.begin, p["duration"]])
            way = np.diff(incline.two_directions(times, **drive, **law), axis=0)[0]
            found.append(_onset(p, rest.begin, rest.end, again.end, complex(*way)))
    return tuple(found)


def _onset(p: Parameters, begin: float, end: float, until: float, way: complex) -> Onset:
    """The slip that begins at `end` [s], after a rest since `begin`, and lasts until `until`.

    way: along which the block stopped.
    """
    before = (end - begin) * np.linspace(0.0, 1.0, FINE) ** 2
    near = end + np.array([-0.5, 0.5]) * before[10]
    excess = np.abs(_forces(p, near)[0]) - _forces(p, near)[1]
    pull, friction = _forces(p, end - before)
    along = pull[0] / abs(pull[0])
    # on springs the block stops along `way`, along T towards which it turns at last, or between
    turn = complex(pull[-1]) / way
    ways = (way * (turn / abs(turn)) ** part for part in np.linspace(0.0, 1.0, WAYS))
    held = [_vibrating(pull[::-1], friction[::-1], one)[::-1] for one in ways]
    across = np.abs(np.imag(np.array(held) / along)).max(axis=0)
    rate = max(float(np.diff(excess)[0] / before[10]), 1e-9)
    return Onset(float(friction[0]), rate, until - end, before, across)


def _vibrating(pull: Vector, friction: Vector, way: complex) -> Vector:
    """The amplitude (k,) of the force during a rest, from T and F, after a slip along `way`."""
    found = []
    end = way / abs(way) * friction[0] - pull[0]
    for T, F in zip(pull.tolist(), friction.tolist(), strict=True):
        for side in (1, -1):
            tip = T + side * end
            if abs(tip) > F:
                end = side * (tip / abs(tip) * F - T)
        found.append(end)
    return np.array(found)
