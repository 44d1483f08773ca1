"""Taylor series of a slip in a variable in which it is regular where the body comes to rest.

With dt = |w| dtau, the law w' = T - F w/|w| becomes dw/dtau = |w| T - F w, d|w|/dtau = T.w - F |w|.
Both equations are linear in w and |w|, so that a complex time at which |w| = 0, a singularity of
the series in time, is none in tau. T and F are sums of sines of t, which are expanded too.
"""

from __future__ import annotations

import math

from vv.engines.exact.turn.series import ORDER, OVER, angle
from vv.engines.kernels.compiled import lent
from vv.scene import Vector

# Columns of q, in the order in which `_products` reads them:
FIRST = 3  # sines, each with its cosine, from column 0 on
SLIP, FORCE, AGAIN, SPEED = 6, 8, 12, 16  # w; T, F, F; w, w; |w|
FURTHER = 17  # the other sines, in groups of LOT
LOT = 4


def padded_count(sines: int) -> int:
    """The number of sines that `expand_slip` needs; additional ones have zero amplitude."""
    return FIRST + LOT * -(-max(sines - FIRST, 0) // LOT)


@lent
def expand_slip(
    rows: Vector, sines: Vector, t: float, cell: float, q: Vector, sums: Vector, out: Vector
) -> None:
    """The series in tau of a slip at time t [s].

    rows, sines: as in `follow_turning`, in the number that `padded_count` gives. The unit of tau is
    a time in which the slip changes its direction, or `cell` [s] if this is shorter. q (ORDER + 1,
    columns): w is given in the first row; sums: one row, overwritten. Filled: q, and out (ORDER +
    1, 3), the series of displacement [m], without its constant, and of time since t [s].
    """
    h = _expand_start(rows, sines, t, cell, q)
    out[0, 2] = 0.0
    for n in range(ORDER):
        _products(q, n, sums)
        for at in range(FURTHER, q.shape[1], 2 * LOT):
            _further_products(q, n, at, sums)
        step, speed = h * OVER[n], q[n, SPEED]
        out[n + 1, 0], out[n + 1, 1] = step * sums[SLIP], step * sums[SLIP + 1]
        out[n + 1, 2] = step * speed
        u, v, f = rows[0, 0] * speed, rows[1, 0] * speed, rows[2, 0] * speed  # |w| T, |w| F
        x, y, press = 0.0, 0.0, 0.0
        for j in range(len(sines)):
            at = 2 * j if j < FIRST else FURTHER + 2 * (j - FIRST)
            rate, sine = step * sines[j, 3], sums[at]
            risen = rate * sums[at + 1]
            q[n + 1, at], q[n + 1, at + 1] = risen, -rate * sine
            u += rows[0, 1 + j] * sine
            v += rows[1, 1 + j] * sine
            f += rows[2, 1 + j] * sine
            x += rows[0, 1 + j] * risen
            y += rows[1, 1 + j] * risen
            press += rows[2, 1 + j] * risen
        u, v = step * (u - sums[FORCE + 2]), step * (v - sums[FORCE + 3])
        _fill_columns(q, n + 1, step * (sums[FORCE] + sums[FORCE + 1] - f), u, v, x, y, press)


@lent
def _fill_columns(
    q: Vector, n: int, speed: float, u: float, v: float, x: float, y: float, f: float
) -> None:
    q[n, SPEED], q[n, SLIP], q[n, SLIP + 1] = speed, u, v
    q[n, AGAIN], q[n, AGAIN + 1], q[n, AGAIN + 2], q[n, AGAIN + 3] = u, v, u, v
    q[n, FORCE], q[n, FORCE + 1], q[n, FORCE + 2], q[n, FORCE + 3] = x, y, f, f


@lent
def _expand_start(rows: Vector, sines: Vector, t: float, cell: float, q: Vector) -> float:
    """Fill the first row of q for `expand_slip`; return the unit of tau [s2/m]."""
    x, y, f = rows[0, 0], rows[1, 0], rows[2, 0]
    for j in range(len(sines)):
        at = 2 * j if j < FIRST else FURTHER + 2 * (j - FIRST)
        now = angle(sines, j, t)
        sine = math.sin(now)
        q[0, at], q[0, at + 1] = sine, math.cos(now)
        x += rows[0, 1 + j] * sine
        y += rows[1, 1 + j] * sine
        f += rows[2, 1 + j] * sine
    u, v = q[0, SLIP], q[0, SLIP + 1]
    speed = math.hypot(u, v)
    _fill_columns(q, 0, speed, u, v, x, y, f)
    return float(1 / max(math.hypot(x, y) + abs(f), speed / cell))


@lent
def _products(q: Vector, n: int, sums: Vector) -> None:
    """Coefficients n of products: |w| with three sines, their cosines and w; T and F with w.

    They are written line by line, so that four lines become one vector operation (see
    `compiled_to_join`).
    """
    a = b = c = d = e = f = g = h = 0.0
    o = p = r = s = 0.0
    for i in range(n + 1):
        k = n - i
        speed = q[k, SPEED]
        a += speed * q[i, 0]
        b += speed * q[i, 1]
        c += speed * q[i, 2]
        d += speed * q[i, 3]
        e += speed * q[i, 4]
        f += speed * q[i, 5]
        g += speed * q[i, 6]
        h += speed * q[i, 7]
        o += q[k, AGAIN] * q[i, FORCE]
        p += q[k, AGAIN + 1] * q[i, FORCE + 1]
        r += q[k, AGAIN + 2] * q[i, FORCE + 2]
        s += q[k, AGAIN + 3] * q[i, FORCE + 3]
    sums[0], sums[1], sums[2], sums[3] = a, b, c, d
    sums[4], sums[5], sums[6], sums[7] = e, f, g, h
    sums[8], sums[9], sums[10], sums[11] = o, p, r, s


@lent
def _further_products(q: Vector, n: int, at: int, sums: Vector) -> None:
    """Coefficients n of products of |w| with four sines and their cosines, from column `at` on."""
    a = b = c = d = e = f = g = h = 0.0
    for i in range(n + 1):
        speed = q[n - i, SPEED]
        a += speed * q[i, at]
        b += speed * q[i, at + 1]
        c += speed * q[i, at + 2]
        d += speed * q[i, at + 3]
        e += speed * q[i, at + 4]
        f += speed * q[i, at + 5]
        g += speed * q[i, at + 6]
        h += speed * q[i, at + 7]
    sums[at], sums[at + 1], sums[at + 2], sums[at + 3] = a, b, c, d
    sums[at + 4], sums[at + 5], sums[at + 6], sums[at + 7] = e, f, g, h
