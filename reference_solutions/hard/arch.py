"""The thinnest semicircular arch of n equal voussoirs that stands under its weight without slip.

In the limit the line of thrust of half an arch passes through the outer edges of the crown and of
the springing; the horizontal thrust H follows from moments about the latter. The arch stands if the
line passes above the inner edge of every joint between them: H (y_c - y_j) is at least the moment
of the weights above about that edge. Where the two are equal the arch is a mechanism of five hinges
(Heyman 1969, International Journal of Mechanical Sciences 11, 363-385). Thickness is in mean radii.
Every function raises ValueError for parameters outside their ranges.
"""

from collections.abc import Callable
from math import cos, pi, sin


def thinnest_of_chords(n: int) -> float:
    """The least t of voussoirs with straight edges, corners on the radii R - t/2 and R + t/2."""
    return _thinnest(n, _of_chord)


def thinnest_of_arcs(n: int) -> float:
    """The least t of voussoirs with circular edges; it tends to 0.10748 for large n."""
    return _thinnest(n, _of_arc)


def stands(n: int, t: float, mu: float) -> bool:
    """Whether n blocks with straight edges and this friction have an equilibrium.

    Half an arch with a horizontal thrust H at a height y of the crown is sufficient, since the mean
    of an equilibrium and its mirror image is an equilibrium. At each joint the resultant of the
    thrust and the weights above must lie between the edges, which bounds H y from below and from
    above by linear functions of H, and within Coulomb's limit, which bounds H. Every lower bound of
    H y must be at most every upper one; so all conditions have the form a H <= b. An odd number
    has no joint at the crown, and the half arch begins with half of a block.
    """
    if n < 6:
        raise ValueError(f"n = {n}; at least 6 voussoirs are covered")
    if not (0.0 < t < 2.0 and mu >= 0.0):
        raise ValueError(f"t = {t}, mu = {mu}; 0 < t < 2 mean radii and mu >= 0 are covered")
    opening, inner, outer = pi / n, 1.0 - t / 2.0, 1.0 + t / 2.0
    parts = _parts(n, t)
    above, below, bounds = [], [], []
    for j in range(n % 2, len(parts) + 1):
        weight = sum(w for w, _ in parts[:j])
        a = opening * weight
        above.append((inner * cos(a), sum(w * (inner * sin(a) - x) for w, x in parts[:j])))
        below.append((outer * cos(a), sum(w * (outer * sin(a) - x) for w, x in parts[:j])))
        bounds += [
            (-way * sin(a) - mu * cos(a), weight * (mu * sin(a) - way * cos(a)))
            for way in (-1.0, 1.0)
        ]
    bounds += [(y - z, m - k) for y, k in above for z, m in below]
    least = max([0.0, *(b / a for a, b in bounds if a < 0.0)])
    most = min(b / a for a, b in bounds if a > 0.0)
    return least <= most and all(b >= 0.0 for a, b in bounds if a == 0.0)


def _parts(n: int, t: float) -> list[tuple[float, float]]:
    """Weight and distance from the axis of the blocks of half an arch, from the crown down.

    Half of a block counts as on the axis: it lies above all joints, and its moment only changes the
    height of the thrust, which is free.
    """
    opening, odd = pi / n, n % 2
    out = _of_chord(t, opening)
    whole = [(1.0, out * sin(opening * (k + 0.5 + odd / 2.0))) for k in range(n // 2)]
    return [(0.5, 0.0)] * odd + whole


def _of_chord(t: float, opening: float) -> float:
    """The distance of the centroid of a voussoir from the centre of the arch."""
    inner, outer = 1.0 - t / 2.0, 1.0 + t / 2.0
    return (inner + t / 3.0 * (inner + 2.0 * outer) / (inner + outer)) * cos(opening / 2.0)


def _of_arc(t: float, opening: float) -> float:
    inner, outer = 1.0 - t / 2.0, 1.0 + t / 2.0
    ring = (2.0 / 3.0) * (outer**3 - inner**3) / (outer**2 - inner**2)
    return ring * sin(opening / 2.0) / (opening / 2.0)


def _thinnest(n: int, out: Callable[[float, float], float]) -> float:
    """The least thickness by bisection, to rounding; out(t, opening): radius of a centroid."""
    if n < 6 or n % 2:
        raise ValueError(f"n = {n}; an even number of at least 6 voussoirs is covered")
    falls, stands = 0.02, 0.5
    while falls < (middle := (falls + stands) / 2.0) < stands:
        if _least(middle, n, out) < 0.0:
            falls = middle
        else:
            stands = middle
    return stands


def _least(t: float, n: int, out: Callable[[float, float], float]) -> float:
    """The least moment about an inner edge, over R and a weight; the arch falls below zero."""
    opening = pi / n
    far = [out(t, opening) * sin(opening * (k + 0.5)) for k in range(n // 2)]
    outer, inner = 1.0 + t / 2.0, 1.0 - t / 2.0
    thrust = sum(outer - x for x in far) / outer
    clear = []
    for j in range(1, n // 2):
        x, y = inner * sin(opening * j), inner * cos(opening * j)
        clear.append(thrust * (outer - y) - sum(x - one for one in far[:j]))
    return min(clear)
