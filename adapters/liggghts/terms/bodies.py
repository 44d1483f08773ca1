"""Puts a block to LIGGGHTS: as a rigid body of atoms, or as the sphere that stands for it."""

from __future__ import annotations

from dataclasses import replace

from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup
from vv.scene import Mask


def block(deck: Deck, setup: Setup) -> Deck:
    """All atoms moved as one body, in the freedoms it has.

    It stands last: its first half step sees the forces of the fixes before it only.
    """
    if setup.clump is None:
        return deck
    free, free_spin = _switches(setup.spheres.free[0]), _switches(setup.clump.block.free_spin)
    whole = f"fix body all rigid single force 1 {free} torque 1 {free_spin}"
    note = "fix rigid: one body in six freedoms, those locked without force or torque"
    return replace(
        deck,
        neighbours=(*deck.neighbours, "neigh_modify    exclude group all all"),
        integrated=(),
        last=(whole,),
        motion_notes=(note,),
    )


def _switches(free: Mask) -> str:
    return " ".join("on" if loose else "off" for loose in free)
