"""Translates blocks for LIGGGHTS: rigid bodies of atoms, or spheres that represent them."""

from __future__ import annotations

from dataclasses import replace

from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup
from adapters.liggghts.words import group
from vv.scene import Mask


def block(deck: Deck, setup: Setup) -> Deck:
    """The atoms of each block, moved as one rigid body with its degrees of freedom.

    These commands come last, since the first half step uses only the forces of the fixes before
    them.
    """
    if not setup.clumps:
        return deck
    note = "fix rigid: a body in six freedoms, those locked without force or torque"
    return replace(
        deck,
        neighbours=(*deck.neighbours, "neigh_modify    exclude group all all"),
        integrated=(),
        last=tuple(_single(setup) if len(setup.clumps) == 1 else _several(setup)),
        motion_notes=(note,),
    )


def _single(setup: Setup) -> list[str]:
    return [f"fix body all rigid single {_freedoms(setup, 0)}"]


def _several(setup: Setup) -> list[str]:
    names = [f"body{number}" for number in range(len(setup.clumps))]
    groups = [group(name, atoms) for name, atoms in zip(names, setup.parts, strict=True)]
    freedoms = " ".join(_freedoms(setup, number) for number in range(len(names)))
    return [*groups, f"fix bodies all rigid group {len(names)} {' '.join(names)} {freedoms}"]


def _freedoms(setup: Setup, number: int) -> str:
    free, free_spin = setup.spheres.free[number], setup.clumps[number].free_spin
    body = number + 1
    return f"force {body} {_switches(free)} torque {body} {_switches(free_spin)}"


def _switches(free: Mask) -> str:
    return " ".join("on" if loose else "off" for loose in free)
