"""The schemes of the YADE adapter by name, and what YADE is told of a sphere."""

from __future__ import annotations

from typing import Any

from adapters.yade import ADAPTER
from adapters.yade.translate import plan
from vv.ask import Ask

PLAIN, HALF_STEP, CLUMP, POLYHEDRA = (scheme.name for scheme in ADAPTER.schemes)


def sphere_of(ask: Ask, scheme: str = PLAIN) -> dict[str, Any]:
    """What YADE is told of the last sphere."""
    spheres = [body for body in plan(ask, scheme)["bodies"] if body["kind"] == "sphere"]
    return dict(spheres[-1])
