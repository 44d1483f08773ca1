"""The in-house explicit DEM as a code of the framework."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from vv.ask import Ask, Displacement, Method, Model, Reaction, Run, Velocity
from vv.codes import Found, Scheme, python_script, run_timed
from vv.codes.in_house import part_of_vv
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
    }
)
OBSERVABLES = frozenset({Displacement, Velocity, Reaction})
KNOBS = ("dt", "kn")
SCHEMES = (
    Scheme(
        "default",
        "leapfrog from a centred start, drag at the mean of the velocities around it",
        Method.SECOND_ORDER,
        TERMS,
        KNOBS,
        lowered={Term.RIGID_CONTACT: Method.PENALTY},
        observables=OBSERVABLES,
        energies=frozenset(Form),
    ),
    Scheme(
        "published",
        "leapfrog of Li et al. (2018), Eqs. 4-12: drag of the previous mean velocity, which is "
        "the initial one at first; a start under force is half a step late for the same reason",
        Method.SECOND_ORDER,
        TERMS,
        KNOBS,
        lowered={
            Term.RIGID_CONTACT: Method.PENALTY,
            Term.DRAG: Method.FIRST_ORDER,
            Term.CONTACT_VISCOSITY: Method.FIRST_ORDER,
            Term.GRAVITY: Method.FIRST_ORDER,
            Term.LOAD: Method.FIRST_ORDER,
            Term.SHAKING: Method.FIRST_ORDER,
            Term.BASE_MOTION: Method.FIRST_ORDER,
        },
        observables=OBSERVABLES,
        energies=frozenset(Form),
    ),
)
LEAPFROGS: Mapping[str, dem.Leapfrog] = {"default": dem.CENTRED, "published": dem.LAGGED}


class Dem:
    """The adapter; it holds no state."""

    name = "dem"
    schemes = SCHEMES

    def found(self) -> Found:
        """Part of vv, if numba is there to compile it."""
        return part_of_vv()

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """Why no leapfrog can run an ask though it has every term, or none with its step."""
        return dem.refuses(ask) or dem.unstable(ask, LEAPFROGS[scheme])

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The smallest model of the scene, and its largest stable step."""
        return dem.prepare(ask, LEAPFROGS[scheme]).model

    def native(self, ask: Ask, scheme: str) -> str:
        """A Python script that calls the engine."""
        return python_script(ask, "vv.engines.dem", f"solve_{scheme}")

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Solve the asks in this process; see `run_timed` for the cost."""
        for ask in asks:
            yield run_timed(functools.partial(dem.prepare, ask, LEAPFROGS[scheme]), repeat)


ADAPTER = Dem()
