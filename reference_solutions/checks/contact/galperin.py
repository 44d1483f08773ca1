"""The collisions of two balls and a wall in sequence, number and last time: the second route.

Each collision follows from the conservation of momentum and energy; the path is not unfolded.
"""

from fractions import Fraction
from typing import TypeVar

Number = TypeVar("Number", float, Fraction)


def collide(
    m: Number, M: Number, *, x: Number, X: Number, v: Number, most: int = 100_000
) -> tuple[int, Number]:
    """The number of collisions, and the time [s] of the last; masses [kg], lengths [m].

    The light ball is at rest at the distance x from the wall; the heavy one approaches it from X at
    v [m/s]. The result is exact for fractions. Raises RuntimeError beyond `most` collisions.
    """
    none = v - v
    u, w, now = none, -v, none  # velocities of the light and the heavy ball, and time
    for found in range(most):
        wall = -x / u if u < 0 else None
        balls = (X - x) / (u - w) if u > w else None
        if wall is None and balls is None:
            return found, now
        first = min(t for t in (wall, balls) if t is not None)
        now, x, X = now + first, x + u * first, X + w * first
        if first == wall:
            x, u = none, -u
        else:
            mean = (m * u + M * w) / (m + M)
            X, u, w = x, 2 * mean - u, 2 * mean - w
    raise RuntimeError(f"more than {most} collisions by t = {now} s")
