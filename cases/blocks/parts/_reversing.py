"""A block that slips downhill and uphill in turn, or turns: what springs and steps delay adds up.

Where slip turns, friction is late by half a step: see `turned`. Downhill and uphill, on springs, T
is the force along the plane and F the friction, over the mass. An error dv of the speed moves the
next reversal of slip by dv/(|T| + F), and from there on the speed changes by |T| - F: what is left
of it is dv (|T| - F)/(|T| + F). Until then the displacement errs by dv times the time. To dv add

- at a reversal, the shear spring, w^2 = ks/m, which has to be bent from F to -F: its force is
  (|T| + F) cos(wt) - |T|, so that slip begins at cos(wt) = (|T| - F)/(|T| + F), with a speed that
  is wrong by (|T| + F) sin(wt)/w - (|T| - F) t;
- where slip ends and T is against it, the same spring, which throws the block back at
  2 sqrt(|T| F)/w within pi/w. Then friction takes that at F - |T|, or half of it as T grows until
  slip begins again;
- shaking with the frequency q w, w^2 = kn/m, which presses the block with A sin(alpha): springs
  press it with q^2/(1 - q^2) of that too much, and a vibration of q/(1 - q^2) of it is left. The
  impulse of friction before and after is wrong by 2/w times tan(phi) of the latter, for each;
- where slip begins, the speed at which the shear spring yields to T - F, which changes by T' in a
  second: T'/w^2, and as much again for the vibration that shaking leaves as it begins;
- friction that reverses at the end of a step, late by a step at most.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from cases.blocks.parts._vibrating import SHEAR
from reference_solutions.blocks import incline
from vv.case import Parameters
from vv.scene import Vector

STRETCHES = 3.0  # of the shear spring by which a block that comes to rest is displaced
LIFTED = np.inf  # an error that is not bounded
FINE, NEAR = 200.0, 1e-6  # samples of a period of the faster sine, and the distance of two of them
RESTS = 1e-6  # of the fastest slip: what is slower rests


class Phase(NamedTuple):
    """A slip or rest: its length [s], T and F at its begin [m/s2], and its direction, 0 for rest.

    after: the direction of what was before it, 0 for rest.
    """

    length: float
    pull: float
    friction: float
    way: int
    after: int


def phases(p: Parameters) -> tuple[Phase, ...]:
    """The slips and rests of the exact motion."""
    law = {name: p[name] for name in ("alpha", "phi", "A", "f", "g", "v0")}
    dip, mu, after, made = np.radians(p["alpha"]), np.tan(np.radians(p["phi"])), 0, []
    for one in incline.newmark_phases(p["duration"], **law):
        shaken = p["A"] * np.sin(2 * np.pi * p["f"] * one.begin)
        pull = p["g"] * np.sin(dip) + shaken * np.cos(dip)
        friction = mu * (p["g"] * np.cos(dip) - shaken * np.sin(dip))
        length = min(one.end, p["duration"]) - one.begin
        made.append(Phase(length, float(pull), float(friction), one.direction, after))
        after = one.direction
    return tuple(made)


def on_springs(motion: tuple[Phase, ...], p: Parameters, square: float) -> float:
    """The error of the displacement [m] on springs with w^2 [1/s2]; inf where the block lifts off.

    It does where its weight does not hold down the vibration and what springs press too much.
    """
    dip, q = np.radians(p["alpha"]), 2 * np.pi * p["f"] / np.sqrt(square)
    shaken = p["A"] * np.sin(dip)
    if q >= 1.0 or shaken / (1.0 - q) >= p["g"] * np.cos(dip):
        return LIFTED
    mu = np.tan(np.radians(p["phi"]))
    pressed = 4 * mu * shaken * q / (1 - q**2) / np.sqrt(square)
    begun = 2 * 2 * np.pi * p["f"] * (p["A"] * np.cos(dip) + mu * shaken) / (SHEAR * square)
    return displaced(motion, float(np.sqrt(SHEAR * square)), float(pressed + begun))


def displaced(motion: tuple[Phase, ...], w: float, pressed: float) -> float:
    """The error of the displacement [m] on shear springs of frequency w [1/s].

    pressed: the speed [m/s] by which vibrations err where slip begins.
    """
    bent = thrown = speed = along = farthest = 0.0
    for one in motion:
        if one.way:
            left = _left(one)
            along = left * along + one.way * _bent(one, w)
            speed = left * speed + pressed
            thrown += speed * one.length
            bent += along * one.length
        else:
            along, speed = 0.0, _thrown(one, w)
            slowed = max(one.friction - abs(one.pull), 0.0) / 2 * max(one.length - np.pi / w, 0.0)
            thrown += speed * one.length / (1.0 + slowed / speed if speed else 1.0)
            thrown += STRETCHES * one.friction / w**2 * bool(one.after)
            speed = max(0.0, speed - slowed)
        farthest = max(farthest, abs(bent) + thrown)
    return farthest


def in_steps(motion: tuple[Phase, ...]) -> float:
    """The error of the displacement because friction reverses late, over the step [m/s]."""
    speed = total = 0.0
    for one in motion:
        reverses = one.way * one.after < 0
        speed = _left(one) * speed + (one.friction if reverses else 0.0) if one.way else 0.0
        total += speed * one.length
    return total


def _left(one: Phase) -> float:
    """The part of an error of the speed that is left at the begin of a slip."""
    if not one.way * one.after < 0:
        return 1.0
    return max(abs(one.pull) - one.friction, 0.0) / (abs(one.pull) + one.friction)


def _bent(one: Phase, w: float) -> float:
    """The speed [m/s] that the shear spring adds where slip reverses."""
    if not one.way * one.after < 0:
        return 0.0
    both, left = abs(one.pull) + one.friction, max(abs(one.pull) - one.friction, 0.0)
    angle = np.arccos(left / both)
    return float((both * np.sin(angle) - left * angle) / w)


def _thrown(one: Phase, w: float) -> float:
    """The speed [m/s] at which the shear spring throws back a block whose slip ends."""
    against = one.pull * one.after < 0
    return float(2 * np.sqrt(abs(one.pull) * one.friction) / w) if against else 0.0


def turned(p: Parameters) -> float:
    """The error of the displacement because friction turns half a step late, over the step [m/s].

    Friction F u acts against slip w = |w| u. In each second F u'/2 of the step goes to an error of
    the speed, of which friction takes back what is across slip, at the rate F/|w|; where the block
    rests, nothing is left of it. Steps are implicit, since that is fast where slip is slow.
    """
    slip, friction, step = _slip(p)
    speed = place = 0j
    before, farthest = None, 0.0
    rests = RESTS * float(np.abs(slip).max())
    for w, F in zip(slip.tolist(), friction.tolist(), strict=True):
        size = abs(w)
        if size <= rests:
            before, speed = None, 0j
            continue
        way = w / size
        if before is not None:
            speed += F * (way - before) / 2
        part = (speed * way.conjugate()).real * way
        speed = part + (speed - part) / (1 + step * F / size)
        place += step * speed
        before, farthest = way, max(farthest, abs(place))
    return farthest


def _slip(p: Parameters) -> tuple[Vector, Vector, float]:
    """Slip [m/s], down the dip and, as imaginary part, along the strike, F [m/s2], and the step."""
    drive = {"ax": p["A"], "fx": p["f"], "ay": p["Ay"], "fy": p["fy"]}
    law = {name: p[name] for name in ("alpha", "phi", "g")}
    fastest = max(p["f"], p["fy"])
    t = np.linspace(0.0, p["duration"], int(FINE * fastest * p["duration"]) + 3)[1:-1]
    near = NEAR / fastest
    ends = [incline.two_directions(at, **drive, **law) for at in (t - near, t + near)]
    speed = (ends[1] - ends[0]) @ np.array([1, 1j]) / (2 * near)
    dip, mu = np.radians(p["alpha"]), np.tan(np.radians(p["phi"]))
    pressed = p["g"] * np.cos(dip) - p["A"] * np.sin(2 * np.pi * p["f"] * t) * np.sin(dip)
    return speed, mu * pressed, float(t[1] - t[0])
