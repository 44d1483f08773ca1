"""Claims, without LIGGGHTS, about costs that a batch leaves, and what is repeated, by hand."""

from __future__ import annotations

import dataclasses
import os
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import adapters.liggghts.setup as setup_of
from adapters.liggghts import ADAPTER
from adapters.liggghts.batch import _times
from adapters.liggghts.costs import cost, startup
from adapters.liggghts.setup import CLUMP, PLAIN, Setup
from adapters.liggghts.terms import hertz
from tests.support.adapters.liggghts_asks import ball, ball_ask, deck_of
from tests.support.adapters.small_asks import UP
from vv.scene import Contact, Hertz

LOOP = "Loop time of {} on 1 procs\nOutpt time (%) = {} (1)\n"


def part_of(
    folder: Path, loops: list[tuple[float, float]], lasted: float, on_cpu: str = ""
) -> Path:
    part = folder / "time-0"
    part.with_suffix(".log").write_text("".join(LOOP.format(*one) for one in loops))
    for suffix, at in ((".begun", 1000.0), (".done", 1000.0 + lasted)):
        part.with_suffix(suffix).touch()
        os.utime(part.with_suffix(suffix), (at, at))
    if on_cpu:
        part.with_suffix(".cpu").write_text(on_cpu)
    return part


def test_the_first_of_several_solves_is_not_counted_and_output_is_taken_off(
    tmp_path: Path,
) -> None:
    spent = cost(part_of(tmp_path, [(3.0, 0.5), (2.5, 0.5), (4.0, 0.25)], 12.5))
    assert (spent.solve_cpu, spent.solve_wall, spent.repeats) == (2.0, 2.0, 2)
    assert spent.spread == pytest.approx((3.75 - 2.0) / 2.0)
    assert spent.output == 0.5
    assert spent.setup == pytest.approx((12.5 - 9.5) / 3)
    alone = cost(part_of(tmp_path, [(3.0, 0.5)], 2.0))
    assert (alone.solve_cpu, alone.repeats, alone.spread, alone.setup) == (2.5, 1, 0.0, 0.0)
    nothing = cost(part_of(tmp_path, [(0.5, 0.5)], 2.0))
    assert (nothing.solve_cpu, nothing.spread) == (0.0, 0.0)


def test_time_on_a_core_counts_where_the_system_keeps_it(tmp_path: Path) -> None:
    loops = [(3.0, 0.0), (2.5, 0.0)]
    clock = "".join(f"{1e9 * s:.0f} 7 7\n" for s in (1.0, 2.5, 3.0, 4.25))
    spent = cost(part_of(tmp_path, loops, 6.0, clock))
    assert (spent.solve_cpu, spent.solve_wall) == (1.25, 2.5)
    for bad in (clock + "9 1 1\n", "4 1\n3 1\n2 1\n1 1\n"):  # one look too many; no such clock
        assert cost(part_of(tmp_path, loops, 6.0, bad)).solve_cpu == 2.5


def test_startup_is_from_the_start_of_a_program_to_its_first_part(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    part = part_of(tmp_path, [], 1.0)  # begun at 1000 s
    clock = SimpleNamespace(time=lambda: 1010.0, monotonic=lambda: 50.0)
    monkeypatch.setattr("adapters.liggghts.costs.time", clock)
    for started, due in ((38.0, 2.0), (45.0, 0.0)):
        assert startup(part, SimpleNamespace(started=started)) == due  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("once", "repeat", "times"),
    [(1.0, 10.0, 11), (10.0, 1.0, 4), (1e-3, 10.0, 300), (3.0, 10.0, 5)],
)
def test_short_solves_are_repeated_for_so_long(once: float, repeat: float, times: int) -> None:
    assert _times(once, repeat) == times


def test_the_room_is_that_of_what_is_held_and_of_spheres_for_clumps(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(setup_of, "space", lambda scene, duration: (scene, duration))
    ask = SimpleNamespace(goal=SimpleNamespace(duration=3.0))
    for scheme, seen in ((CLUMP, "released"), (PLAIN, "held")):
        made = SimpleNamespace(scheme=scheme, released="released", scene="held", ask=ask)
        assert Setup.room.func(made) == (seen, 3.0)  # type: ignore[attr-defined]


def with_law(law: Hertz) -> Any:
    ask = ball_ask(ball(), UP)
    contact = Contact(0.0, mu=0.3, hertz=law)
    return dataclasses.replace(ask, scene=dataclasses.replace(ask.scene, contact=contact))


def test_viscous_elastic_spheres_are_a_material_and_a_restitution() -> None:
    text = deck_of(with_law(Hertz(6e9, 1.2e9, 0.3)), PLAIN)
    rows = (line.split() for line in text.splitlines() if "property/global" in line)
    values = {row[1]: float(row[-1]) for row in rows}
    assert values["youngsModulus"] == pytest.approx(12e9 * 8 / 9)
    assert values["poissonsRatio"] == pytest.approx(1 / 3)
    assert values["coefficientRestitution"] == pytest.approx(0.335159, rel=1e-5)
    assert values["coefficientFriction"] == 0.3
    setup: Any = SimpleNamespace(scene=SimpleNamespace(contact=Contact(1.0)))
    for put in (hertz.elastic, hertz.viscous):
        assert put("as it was", setup) == "as it was"  # type: ignore[arg-type, comparison-overlap]


@pytest.mark.parametrize(
    ("shear", "said"), [(1.5e9, None), (1.8e9, "LIGGGHTS accepts none below 0"), (2e9, "6 G/E = 2")]
)
def test_viscous_contacts_need_a_material_that_is_not_auxetic(
    shear: float, said: str | None
) -> None:
    reason = hertz.why_not_viscous(with_law(Hertz(6e9, shear, 0.3)).scene)
    assert (reason is None) is (said is None)
    assert said is None or said in str(reason)


@pytest.mark.parametrize(("part", "refused"), [(1.2e-12, True), (0.8e-12, False), (-1.0, True)])
def test_what_moves_in_a_locked_freedom_is_refused_but_for_rounding(
    part: float, refused: bool
) -> None:
    one = ball(velocity=[[1.0, part, 0.0]], free=np.array([[True, False, True]]))
    reason = ADAPTER.refuses(ball_ask(one), PLAIN) or ""
    assert ("in a locked freedom" in reason) is refused
