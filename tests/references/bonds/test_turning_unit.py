"""Claims about four bonded elements that can rotate: when they are at rest."""

import numpy as np
import pytest

from cases.bonds.parts._unit import BASE, CORNERS, EDGES
from cases.bonds.tetrahedral_unit import CASE
from reference_solutions.bonds.turning_unit import time_to_rest
from vv.ask import Ask, Knobs
from vv.case import Scalar
from vv.engines import dem

LOAD = np.array([[0.0, 0.0, 1.0], *[[0.0] * 3] * 3])
SPRINGS = {"kn": 2.156e8, "ks": 2.257e7, "d": 1.167e-3, "m": 1.87383297e-6, "eta": 6.0}


def test_weak_shear_springs_take_longer_to_rest() -> None:
    """The slow mode moves the centres in proportion to ks/kn: its damping falls with the square."""
    times = [
        time_to_rest(CORNERS, EDGES, BASE, LOAD, 1e-9, **{**SPRINGS, "ks": part * SPRINGS["kn"]})
        for part in (0.02, 0.04, 0.08)
    ]
    assert times[0] / times[1] == pytest.approx(4.0, rel=0.25)
    assert times[1] / times[2] == pytest.approx(4.0, rel=0.25)


@pytest.mark.parametrize("given", [{}, {"kn": 2.156e8, "gamma": 0.1047, "d": 1.167e-3}])
def test_the_unit_is_at_rest_as_it_is_read(given: dict[str, float]) -> None:
    trial = CASE.declare("turning", {**CASE.defaults("turning"), **given})
    study = trial.study
    run = dem.solve_default(Ask(study.scene, study.goal, study.observables, Knobs(dt=2e-8)))
    (nu,) = (q for q in trial.quantities if isinstance(q, Scalar) and q.name == "nu")
    assert isinstance(nu.reference, float)
    assert nu.observe(run) == pytest.approx(nu.reference, abs=1e-8 * 0.2)
