"""The choices in which formulations of DDA differ; they are fixed before a model is built."""

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
    """The choices of one formulation of DDA; no others are made within a step.

    tolerance: iterations end when no contact changes between open, stick and slide, and no friction
    differs from that of the last solution by more than this fraction; inf takes friction from the
    iteration before as it is (lagged). iterations: their largest number; after these, and `newton`
    of Newton's iteration, a step is halved. stepping: the time integration. shaking_at: the
    fraction of a step at which shaking is evaluated. 1 is DDA's own, with velocities that lack half
    a step's change of the shaking; 1/2 is as accurate as the mean, to (w dt)^2/24.

    terms: how many terms of the exponential series of the displacement gradient move the vertices;
    one term is T d (Yagoda-Biran 2016, Eqs. 3, 4), by which rotating blocks grow. turns: rounds of
    the iteration for the gyroscopic torque; 0 omits it, as T d does. follow: terms of the series by
    which strains, and so stresses, rotate with their block; 0 leaves them in the scene's axes,
    which is right only for small rotations. settling: seconds of gravity before shaking and moving
    walls start. dd: the fraction of its velocity that a block keeps after a step.

    shear: ks/kn for rigid contact. pressed: contacts start with the penetration that carries the
    loads; otherwise as in the scene. eased: rounds of steps that then release wedges that friction
    does not hold. charged: tangential springs carry friction, of the loads at the start and while a
    contact slides; otherwise they start unloaded and are reset by every slip. multipliers: how many
    times multipliers take over the forces of springs in a step, after which gaps are zero; 0 for
    springs alone. Raises ValueError for a number out of range.
    """

    tolerance: float
    iterations: int
    terms: int
    newton: int = 0
    stepping: Stepping = IMPLICIT
    shaking_at: float = 1.0
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
            "shaking_at": 0 <= self.shaking_at <= 1,
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
    tolerance=1e-12, iterations=OPEN_CLOSE, terms=SERIES, newton=MOST, eased=ROUNDS, shaking_at=0.5
)
"""Friction iterated to convergence within the open-close iteration, mean shaking.

A step is divided where the slide of a block stops that is alone, or with others that can neither
rotate nor deform: where blocks rock on their points, contacts stop in most steps.
"""

PUBLISHED = Formulation(
    tolerance=math.inf, iterations=6, terms=1, turns=0, follow=0, settling=2.0,
    shear=PUBLISHED_SHEAR, charged=False,
)  # fmt: skip
"""As in the codes that Yagoda-Biran and Hatzor (2016) ran, with their settling phase."""

LAGGED = Formulation(tolerance=math.inf, iterations=MOST, terms=SERIES)
"""DEFAULT but for friction that lags by an iteration, at rest too, so that no wedge is let go."""

DAMPED = Formulation(
    tolerance=1e-12, iterations=OPEN_CLOSE, terms=SERIES, newton=MOST, eased=ROUNDS,
    stepping=generalised_alpha(RADIUS), shaking_at=1.0 - generalised_alpha(RADIUS).alpha_f,
)  # fmt: skip
"""DEFAULT but for inertia, which generalised alpha steps: second order, known damping."""

BORNE = Formulation(
    tolerance=1e-12, iterations=OPEN_CLOSE, terms=SERIES, newton=MOST, stepping=LEAPING,
    shaking_at=0.0, shear=1.0, pressed=False, multipliers=MULTIPLIERS,
)  # fmt: skip
"""Contacts whose forces multipliers bear and not springs (Lin, Amadei, Jung and Dwyer 1996)."""
