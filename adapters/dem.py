"""The in-house explicit DEM as a code of the framework."""

from __future__ import annotations

import functools
from collections.abc import Mapping

from vv.ask import Ask, Displacement, Method, Reaction, Velocity
from vv.codes import Scheme
from vv.codes.in_house import InHouse, Solver, compiled, part_of_vv
from vv.engines import dem
from vv.scene import Form, Term

TERMS = frozenset(
    {
        Term.SPHERE,
        Term.SPHERE_CONTACT,
        Term.WALL_CONTACT,
        Term.FRICTION,
        Term.DRAG,
        Term.GRAVITY,
        Term.LOAD,
        Term.ROTATION,
        Term.OBLIQUE_LOCK,
        Term.BLOCK,
        Term.RIGID_CONTACT,
        Term.SHAKING,
        Term.BASE_MOTION,
        Term.BOND,
        Term.BOND_SHEAR,
        Term.BREAKAGE,
        Term.CARRIED,
        Term.CONTACT_VISCOSITY,
        Term.HERTZ,
        Term.MICRO_SLIP,
        Term.HERTZ_VISCOSITY,
        Term.VISCOUS_FRICTION,
    }
)
OBSERVABLES = frozenset({Displacement, Velocity, Reaction})
KNOBS = ("dt", "kn")
SCHEMES = (
    Scheme(
        "default",
        "leapfrog with a centred start, and drag at the mean of the velocities before and after",
        Method.LEAPFROG,
        TERMS | {Term.FLUID},
        KNOBS,
        lowered={Term.RIGID_CONTACT: Method.PENALTY},
        observables=OBSERVABLES,
        energies=frozenset(Form),
    ),
    Scheme(
        "published",
        "leapfrog of Li et al. (2018), Eqs. 4-12: drag is taken from the previous mean velocity, "
        "at first from the initial one; a start under force is half a step late for the same "
        "reason",
        Method.LEAPFROG,
        TERMS,
        KNOBS,
        lowered={
            Term.RIGID_CONTACT: Method.PENALTY,
            Term.DRAG: Method.LATE_LEAPFROG,
            Term.CONTACT_VISCOSITY: Method.LATE_LEAPFROG,
            Term.HERTZ_VISCOSITY: Method.LATE_LEAPFROG,
            Term.GRAVITY: Method.LATE_LEAPFROG,
            Term.LOAD: Method.LATE_LEAPFROG,
            Term.SHAKING: Method.LATE_LEAPFROG,
            Term.BASE_MOTION: Method.LATE_LEAPFROG,
        },
        observables=OBSERVABLES,
        energies=frozenset(Form),
    ),
)
LEAPFROGS: Mapping[str, dem.Leapfrog] = {"default": dem.CENTRED, "published": dem.LAGGED}


def _solver(scheme: Scheme) -> Solver:
    """A leapfrog, with its refusal of steps larger than the largest stable one."""
    leapfrog = LEAPFROGS[scheme.name]

    def refuses(ask: Ask) -> str | None:
        return dem.refuses(ask) or dem.unstable(ask, leapfrog)

    prepare = functools.partial(dem.prepare, leapfrog=leapfrog)
    return compiled(scheme, f"solve_{scheme.name}", refuses, prepare)


ADAPTER = InHouse("dem", "vv.engines.dem", tuple(map(_solver, SCHEMES)), part_of_vv)
