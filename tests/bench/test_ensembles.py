"""Claims about what benches tell of packs: means with their doubt, and when ways part."""

from __future__ import annotations

import numpy as np
import pytest

from bench.chance.divergence import parted
from bench.chance.ensembles import QUANTITIES, asked, interval
from vv.engines import dem


def test_an_interval_holds_the_mean_of_as_many_draws_as_it_says() -> None:
    draws = np.random.default_rng(1).normal(3.0, 0.2, size=(2000, 5))
    found = np.array([interval(row) for row in draws])
    holds = np.abs(found[:, 0] - 3.0) <= found[:, 1]
    assert holds.mean() == pytest.approx(0.95, abs=0.015)


def test_ways_part_where_one_sphere_is_first_too_far_or_no_number() -> None:
    one = np.zeros((6, 4, 3))
    other = one.copy()
    other[3:, 2, 1] = 2e-3
    assert parted(one, other, 1e-3) == 3
    assert parted(one, other, 5e-3) is None
    other[1, 0, 0] = np.nan
    assert parted(one, other, 5e-3) == 1


def test_a_pack_has_all_that_is_told_of_it() -> None:
    ask = asked(7)
    run = dem.solve_default(ask)
    told = {name: one(ask.scene, run) for name, one in QUANTITIES.items()}
    contacts, floor, sides, decay, momentum = told.values()
    assert 2.9 < contacts < 3.1
    assert floor == pytest.approx(1.0, abs=1e-4)
    assert 0 <= sides < 1e-4
    assert -5 < decay < -0.5
    assert 0 <= momentum < 1e-4
