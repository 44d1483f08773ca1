"""Claims about a code that a driver runs: its model, and runs that it calls wrong itself."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from tests.scene.test_scene import balls, scene
from tests.support.fabricated import some
from vv.ask import Ask, Displacement, History, Method, Run, Status
from vv.codes import Scheme
from vv.codes.driver_adapter import DriverAdapter
from vv.scene import Scene, Term

SCHEME = Scheme("default", "", Method.SECOND_ORDER, frozenset({Term.SPHERE}))
ONE, TWO = scene(), scene(balls(2), eta=0.5)


class Driver:
    """A driver that answers with the number of the ask, and notes what it was given."""

    home = some(name="mine")

    def __init__(self) -> None:
        self.given: list[Any] = []

    def run(self, asks: Any, built: Any, scratch: Any, repeat: float) -> Iterator[Run]:
        self.given += built
        yield from (Run(Status.RAN, str(number)) for number, _ in enumerate(asks))

    def script(self, plan: Any, notes: str) -> str:
        return f"{plan}: {notes}"


def adapter(driver: Any, **parts: Any) -> DriverAdapter:
    return DriverAdapter(
        SCHEME, driver, ("a note", "and another"),
        refusal=lambda ask: f"refuses {ask.goal.duration:g}",
        plan=lambda ask: {"duration": ask.goal.duration},
        frame=lambda ask: ask.goal.duration * np.eye(3), **parts,
    )  # fmt: skip


def ask(duration: float, of: Scene = ONE) -> Ask:
    return Ask(of, History(duration, 0.1), (Displacement(0),))


def test_a_model_counts_what_is_integrated_and_has_the_terms_of_both_scenes() -> None:
    plain = adapter(Driver()).describe(ask(1.0), "default")
    assert (plain.unknowns, plain.terms) == (ONE.unknowns(), ONE.terms())
    other = adapter(Driver(), integrated=lambda _: TWO).describe(ask(1.0), "default")
    assert (other.unknowns, other.terms) == (TWO.unknowns(), ONE.terms() | TWO.terms())
    assert TWO.unknowns() != ONE.unknowns()
    assert TWO.terms() > ONE.terms()
    assert plain.note == "a note; and another"


def test_each_ask_has_its_own_plan_and_frame_and_a_fault_makes_a_run_an_error() -> None:
    driver = Driver()
    wrong = adapter(driver, fault=lambda ask, run: "it fell through" if run.reason == "1" else None)
    runs = [*wrong.run([ask(1.0), ask(2.0)], "default", None, 0.0)]  # type: ignore[arg-type]
    assert [(run.status, run.reason) for run in runs] == [
        (Status.RAN, "0"), (Status.ERROR, "it fell through")
    ]  # fmt: skip
    assert [plan for plan, _, _ in driver.given] == [{"duration": 1.0}, {"duration": 2.0}]
    assert [frame[0, 0] for _, _, frame in driver.given] == pytest.approx([1.0, 2.0])


def test_its_input_has_its_notes_and_its_refusals_are_its_own() -> None:
    one = adapter(Driver())
    assert one.native(ask(1.0), "default") == "{'duration': 1.0}: a note; and another"
    assert one.refuses(ask(3.0), "default") == "refuses 3"
    assert (one.name, one.schemes) == ("mine", (SCHEME,))
