"""Translates constant forces and drag on spheres for LIGGGHTS: drag, weight, dead loads."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import HALF_STEP, OVERLAPPED, Setup
from adapters.liggghts.words import AXES, group, numbers

FEW = 8  # groups that loads may take


def drag(deck: Deck, setup: Setup) -> Deck:
    """The force -eta v, which a scheme may base on the mean velocity: see `heavier`."""
    notes = ["drag by fix viscous from the velocity half a step ago"]
    if setup.scheme == HALF_STEP:
        notes.append("masses are m + eta dt/2, weight a dead load")
    command = f"fix drag all viscous {float(setup.scene.eta)!r}"
    return deck.with_more(forces=[command], notes=notes)


def gravity(deck: Deck, setup: Setup) -> Deck:
    """The weight, unless the scheme made it a dead load."""
    field = setup.scene.gravity
    if not field.any():
        return deck
    size = float(np.linalg.norm(field))
    command = f"fix weight all gravity {size!r} vector {numbers(field / size)}"
    return deck.with_more(forces=[command])


def dead_loads(deck: Deck, setup: Setup) -> Deck:
    """A group and a constant force for each distinct load; for many loads, a property of atoms.

    LIGGGHTS has few groups. The property can be set only after a run of no steps.
    """
    if len(setup.loads) <= FEW:
        return deck.with_more(forces=_loads(setup))
    commands = ["fix loads all property/atom loads vector no no no 0.0 0.0 0.0", "run 0"]
    for load, carriers in setup.loads.items():
        commands += (
            f"set             atom {i + 1} property/atom loads {numbers(load)}" for i in carriers
        )
    commands += (f"variable load_{axis} atom f_loads[{n}]" for n, axis in enumerate(AXES, 1))
    commands.append(f"fix load all addforce {' '.join(f'v_load_{axis}' for axis in AXES)}")
    return deck.with_more(forces=commands)


def _loads(setup: Setup) -> Iterator[str]:
    for number, (load, carriers) in enumerate(setup.loads.items()):
        yield group(f"load{number}", carriers)
        yield f"fix load{number} load{number} addforce {numbers(load)}"


def oblique_locks(deck: Deck, setup: Setup) -> Deck:
    """Dead loads in place of locks (`with_loads_for_locks`); LIGGGHTS locks axes of its frame."""
    before, now = setup.springs.scene.spheres.load, setup.released.spheres.load
    if np.array_equal(before, now) or setup.scheme == OVERLAPPED:
        return deck
    return deck.with_more(notes=["a dead load along the normal instead of a locked axis"])
