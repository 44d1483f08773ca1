"""What may differ between formulations of DDA: strategies, fixed before a program is built."""

from __future__ import annotations

import math
from dataclasses import dataclass

from vv.engines.dda.limits import MOST, MULTIPLIERS, OPEN_CLOSE, RADIUS, ROUNDS, SERIES, TURNS
from vv.engines.dda.stepping import IMPLICIT, LEAPING, Stepping, generalised_alpha
from vv.standins.stand_in import SHEAR

PUBLISHED_SHEAR = 0.4
"""ks/kn at each point of contact, as is usual in DDA."""


@dataclass(frozen=True)
class Formulation:
    """One way through a DDA step; every choice is made here and none within the step.

    tolerance: iterations end when no contact changes between open, stick and slide and no
    friction differs by more than this part of it from what the last solution gives; inf takes
    friction from the iteration before as it is (lagged). iterations: after so many, and
    newton of Newton's, a step is cut in halves. stepping: how inertia is stepped. felt: how far
    into a step shaking is felt; all of it is DDA's own, by which speeds lack half a step's change
    of the shaking, and half of it is as good as the mean, to (w dt)^2/24. terms: of the
    exponential series by which a displacement gradient moves vertices; one is T d (Yagoda-Biran
    2016, Eqs. 3, 4), which lets turning blocks grow. turns: rounds in which the gyroscopic torque
    of a step is found; none leaves it out, as T d does. follow: terms of the series by which
    strains, and so stresses, turn with their block; none leaves them behind in the scene's axes,
    which is right while a block hardly turns. settling: seconds of gravity before a drive sets in.
    dd: the part of its velocity that a step hands on. shear: ks/kn where the scene says rigid
    contact. pressed: contacts start with the penetration that carries the loads; else as placed.
    eased: rounds of steps that then let wedges go that friction does not hold.
    charged: shear springs bear friction, of the loads at the start and while a contact slides;
    else they start unloaded and are let go by every slip. multipliers: times that multipliers take
    up the springs' forces in a step, which ends with gaps held at nil; none leaves springs.
    Raises ValueError for a number out of range.
    """

    tolerance: float
    iterations: int
    terms: int
    newton: int = 0
    stepping: Stepping = IMPLICIT
    felt: float = 1.0
    turns: int = TURNS
    follow: int = SERIES
    settling: float = 0.0
    dd: float = 1.0
    shear: float = SHEAR
    pressed: bool = True
    eased: int = 0
    charged: bool = True
    multipliers: int = 0

    def __post_init__(self) -> None:
        checks = {
            "tolerance": self.tolerance > 0,
            "iterations": self.iterations >= 1,
            "terms": self.terms >= 1,
            "newton": self.newton >= 0,
            "multipliers": self.multipliers >= 0,
            "eased": self.eased >= 0,
            "felt": 0 <= self.felt <= 1,
            "turns": self.turns >= 0,
            "follow": self.follow >= 0,
            "settling": 0 <= self.settling < math.inf,
            "dd": 0 <= self.dd <= 1,
            "shear": 0 < self.shear < math.inf,
        }
        for name, holds in checks.items():
            if not holds:
                raise ValueError(f"Formulation.{name} = {getattr(self, name)!r} is out of range")


DEFAULT = Formulation(
    tolerance=1e-12, iterations=OPEN_CLOSE, terms=SERIES, newton=MOST, eased=ROUNDS, felt=0.5
)
"""Friction iterated to convergence within the open-close iteration, shaking felt on average."""

PUBLISHED = Formulation(
    tolerance=math.inf, iterations=6, terms=1, turns=0, follow=0, settling=2.0,
    shear=PUBLISHED_SHEAR, charged=False,
)  # fmt: skip
"""As in the codes that Yagoda-Biran and Hatzor (2016) ran, with their settling phase."""

LAGGED = Formulation(tolerance=math.inf, iterations=MOST, terms=SERIES)
"""DEFAULT but for friction that lags by an iteration, at rest too, so that no wedge is let go."""

DAMPED = Formulation(
    tolerance=1e-12, iterations=OPEN_CLOSE, terms=SERIES, newton=MOST, eased=ROUNDS,
    stepping=generalised_alpha(RADIUS), felt=1.0 - generalised_alpha(RADIUS).alpha_f,
)  # fmt: skip
"""DEFAULT but for inertia, which generalised alpha steps: second order, known damping."""

BORNE = Formulation(
    tolerance=1e-12, iterations=OPEN_CLOSE, terms=SERIES, newton=MOST, stepping=LEAPING,
    felt=0.0, shear=1.0, pressed=False, multipliers=MULTIPLIERS,
)  # fmt: skip
"""Contacts whose forces multipliers bear and not springs (Lin, Amadei, Jung and Dwyer 1996)."""
