"""The number of collisions of two balls and a wall when the heavy ball drives the light one.

All move along one line without friction and loss. In the plane of (sqrt(M) X, sqrt(m) x) the state
is a point that moves straight and is mirrored at the sides of a wedge: at x = 0, the wall, and at
x = X, the other ball. The wedge opens by theta = atan(sqrt(m/M)); unfolded, the path is one
straight line that crosses as many sides as fit into half a turn (Galperin 2003, Regular and Chaotic
Dynamics 8(4), 375-394).

Springs between the bodies change none of this as long as no two act at once: each mirrors the
direction as a hard contact does, only later. Every function raises ValueError for parameters
outside their ranges.
"""

from math import atan, ceil, pi, sqrt, tan

from reference_solutions.parameters import require_positive

_MARGIN = 1e-9  # of a collision: closer to a last one that is never reached, rounding decides


def opening(m: float, M: float) -> float:
    """The angle theta [rad] of the wedge, of the light mass m and the heavy mass M [kg]."""
    require_positive("kg", m=m, M=M)
    return atan(sqrt(m / M))


def collisions(m: float, M: float) -> int:
    """The number of collisions of both kinds: the largest n with n theta < pi."""
    fits = pi / opening(m, M)
    if abs(fits - round(fits)) < _MARGIN * fits:
        raise ValueError(
            f"M/m = {M / m!r}; half a turn holds the wedge {fits!r} times, so that the last "
            "collision is a matter of rounding"
        )
    return ceil(fits) - 1


def last(m: float, M: float, x: float, X: float, v: float) -> float:
    """The time of the last collision [s] of hard bodies.

    At t = 0 the light ball rests at x [m] from the wall, the heavy one at X > x comes with v [m/s];
    distances without the radii.
    """
    require_positive("in SI units", x=x, X=X, v=v)
    if x >= X:
        raise ValueError(f"X = {X} m, x = {x} m; the heavy ball must be behind the light one")
    beyond = pi - collisions(m, M) * opening(m, M)
    return (X + x * sqrt(m / M) / tan(beyond)) / v
