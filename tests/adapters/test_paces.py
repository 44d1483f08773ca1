"""How long steps take is known well enough that settings near their limit of time are run."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from vv.ask import Knobs
from vv.case.study import why_too_long
from vv.plan.project import find

# bodies, steps and limit [s] of the settings of cases, at level paper, between which the limit lies
STRENGTH = [(21970, 5769, 200.0, True), (4332, 46437, 200.0, False)]  # close-packed-strength
MAP = [(1, 500_000, 30.0, True), (1, 1_573_294, 30.0, False)]  # stability-map
NEAREST = {
    "yade/default": STRENGTH,
    "yade/half-step-mass": STRENGTH,
    "pybullet/default": MAP,
    "lmgc90/default": MAP,
}


@pytest.mark.parametrize("label", NEAREST)
def test_of_the_settings_about_a_limit_of_time_the_shorter_is_run(label: str) -> None:
    code, _, name = label.partition("/")
    (scheme,) = (s for s in find().load_adapter(code).schemes if s.name == name)
    for bodies, steps, limit, run in NEAREST[label]:
        study: Any = SimpleNamespace(
            scene=SimpleNamespace(spheres=range(bodies), blocks=()),
            goal=SimpleNamespace(steps=lambda dt, steps=steps: steps),
            cpu_limit=limit,
        )
        assert (why_too_long(study, Knobs(1e-6), scheme.pace) is None) is run
