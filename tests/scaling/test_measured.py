"""Claims about what a step costs as scenes grow: what is measured, of whom, and how it is told."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from vv.ask import Ask, Cost, Method, Model, Run, Status
from vv.codes import Found, Scheme
from vv.scaling import measured, scaling_table
from vv.scaling.measured import Size, costs_by_size, sizes
from vv.scaling.stack import CONTACTS, stack
from vv.scaling.triad import bandwidth
from vv.scene.neighbours import overlapping

WORDS = "takes a second to begin and so long a step"
SCHEME = Scheme("default", WORDS, Method.LEAPFROG, stack(100).terms())


class Pretended:
    """A code that says what its steps cost; from some size on it fails."""

    name, schemes = "pretended", (SCHEME,)

    def __init__(self, seconds: float, most: int = 10**9) -> None:
        self.seconds, self.most, self.asked = seconds, most, list[int]()

    def found(self) -> Found:
        return Found(True)

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        return None

    def describe(self, ask: Ask, scheme: str) -> Model:
        return Model(0, frozenset())

    def native(self, ask: Ask, scheme: str) -> str:
        return ""

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        for ask in asks:
            n = len(ask.scene.spheres)
            self.asked.append(n)
            if n > self.most:
                yield Run(Status.ERROR, "no memory")
            else:
                spent = 1.0 + self.seconds * n * ask.goal.steps(ask.dt)
                yield Run(Status.RAN, cost=Cost(solve_cpu=spent))


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measured, "bandwidth", lambda: 1e10)
    monkeypatch.setattr(measured, "WORK", 4000)


@pytest.mark.parametrize(
    ("largest", "told"), [(100, (100,)), (5000, (100, 1000, 5000)), (10000, (100, 1000, 10000))]
)
def test_sizes_grow_tenfold_up_to_the_largest(largest: int, told: tuple[int, ...]) -> None:
    assert sizes(largest) == told


def test_what_a_run_begins_with_is_no_part_of_a_step() -> None:
    code = Pretended(3e-7)
    for size in costs_by_size([(code, SCHEME)], 1000):
        assert size.seconds == {"pretended/default": pytest.approx(3e-7)}
        assert size.limit == pytest.approx(28.8e-9), "18 numbers and 3 springs, read and written"


def test_of_several_rounds_the_cheapest_counts_for_each_run(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    code, dearer = Pretended(3e-7), itertools.chain([5e-7], itertools.repeat(3e-7))
    ran = code.run

    def run(*words: Any) -> Iterator[Run]:
        code.seconds = next(dearer)
        return ran(*words)

    monkeypatch.setattr(code, "run", run)
    (size,) = costs_by_size([(code, SCHEME)], 100)
    assert size.seconds == {"pretended/default": pytest.approx(3e-7)}


def test_who_fails_is_asked_for_no_more_spheres_and_said_to_have_failed() -> None:
    weak, strong = Pretended(1e-7, most=500), Pretended(1e-7)
    strong.name = "strong"
    found = list(costs_by_size([(weak, SCHEME), (strong, SCHEME)], 10_000))
    assert [len(size.seconds) for size in found] == [2, 1, 1]
    assert max(weak.asked) == 1000
    assert "pretended/default with 1000 spheres: error: no memory" in scaling_table.notes(found)


def test_a_code_without_the_physics_is_told_why() -> None:
    lacking = Scheme("default", "", Method.LEAPFROG, frozenset())
    (size,) = costs_by_size([(Pretended(1.0), lacking)], 100)
    assert "does not support" in size.failed["pretended/default"]
    assert not measured.can_step(Pretended(1.0), lacking)
    assert measured.can_step(Pretended(1.0), SCHEME)


@pytest.mark.parametrize(("huge", "calls"), [(10**9, 3), (100, 1)])
def test_the_largest_scenes_are_measured_once(
    monkeypatch: pytest.MonkeyPatch, huge: int, calls: int
) -> None:
    monkeypatch.setattr(measured, "HUGE", huge)
    code = Pretended(1e-7)
    list(costs_by_size([(code, SCHEME)], 100))
    assert len(code.asked) == 2 * calls


@pytest.mark.parametrize("n", [100, 1000, 3000])
def test_nearly_all_spheres_of_the_scene_touch_six(n: int) -> None:
    scene = stack(n)
    s, pairs = scene.spheres, len(overlapping(scene.spheres))
    assert len(s) == pytest.approx(n, rel=0.05)
    gaps = [(s.position - wall.point) @ wall.normal - s.radius for wall in scene.walls]
    assert np.min(gaps) > -0.1 * s.radius.min(), "none lies behind a wall"
    leaning = np.count_nonzero(np.array(gaps) < 0)
    assert 2 * pairs + leaning == 2 * CONTACTS * len(s)


def test_lines_say_how_costs_grow() -> None:
    found = [
        Size(n, 10, memory, {"one/default": cost})
        for n, memory, cost in ((100, 2e10, 1e-7), (1000, 1e10, 1.5e-7))
    ]
    assert scaling_table.row(found[0], ["one/default", "two/default"]).split() == [
        "100",
        "100",
        "-",
        "14",
    ]
    assert any("1.50 times" in line for line in scaling_table.notes(found))
    assert any(line.endswith("20.0 GB/s at most; small scenes fit into the caches")
               for line in scaling_table.notes(found))  # fmt: skip
    assert scaling_table.document(found)["sizes"][1]["seconds"] == {"one/default": 1.5e-7}


def test_memory_has_a_bandwidth_of_this_century() -> None:
    assert 1e8 < bandwidth() < 1e13
