"""The in-house DDA as a code of the framework."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from vv.ask import Ask, Displacement, Method, Model, Run, Strain, Velocity
from vv.codes import Found, Scheme, python_script, run_timed
from vv.codes.in_house import part_of_vv
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
        Term.BASE_MOTION,
        Term.STRAIN,
    }
)
KNOBS = ("dt", "kn")
OBSERVABLES = frozenset({Displacement, Velocity, Strain})
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
)
FORMULATIONS: Mapping[str, dda.Formulation] = {
    "default": dda.DEFAULT,
    "published": dda.PUBLISHED,
    "lagged": dda.LAGGED,
}


class Dda:
    """The adapter; it holds no state."""

    name = "dda"
    schemes = SCHEMES

    def found(self) -> Found:
        """Part of vv, if numba is there to compile it."""
        return part_of_vv()

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        """Why no formulation can run an ask though it has every term."""
        return dda.refuses(ask)

    def describe(self, ask: Ask, scheme: str) -> Model:
        """The smallest model of the scene, its springs and how it starts."""
        return dda.prepare(ask, FORMULATIONS[scheme]).model

    def native(self, ask: Ask, scheme: str) -> str:
        """A Python script that calls the engine."""
        return python_script(ask, "vv.engines.dda", f"solve_{scheme}")

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        """Solve the asks in this process; steps of settling count. Cost: see `run_timed`."""
        for ask in asks:
            yield run_timed(functools.partial(dda.prepare, ask, FORMULATIONS[scheme]), repeat)


ADAPTER = Dda()
