"""Claims about draws of parameters: anyone repeats them, and each is green, red or refused."""

from __future__ import annotations

import itertools
import shlex
from pathlib import Path

import numpy as np
import pytest

from bench.chance import holdouts
from bench.chance.holdouts import FAR, NEAR, Draw, draw, judged, variants
from vv.plan.project import find

PROJECT = find(Path(__file__))
T1 = ("single-contact", "T1")


def drawn(seed: int, number: int = 40) -> list[Draw]:
    chance = np.random.default_rng(seed)
    return [
        draw(case, variant, chance)
        for case, variant in itertools.islice(variants(PROJECT, "*", chance), number)
    ]


def test_a_seed_draws_the_same_again_and_another_seed_does_not() -> None:
    assert drawn(1) == drawn(1)
    assert drawn(1) != drawn(2)


def test_every_case_that_has_parameters_has_its_turn() -> None:
    cases = [PROJECT.load_case(name) for name in PROJECT.case_names()]
    quick = {one.name for one in cases if one.parameters}
    assert {one.case for one in drawn(3, len(quick))} <= quick
    assert len({one.case for one in drawn(3, 40)}) == 40


def test_values_are_near_in_all_parameters_or_far_in_one_to_three() -> None:
    case = PROJECT.load_case("resting")
    usual, chance = case.defaults("still"), np.random.default_rng(5)
    for _ in range(200):
        values = [one.split("=") for one in draw(case, "still", chance).settings]
        factors = [float(value) / usual[name] for name, value in values]
        assert all(usual[name] for name, _ in values)
        if len(values) > 3:
            assert all(1 - 1.02 * NEAR <= one <= 1 + 1.02 * NEAR for one in factors)
        assert all(0.99 / FAR <= one <= 1.01 * FAR for one in factors)


def test_a_command_says_all_that_was_drawn() -> None:
    words = shlex.split(Draw(*T1, ("m1=2", "v=-0.5")).command("dem"))
    assert words[:3] == ["vv", "run", "single-contact:T1"]
    assert words[3:7] == ["--set", "m1=2", "--set", "v=-0.5"]
    assert words[-2:] == ["--codes", "dem"]


def test_what_is_out_of_bounds_is_red_and_what_a_case_rejects_is_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("VV_DATA", str(tmp_path))
    assert judged(PROJECT, Draw(*T1, ("k=nan",)), "dem/default")[0] == "refused"
    assert judged(PROJECT, Draw(*T1, ()), "dem/default") == ("green", [])
    assert judged(PROJECT, Draw(*T1, ()), "dda")[0] == "refused"  # by the code

    def crash(*_: object) -> None:
        raise IndexError("beyond")

    monkeypatch.setattr(holdouts, "make_plan", crash)
    ended, told = judged(PROJECT, Draw(*T1, ()), "dem")
    assert (ended, told) == ("red", ["the case ends with IndexError('beyond')"])
