"""The number of collisions of two balls and a wall when the heavy ball hits the light one.

The balls move along one line without friction or loss of energy. In the plane of (sqrt(M) X,
sqrt(m) x) the state is a point that moves along straight lines and is reflected at the sides of a
wedge: at x = 0 by the wall, at x = X by the other ball. The angle of the wedge is theta =
atan(sqrt(m/M)). Unfolded by reflections, the path is one straight line, which crosses as many sides
as there are multiples of theta below pi (Galperin 2003, Regular and Chaotic Dynamics 8(4),
375-394).

The number stays the same with springs between the bodies as long as no two act at once: each
reflects the path like a hard contact, but later. Every function raises ValueError for parameters
outside their ranges.
"""

from math import atan, ceil, pi, sqrt, tan

from reference_solutions.parameters import require_positive

_MARGIN = 1e-9  # relative distance of pi/theta to an integer within which rounding decides


def opening(m: float, M: float) -> float:
    """The angle theta [rad] of the wedge for the light mass m and the heavy mass M [kg]."""
    require_positive("kg", m=m, M=M)
    return atan(sqrt(m / M))


def collisions(m: float, M: float) -> int:
    """The number of collisions, with the wall and between balls: the largest n, n theta < pi."""
    fits = pi / opening(m, M)
    if abs(fits - round(fits)) < _MARGIN * fits:
        raise ValueError(
            f"M/m = {M / m!r}; half a turn holds the wedge {fits!r} times, so that the last "
            "collision is a matter of rounding"
        )
    return ceil(fits) - 1


def last(m: float, M: float, x: float, X: float, v: float) -> float:
    """The time [s] of the last collision of hard bodies.

    At t = 0 the light ball is at rest at the distance x [m] from the wall, and the heavy one
    approaches it from X > x at v [m/s]. The radii are not part of the distances.
    """
    require_positive("in SI units", x=x, X=X, v=v)
    if x >= X:
        raise ValueError(f"X = {X} m, x = {x} m; the heavy ball must be behind the light one")
    beyond = pi - collisions(m, M) * opening(m, M)
    return (X + x * sqrt(m / M) / tan(beyond)) / v
