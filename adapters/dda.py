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
        "implicit step of DDA, open-close iteration in which friction is iterated to "
        "convergence too; springs ks = 25 kn start with the loads and bear friction in slip too",
        Method.PENALTY,
        TERMS,
        KNOBS,
        observables=OBSERVABLES,
    ),
    Scheme(
        "published",
        "as Yagoda-Biran & Hatzor (2016) ran it: friction of the iteration before, six "
        "iterations at most before a step is cut, 2 s of gravity before a drive sets in, springs "
        "ks = 0.4 kn that start unloaded and are let go by every slip, "
        "rotations to first order, without gyroscopic torque, strains that do not turn with their "
        "block; dynamic parameter 1",
        Method.LAGGING,
        TERMS,
        KNOBS,
        observables=OBSERVABLES,
    ),
    Scheme(
        "lagged",
        "default but for friction, whose normal force and direction are those of the iteration "
        "before: what the lag alone does",
        Method.LAGGING,
        TERMS,
        KNOBS,
        observables=OBSERVABLES,
    ),
    Scheme(
        "generalised-alpha",
        "default but for inertia, stepped by generalised alpha (Chung and Hulbert 1993) of "
        "spectral radius 1/2: second order in dt, a swing that steps resolve is hardly damped, "
        "and of one that they do not a step leaves half",
        Method.DAMPED,
        TERMS - {Term.ROTATION},
        KNOBS,
        observables=OBSERVABLES,
        why_not={Term.ROTATION: "arms and normals are those of a step's begin, of first order"},
    ),
    Scheme(
        "augmented-lagrangian",
        "rigid contact: multipliers take up the forces of all springs, along and across, until "
        "gaps and slips are nil (Lin, Amadei, Jung and Dwyer 1996); a step hands on the velocity "
        "of its middle, so that a blow leaves no rebound",
        Method.FIRST_ORDER,
        TERMS - {Term.STRAIN, Term.STRAINED_START},
        KNOBS,
        observables=OBSERVABLES - {Strain},
        why_not=dict.fromkeys(
            (Term.STRAIN, Term.STRAINED_START), "velocities of middles lag, which damps strains"
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
