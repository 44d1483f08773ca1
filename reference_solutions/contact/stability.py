"""The largest stable step of leapfrogs on a linear contact, with drag at two times.

m x'' = -K x - eta x', w^2 = K/m, n = eta/2m. The leapfrog m (v+ - v-)/dt = -K x - eta (lag v- +
(1 - lag) v+), x+ = x + v+ dt has a root of size 1 first where it is -1, at
(w dt)^2/4 + (2 lag - 1) n dt = 1: drag at the middle, lag = 1/2, leaves 2/w; drag of the step
before, lag = 1 (Li et al. 2018, Eqs. 9-12), gives 2 (sqrt(n^2 + w^2) - n)/w^2.
Every function raises ValueError for parameters outside their ranges.
"""

from math import sqrt

from reference_solutions.parameters import require_at_least_0, require_positive


def centred(w: float) -> float:
    """The largest stable step [s] of the leapfrog without drag or with drag at the middle."""
    require_positive("1/s", w=w)
    return 2.0 / w


def lagged(w: float, n: float) -> float:
    """The largest stable step [s] of the leapfrog with drag at the velocity before; w, n [1/s]."""
    require_positive("1/s", w=w)
    require_at_least_0("1/s", n=n)
    return 2.0 / (sqrt(n * n + w * w) + n)
