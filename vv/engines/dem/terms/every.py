"""All terms that the general model knows, in the order in which their forces are added up."""

from __future__ import annotations

from types import ModuleType

from vv.engines.dem.terms import (
    bonds,
    carried,
    dashpots,
    drag,
    gravity,
    load,
    moving_walls,
    near_contacts,
    pair_contacts,
    shaking,
    wall_contacts,
)

TERMS: tuple[ModuleType, ...] = (
    gravity,
    load,
    shaking,
    pair_contacts,
    wall_contacts,
    near_contacts,
    bonds,
    dashpots,
    drag,
    carried,
    moving_walls,
)
