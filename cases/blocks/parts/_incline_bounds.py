"""Bounds of a block on an incline: rigid contact by the order of a step, and springs."""

from __future__ import annotations

import dataclasses
import functools

import numpy as np

from cases.blocks.parts import _reversing
from cases.blocks.parts._vibrating import resounding, slips_on
from reference_solutions.blocks import incline
from vv.ask import Knobs, Method
from vv.case import Exact, Parameters, Tolerance

SIDE, DENSITY = 1.0, 2500.0  # m, kg/m3 times m of height: neither enters the answer
STEP = 1e-3  # s
SPRING, MASS = 1e8, DENSITY * SIDE**2  # N/m, kg
ONE_WAY, CORNERS = 3.0, 7.0  # CORNERS is for a plate with a spring at each corner
ROUNDED = (
    "forces are constant and springs start charged, so that no slip begins or ends: the answer is "
    "a parabola, and only rounding errors of up to 100 000 steps remain"
)
ASIDE = (
    "the block slides down most of the time: friction that errs, or that a spring delays, acts "
    "mainly along the dip"
)
STEADY = {
    Method.EXACT: Tolerance(
        1e-13, "only rounding errors of at most a few hundred located events remain"
    ),
    **dict.fromkeys(
        (Method.SECOND_ORDER, Method.STRAIGHT, Method.PENALTY, Method.LAGGING),
        Tolerance(1e-11, ROUNDED),
    ),
}


def free_fall(p: Parameters) -> float:
    """The height of a free fall [m], which scales errors where friction holds the block."""
    return 0.5 * p["g"] * p["duration"] ** 2


def along_dip(p: Parameters, own: bool) -> Exact:
    """In one direction: parabolas are exact, sines have the order of the step, and springs lag.

    own: the parameters are the case's, at which lagging friction is nearly right in long steps too.
    """
    if not p["A"] and (p["alpha"] > p["phi"] or not p["v0"]):
        return Exact({**STEADY, Method.FIRST_ORDER: _half_steps(p)})
    cycles = max(1.0, p["f"] * p["duration"])
    swings = cycles * p["A"] / (2 * np.pi * p["f"]) ** 2 / _largest_slip(p)
    sine = Tolerance(
        _sine_error(p["f"] if p["A"] else 0.0, max(1.0, swings)),
        "the trapezoidal rule integrates gravity exactly, and the sine with an error of "
        "(w dt)^2/12 of its amplitude A/w^2 in each cycle, or of the slip if that is larger; twice "
        "that is allowed. Events are located within the step",
        dt=STEP,
        order=2,
        floor=1e-9,
    )
    steep = p["alpha"] + p["phi"]
    uphill = steep < 90 and p["A"] > p["g"] * np.tan(np.radians(steep))
    springs = _turning(p) if uphill else _stopping(p, ONE_WAY)
    rigid = {
        Method.SECOND_ORDER: sine,
        Method.STRAIGHT: _whole_stops(p, sine),
        Method.FIRST_ORDER: _half_steps(p),
    }
    on_springs = _on_springs(_started_late(p, springs))
    if uphill and not own:
        on_springs[Method.LAGGING] = _reversing_late(p, on_springs[Method.LAGGING])
    return Exact({**on_springs, **rigid, Method.EXACT: _rounded(p)})


def _rounded(p: Parameters) -> Tolerance:
    """For events that are located, and for weight and friction that nearly balance."""
    lost = np.finfo(float).eps * free_fall(p) * 2 / _largest_slip(p)
    return Tolerance(
        max(STEADY[Method.EXACT].value, float(lost)),
        "only rounding errors of at most a few hundred located events remain, and of weight and "
        "friction, the last digit of g T^2 if they nearly balance",
    )


def _started_late(p: Parameters, springs: Tolerance) -> Tolerance:
    """For a block that slips from the start, where the motion may start half a step late."""
    if not (p["alpha"] > p["phi"] or p["v0"]):
        return springs
    gained = abs(p["g"] * np.sin(np.radians(p["alpha"])) - _friction(p)) * p["duration"]
    return dataclasses.replace(
        springs,
        late=springs.late + float(gained / 2 / _largest_slip(p)),
        reason=f"{springs.reason}; where the motion starts half a step late, it lacks a dt/2 of "
        "the speed, a its acceleration at the start",
    )


