"""The in-house rigid blocks as a code of the framework."""

from __future__ import annotations

from vv.ask import Displacement, Impulse, Method, Reaction, Velocity
from vv.codes import Scheme
from vv.codes.in_house import InHouse, compiled, part_of_vv
from vv.engines import rigid
from vv.scene import Term

DEFAULT = Scheme(
    "default",
    "trapezoidal positions, contact laws at the end of the step, exact Coulomb cone "
    "converged to a residual; steps cut at landings and where slip ends",
    Method.SECOND_ORDER,
    frozenset(
        {
            Term.WALL_CONTACT,
            Term.FRICTION,
            Term.GRAVITY,
            Term.LOAD,
            Term.ROTATION,
            Term.OBLIQUE_LOCK,
            Term.BLOCK,
            Term.RIGID_CONTACT,
            Term.SHAKING,
            Term.PULSE,
            Term.BASE_MOTION,
        }
    ),
    observables=frozenset({Displacement, Velocity, Reaction, Impulse}),
)
SOLVER = compiled(DEFAULT, "solve", rigid.refuses, rigid.prepare)
ADAPTER = InHouse("rigid", "vv.engines.rigid", (SOLVER,), part_of_vv)
