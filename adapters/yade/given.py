"""The input of YADE, to which each term of a scene adds numbers, columns and notes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from adapters.yade.setup import Setup
from vv.ask import Reaction
from vv.scene import Mask, Vector, initial_normal_forces

Plan = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Given:
    """The parts of the driver's ask: see `adapters.yade.inside.driver` for the meaning of each.

    numbers: single values, by name. mass (n,) [kg], load and carried (n, 3) [N, m/s]: of each
    sphere. motion: the sines of moving walls, by wall number. force: (n, 3) [N] on the spheres at t
    = 0. pushed: (n,) which spheres start at rest, and get their velocity by an impulse in the first
    step; missed: (n, 3) [N] the forces of dashpots that they lack in that step, since they are at
    rest. notes: how terms are represented, one statement each.
    """

    numbers: Plan
    mass: Vector
    load: Vector
    carried: Vector
    force: Vector
    pushed: Mask
    missed: Vector
    motion: Mapping[int, list[Plan]]
    notes: tuple[str, ...]

    def with_more(self, *notes: str, force: Vector | float = 0.0, **numbers: Any) -> Given:
        """A copy with these numbers replaced, and with further forces and notes."""
        return replace(
            self,
            numbers={**self.numbers, **numbers},
            force=self.force + force,
            notes=(*self.notes, *notes),
        )


def bare(setup: Setup) -> Given:
    """Spheres with normal contact and no other forces."""
    ask, contact, spheres = setup.ask, setup.scene.contact, setup.scene.spheres
    zeros = np.zeros((len(spheres), 3))
    numbers: Plan = {
        "dt": ask.dt,
        "steps": ask.goal.steps(ask.dt),
        "stride": ask.goal.stride(ask.dt),
        "kn": float(contact.kn),
        "ks": 0.0,
        "mu": float(contact.mu),
        "eta_n": 0.0,
        "hertz": {},
        "gravity": [0.0, 0.0, 0.0],
        "drag": 0.0,
        "shaking": [],
        "ends": None,
        "charged": [],
        "bonds": [],
        "observe": [[type(seen).__name__.lower(), seen.body] for seen in setup.watched],
        "contacts": setup.contacts,
        "moves": bool(spheres.velocity.any()),
        "volumes": False,
    }
    return Given(
        numbers=numbers,
        mass=spheres.mass,
        load=zeros,
        carried=zeros,
        force=initial_normal_forces(setup.scene),
        pushed=np.zeros(len(spheres), bool),
        missed=zeros,
        motion={},
        notes=tuple(_always(setup)),
    )


def _always(setup: Setup) -> Sequence[str]:
    """The part of the input that is the same for all terms."""
    notes = [
        "NewtonIntegrator without damping, velocities started at -dt/2",
        "every step an O.step(); O.run costs as much and rounds wall time up to 40 ms",
    ]
    if any(isinstance(what, Reaction) for what in setup.ask.observables):
        notes.append("reactions from the forces of one step more")
    return notes
