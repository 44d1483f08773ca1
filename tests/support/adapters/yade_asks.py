"""The schemes of the YADE adapter by name, and the input of YADE."""

from __future__ import annotations

from typing import Any

from adapters.yade import ADAPTER
from adapters.yade.given import Plan
from adapters.yade.plan import plan
from adapters.yade.setup import set_up
from vv.ask import Ask

PLAIN, HALF_STEP, CLUMP, POLYHEDRA = (scheme.name for scheme in ADAPTER.schemes)


def plan_of(ask: Ask, scheme: str = PLAIN) -> Plan:
    """The input of YADE for an ask."""
    return plan(set_up(ask, scheme))


def sphere_of(ask: Ask, scheme: str = PLAIN) -> dict[str, Any]:
    """The input of YADE for the last sphere."""
    spheres = [body for body in plan_of(ask, scheme)["bodies"] if body["kind"] == "sphere"]
    return dict(spheres[-1])
