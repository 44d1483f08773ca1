"""The two variants of the leapfrog, which differ in its start and in the treatment of drag."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Leapfrog:
    """m (v+ - v-)/dt = F(x) - eta (lag v- + (1 - lag) v+), x+ = x + v+ dt.

    lag: with 1/2 drag is evaluated at the mean of v- and v+, with 1 at the previous velocity. back:
    the first v- is v(0) - back dt a(0); 1/2 centres it in time, 0 sets it to v(0).

    Without drag the scheme conserves sum m v- v+/2 + springs at any step if the springs are linear,
    since the trapezoidal rule gives their work exactly. A spring that closes or opens within a step
    changes this sum by at most kn (v dt)^2/8, and at the start it differs by that between v- v+ and
    v(0)^2. Dissipation by friction and drag is summed by the same rule.
    """

    lag: float
    back: float

    def __post_init__(self) -> None:
        for name in ("lag", "back"):
            value = getattr(self, name)
            if not 0.0 <= value <= 1.0:
                raise ValueError(f"Leapfrog.{name} = {value!r}; it must lie between 0 and 1")


CENTRED = Leapfrog(lag=0.5, back=0.5)
"""Second order in every term."""

LAGGED = Leapfrog(lag=1.0, back=0.0)
"""As published (Li 2018, Eqs. 9-12, v^(-1/2) = v_0): first order where there is drag."""
