"""What kernels of a run share: its constant data, and the arrays that its steps fill."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.blocks.geometry import Index, Planes, Shapes
from vv.engines.dda.general.bodies import Bodies
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.drive import Drive, Starts
from vv.scene import Mask, Vector

Rule = tuple[float, float, float, float]


@bundle
class Law(NamedTuple):
    """The law of each contact point: springs kn, ks [N/m], and the coefficient of friction mu.

    hold: 1 where tangential springs carry friction while the contact slides, else 0.
    """

    kn: float
    ks: float
    mu: float
    hold: float


@bundle
class Choices(NamedTuple):
    """The choices of a `Formulation`, which explains them; rule: its `stepping`."""

    tolerance: float
    iterations: int
    newton: int
    multipliers: int
    rule: Rule
    shaking_at: float
    terms: int
    turns: int
    follow: int
    dd: float


@bundle
class Setting(NamedTuple):
    """The constant data of a run.

    moves: (n,); depth: (3,) see `depth_axis`; base, starts: see `drives`; shaking: an acceleration
    of all bodies; reach [m]: see `find_contacts`; elastic: (q, 12) stiffness of strains [N m], laid
    out as `fill_masses`.
    """

    bodies: Bodies
    shapes: Shapes
    moves: Mask
    planes: Planes
    depth: Vector
    reach: float
    base: Drive
    starts: Starts
    shaking: Drive
    elastic: Vector
    law: Law
    choices: Choices


class Part(NamedTuple):
    """A part of a step: its beginning and length [s], its rule, and the weight of inertia."""

    time: float
    length: float
    rule: Rule
    weight: float


@bundle
class Work(NamedTuple):
    """The arrays of a run of q unknowns, n blocks and w walls that its steps fill anew.

    shift, ahead: (w, 3) displacements of walls [m] before a part of a step and after it; moved: (w,
    3) those that count in it; shake: (1, 3) [m/s2]; mass: (q, 12); first, matrix, right, constant:
    the equations; u: (q,) unknowns when forces are evaluated; d: (q,) those of the whole part;
    predictor: (q,) see `inertia`; rate: (q,) accelerations; outer, turn, pull: (q,) generalised
    forces of loads, of rotation alone, and of contacts; flow: (q,) for products.

    ledger: (13,), worst: (10,) see `energy.py`; funds: (4,) see `step.py`; origin: (n, 3) centres
    at t = 0 [m]; pressed, given: (n, 3) see `fill_forces`.
    """

    shift: Vector
    ahead: Vector
    moved: Vector
    shake: Vector
    mass: Vector
    first: Index
    matrix: Vector
    right: Vector
    constant: Vector
    u: Vector
    d: Vector
    predictor: Vector
    rate: Vector
    outer: Vector
    turn: Vector
    pull: Vector
    flow: Vector
    ledger: Vector
    worst: Vector
    funds: Vector
    origin: Vector
    pressed: Vector
    given: Vector


@bundle
class Trial(NamedTuple):
    """What a solution of the equations assumes of c contacts, and how they then move.

    used: (c,) states; rub: (c, 3) friction [N]; shut: (c, 3) displacements of their walls [m];
    relative: (c, 3) their relative displacements [m].
    """

    used: Index
    rub: Vector
    shut: Vector
    relative: Vector
