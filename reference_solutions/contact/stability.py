"""The largest stable step of leapfrogs on a linear contact with drag, centred or lagged.

For m x'' = -K x - eta x', w^2 = K/m, n = eta/2m, the leapfrog is m (v+ - v-)/dt = -K x - eta (lag
v- + (1 - lag) v+), x+ = x + v+ dt. As the step grows, instability begins with an eigenvalue of -1,
at (w dt)^2/4 + (2 lag - 1) n dt = 1. With centred drag, lag = 1/2, the limit is 2/w; with
the drag of the velocity before the step, lag = 1 (Li et al. 2018, Eqs. 9-12), it is
2 (sqrt(n^2 + w^2) - n)/w^2. Every function raises ValueError for parameters outside their ranges.
"""

from math import sqrt

from reference_solutions.parameters import require_at_least_0, require_positive


def centred(w: float) -> float:
    """The largest stable step [s] of the leapfrog without drag or with centred drag; w [1/s]."""
    require_positive("1/s", w=w)
    return 2.0 / w


def lagged(w: float, n: float) -> float:
    """The largest stable step [s] of the leapfrog with drag of the velocity v-; w, n [1/s]."""
    require_positive("1/s", w=w)
    require_at_least_0("1/s", n=n)
    return 2.0 / (sqrt(n * n + w * w) + n)
