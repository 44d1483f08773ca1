"""The in-house DDA as a code of the framework."""

from __future__ import annotations

import functools
from collections.abc import Mapping

from vv.ask import Displacement, Impulse, Method, Reaction, Strain, Velocity
from vv.codes import Scheme
from vv.codes.in_house import InHouse, compiled, part_of_vv
from vv.engines import dda
from vv.scene import Term

TERMS = frozenset(
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
        Term.STRAIN,
        Term.STRAINED_START,
    }
)
KNOBS = ("dt", "kn", "dd")
OBSERVABLES = frozenset({Displacement, Velocity, Reaction, Impulse, Strain})
SCHEMES = (
    Scheme(
        "default",
        "implicit step of DDA; the open-close iteration also converges friction; springs with ks "
        "= 25 kn carry the loads at the start, and friction while contacts slip",
        Method.PENALTY,
        TERMS,
        KNOBS,
        observables=OBSERVABLES,
    ),
    Scheme(
        "published",
        "as run by Yagoda-Biran & Hatzor (2016): friction from the previous iteration, at most "
        "six iterations before a step is halved, 2 s of gravity before shaking starts, springs "
        "with ks = 0.4 kn that start unloaded and are reset by every slip, rotations to first "
        "order without gyroscopic torque, strains that do not rotate with their block; dynamic "
        "parameter 1",
        Method.LAGGING,
        TERMS,
        KNOBS,
        observables=OBSERVABLES,
    ),
    Scheme(
        "lagged",
        "default except for friction, whose normal force and direction are those of the previous "
        "iteration: this shows the effect of the lag alone",
        Method.LAGGING,
        TERMS,
        KNOBS,
        observables=OBSERVABLES,
    ),
    Scheme(
        "generalised-alpha",
        "default except for inertia, integrated by generalised alpha (Chung and Hulbert 1993) "
        "with spectral radius 1/2: second order in dt; oscillations that steps resolve are hardly "
        "damped, others are halved by every step",
        Method.DAMPED,
        TERMS - {Term.ROTATION},
        KNOBS,
        observables=OBSERVABLES,
        why_not={
            Term.ROTATION: "contact points and normals are those at the beginning of a step, "
            "which is of first order"
        },
    ),
    Scheme(
        "augmented-lagrangian",
        "rigid contact: multipliers take over the forces of all springs, until gaps and slips are "
        "zero (Lin, Amadei, Jung and Dwyer 1996); a step starts from the velocity at the middle "
        "of the previous one, so that impacts have no rebound",
        Method.STRAIGHT,
        TERMS - {Term.STRAIN, Term.STRAINED_START},
        KNOBS,
        observables=OBSERVABLES - {Strain},
        why_not=dict.fromkeys(
            (Term.STRAIN, Term.STRAINED_START),
            "velocities are those at the middle of a step, and this lag damps strains",
        ),
    ),
)
FORMULATIONS: Mapping[str, dda.Formulation] = {
    "default": dda.DEFAULT,
    "published": dda.PUBLISHED,
    "lagged": dda.LAGGED,
    "generalised-alpha": dda.DAMPED,
    "augmented-lagrangian": dda.BORNE,
}
SOLVERS = tuple(
    compiled(
        scheme,
        f"solve_{scheme.name.replace('-', '_')}",
        functools.partial(dda.refuses, formulation=FORMULATIONS[scheme.name]),
        functools.partial(dda.prepare, formulation=FORMULATIONS[scheme.name]),
    )
    for scheme in SCHEMES
)
ADAPTER = InHouse("dda", "vv.engines.dda", SOLVERS, part_of_vv)
