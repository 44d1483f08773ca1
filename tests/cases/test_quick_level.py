"""Claims about the variants of the quick level: the plain one of each case, and its extremes."""

from __future__ import annotations

import pytest

from vv.case import Level
from vv.plan.project import find


@pytest.mark.parametrize(
    ("case", "quick"),
    [
        ("wedge", {"xi-1", "xi-1e-06", "sphere"}),
        ("dashpot", {"z-0", "z-0.6", "z-0.99", "pair-0.6"}),
    ],
)
def test_the_plain_and_the_extreme_variants_run_quickly(case: str, quick: set[str]) -> None:
    variants = find().load_case(case).variants
    assert {one.name for one in variants if one.runs_at(Level.QUICK)} >= quick
    assert {one.name for one in variants if not one.runs_at(Level.QUICK)}
