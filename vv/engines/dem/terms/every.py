"""The list of all terms of the general model, in the order in which their forces are added."""

from __future__ import annotations

from types import ModuleType

from vv.engines.dem.terms import (
    bonds,
    carried,
    dashpots,
    dead_loads,
    drag,
    fluid,
    moving_walls,
    near_contacts,
    pair_contacts,
    shaking,
    wall_contacts,
)

TERMS: tuple[ModuleType, ...] = (
    dead_loads,
    shaking,
    pair_contacts,
    wall_contacts,
    near_contacts,
    bonds,
    dashpots,
    drag,
    fluid,
    carried,
    moving_walls,
)