def _reversing_late(p: Parameters, lagging: Tolerance) -> Tolerance:
    """For friction of the iteration before, where slip reverses."""
    return dataclasses.replace(
        lagging,
        late=_friction(p) * p["duration"] / _largest_slip(p),
        reason=f"{lagging.reason}; and in a step in which slip reverses, friction may act along "
        "it: an error of the speed of up to 2 mu N dt/m, which the next reversal takes back half a "
        "cycle later, and so of mu N T dt/m of the displacement",
    )


def in_two_directions(p: Parameters, swept: bool, slid: float) -> tuple[Exact, Exact]:
    """Along dip and strike; swept: sweeps over the four corners of a plate solve its contacts.

    slid: the largest displacement [m].
    """
    stopping = _stopping(p, CORNERS if swept else ONE_WAY)
    springs = _on_springs(
        dataclasses.replace(
            stopping,
            reason=f"{stopping.reason}. Springs that nothing damps vibrate while the block rests, "
            "and it slips farther for what vibrates across the slip that follows",
            more=slips_on(p, MASS, slid),
        )
    )
    first = _turned_late(p, slid)
    rigid = {Method.SECOND_ORDER: _rotating(p, swept, slid), Method.FIRST_ORDER: first}
    both = {**springs, **rigid}
    aside = {m: dataclasses.replace(one, slack=one.slack or ASIDE) for m, one in both.items()}
    return Exact(both), Exact(aside)


def _half_steps(p: Parameters) -> Tolerance:
    """For rigid contact with the forces, or the contact law, of one end of a step."""
    speed = np.hypot(p["A"] / p["f"], p["Ay"] / p["fy"]) / (2 * np.pi)
    return Tolerance(
        STEADY[Method.SECOND_ORDER].value,
        "the motion starts half a step late, an error of dt/T of the displacement. Friction acts "
        "with its value at the end of a step: where slip stops or reverses it is up to half a step "
        "late, at the speed that shaking gives",
        late=1.2 * (1 / p["duration"] + float(speed) / _largest_slip(p)),
        slack="a scheme that starts in the middle of a step follows a parabola to rounding",
    )


def _turned_late(p: Parameters, slid: float) -> Tolerance:
    """For rigid contact of first order in two directions, where friction turns late."""
    late, turned = _half_steps(p), functools.cache(lambda: _reversing.turned(p))
    return dataclasses.replace(
        late,
        reason=f"{late.reason}. Where slip turns, friction turns half a step later: F u'/2 of the "
        "step goes to the speed in a second, F u friction, which takes back what is across slip",
        least=lambda dt: 1.2 * dt * (1 / p["duration"] + turned() / slid),
    )


def _whole_stops(p: Parameters, sine: Tolerance) -> Tolerance:
    """For positions of second order, in steps that slip may begin and end within."""
    cycles = max(1.0, p["f"] * p["duration"] if p["A"] else 0.0)
    left = 2 * cycles * (p["A"] + _friction(p)) * STEP**2 / 8 / _largest_slip(p)
    return Tolerance(
        sine.uncut(Knobs(STEP)) + left,
        "the sine has an error of (w dt)^2/12, of which twice is allowed. In each cycle slip "
        "begins once and ends once within a step: the displacement that is left there is "
        "a (dt/2)^2/2 at most, a the largest acceleration",
        dt=STEP,
        order=2,
        floor=sine.floor,
    )


def _sine_error(f: float, over: float = 1.0) -> float:
    """`over` (w dt)^2/6 at the step STEP for a frequency [Hz], 1e-9 at least."""
    return max(float(over * (2 * np.pi * f * STEP) ** 2 / 6), 1e-9)


def _on_springs(late: Tolerance) -> dict[Method, Tolerance]:
    """The tolerances of a block on springs; lagging friction doubles the error."""
    lagging = Tolerance(
        2 * late.value,
        f"lagging friction doubles this error: {late.reason}",
        kn=late.kn,
        softness=late.softness,
        late=2 * late.late,
        slack=late.slack,
        more=late.more,
    )
    return {
        Method.EXACT: STEADY[Method.EXACT],
        Method.PENALTY: late,
        Method.LAGGING: lagging,
    }


def _largest_slip(p: Parameters) -> float:
    """The largest displacement [m] of the block under the shaking along the dip alone."""
    way = {name: p[name] for name in ("alpha", "phi", "A", "f", "g", "v0")}
    slid = float(np.abs(incline.newmark(np.linspace(0.0, p["duration"], 101), **way)).max())
    return slid or free_fall(p)


