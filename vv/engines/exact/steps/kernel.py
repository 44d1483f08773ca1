"""Steps a slip on a rigid wall: by a short series, or in closed form where it turns fast."""

from __future__ import annotations

import math

from vv.engines.exact.steps.frozen import frozen_slip, slowly_turned
from vv.engines.exact.steps.onset import started
from vv.engines.kernels.compiled import compiled
from vv.scene import Vector


@compiled
def follow_steps(
    rows: Vector, sines: Vector, now: Vector, start: Vector, stride: int, out: Vector
) -> int:
    """Fill out (k, 4): displacement [m] and velocity [m/s] of slip every `stride` steps.

    rows (3, 1 + k) [m/s2]: the two components of T, and F, as constants and amplitudes of sines.
    sines (k, 9): sine and cosine in the middle of the first step, cosine and sine of the phase of a
    step, the mean of a sine over a step divided by its value in the middle, and cosine and sine of
    half a step and of three halves. now (k, 2): for work. start (6,): velocity (2,) [m/s], the step
    [s], `far`, and acceleration (2,) [m/s2].

    The series of a slip that turns slowly is used where |w| exceeds `far` times the change of
    velocity that the forces can cause in a step. Places are sums by the trapezoidal rule, which
    lacks h^2/12 of the change of the acceleration since the slip began; this is added where a slip
    ends. There slips of all cycles would add up, because each ends against friction.
    """
    u, v, h, far, place_x, place_y = start[0], start[1], start[2], start[3], 0.0, 0.0
    since_x, since_y = start[4], start[5]
    for i in range(len(sines)):
        now[i, 0], now[i, 1] = sines[i, 0], sines[i, 1]
    out[0, 0], out[0, 1], out[0, 2], out[0, 3] = 0.0, 0.0, u, v
    for row in range(1, len(out)):
        for _ in range(stride):
            x, y, friction = rows[0, 0], rows[1, 0], rows[2, 0]
            for i in range(len(sines)):
                sine, cosine = now[i, 0], now[i, 1]
                mean = sine * sines[i, 4]
                x += rows[0, 1 + i] * mean
                y += rows[1, 1 + i] * mean
                friction += rows[2, 1 + i] * mean
                now[i, 0] = sine * sines[i, 2] + cosine * sines[i, 3]
                now[i, 1] = cosine * sines[i, 2] - sine * sines[i, 3]
            before_u, before_v, old, new = u, v, h, h
            speed_2, most = u * u + v * v, far * h * (abs(x) + abs(y) + friction)
            if speed_2 > most * most:
                u, v = slowly_turned(u, v, x, y, friction, h)
            elif speed_2 > 0.0:
                u, v, old = frozen_slip(u, v, x, y, friction, h)
                if old < h:
                    new, over = h - old, friction / math.sqrt(speed_2)
                    place_x += h * h / 12 * (since_x - x + over * before_u)
                    place_y += h * h / 12 * (since_y - y + over * before_v)
                    since_x, since_y = u / new, v / new
            else:
                u, v, new, since_x, since_y = started(rows, sines, now, x, y, friction, h)
            place_x += 0.5 * (old * before_u + new * u)
            place_y += 0.5 * (old * before_v + new * v)
        out[row, 0], out[row, 1], out[row, 2], out[row, 3] = place_x, place_y, u, v
    return len(out)