def _friction(p: Parameters) -> float:
    """The friction that the weight alone allows, over the mass [m/s2]."""
    normal = p["g"] * np.cos(np.radians(p["alpha"]))
    return float(normal * np.tan(np.radians(p["phi"])))


def _stopping(p: Parameters, times: float) -> Tolerance:
    """For a block that stops and slips again; times: stretches of its shear spring per cycle."""
    cycles = max(1.0, max(p["f"], p["fy"] if p["Ay"] else 0.0) * p["duration"])
    stretch = max(times * _friction(p), 0.0 if p["Ay"] else _sinking(p)) * MASS / SPRING
    fastest = max(p["f"] if p["A"] else 0.0, p["fy"] if p["Ay"] else 0.0)
    stretch *= resounding(2 * np.pi * fastest, SPRING / MASS)
    speed = np.hypot(p["A"] / p["f"], p["Ay"] / p["fy"]) / (2 * np.pi)
    return Tolerance(
        max(float(cycles * stretch / _largest_slip(p)), 1e-9),
        f"each cycle of slip and rest costs up to {times:g} stretches mu N/ks of the shear spring, "
        "or the slip that sinking adds where slip begins and ends, over 1 - m w^2/kn. Shaking acts "
        "half a step late, and so do gravity and friction if the block slides from the start; slip "
        "stops at the end of a step",
        kn=SPRING,
        softness=1,
        late=1.2 * (float(speed) + _start_error(p)) / _largest_slip(p),
    )


def _sinking(p: Parameters) -> float:
    """The displacement that sinking adds in a cycle, over m/kn [m/s2].

    The block sinks by m A sin(alpha) sin(wt)/kn. As it sinks, friction changes the speed of slip by
    tan(phi) times the speed of sinking, w m A sin(alpha) tan(phi)/kn at most; the oscillation that
    the start leaves adds as much again. This happens where slip begins and where it ends, and lasts
    for a cycle 2 pi/w.
    """
    alpha, phi = np.radians([p["alpha"], p["phi"]])
    return float(4.0 * 2.0 * np.pi * p["A"] * np.sin(alpha) * np.tan(phi))


def _start_error(p: Parameters) -> float:
    """The error of a start half a step late, over the step [m/s], of a block that slides at once.

    It is half the change of speed that weight and friction cause until the end, or until the block
    stops.
    """
    pull = p["g"] * float(np.sin(np.radians(p["alpha"]))) - _friction(p)
    if pull > 0:
        return 0.5 * pull * p["duration"]
    return 0.5 * min(abs(p["v0"]), -pull * p["duration"])


def _turning(p: Parameters) -> Tolerance:
    """For a block that slips downhill and uphill in turn."""
    motion, largest = _reversing.phases(p), _largest_slip(p)
    return Tolerance(
        1e-9,
        "springs and whole steps change the speed at each reversal, at each stop and where slip "
        "begins, and at the next reversal friction takes a part of that back: the shear spring is "
        "bent from one side to the other, or throws back a block that comes to rest; the block "
        "vibrates across the plane with q/(1 - q^2) of what shaking of frequency q w presses, and "
        "sinks. Where it lifts off, nothing is known",
        late=_reversing.in_steps(motion) / largest,
        more=lambda kn: _reversing.on_springs(motion, p, kn / MASS) / largest,
    )


def _rotating(p: Parameters, swept: bool, slid: float) -> Tolerance:
    """For second order, where the direction of slip rotates."""
    left = "; iterations over four contacts leave a residual in each of 240 000 steps"
    fastest = max(p["f"], p["fy"])
    shaken = (p["A"] / p["f"] ** 2 + p["Ay"] / p["fy"] ** 2) / (2.0 * np.pi) ** 2
    swings = max(1.0, fastest * p["duration"]) * float(shaken) / slid
    return Tolerance(
        _sine_error(fastest, max(1.0, swings)),
        "where the direction of slip rotates, friction acts along its mean direction over a step, "
        "an error of (w dt)^2/12 of the slip, or of the amplitudes A/w^2 of the shaking in each "
        f"cycle if they are larger; twice that is allowed{left if swept else ''}",
        dt=STEP,
        order=2,
        floor=3e-7 if swept else 1e-8,
    )
