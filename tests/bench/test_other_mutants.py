"""The benches of mutants of the engines and of the cases: what they draw, and what they ask."""

from __future__ import annotations

import ast
import os
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from bench.mutation import case_mutants, engine_gate, engine_mutants, forked_tests
from bench.mutation.engine_gate import Red
from bench.mutation.framework_sites import named, turnable
from bench.mutation.in_copy.switch import NUMBER
from bench.mutation.mutants import ROOT, Mutant, all_places, parsed, turned
from bench.mutation.schemata import switchable


def test_mutants_of_engines_are_drawn_anew_with_every_seed_and_can_be_switched_on() -> None:
    some = "vv/engines/*/law.py"
    first, again, other = (engine_mutants.drawn(some, 9, seed) for seed in (1, 1, 2))
    assert first == again
    assert len({*first}) == 9 > len({*first} & {*other})
    assert all(map(switchable, first))
    assert {one.file for one in engine_mutants.drawn("vv/engines/dda/law.py", 3, 1)} == {
        "vv/engines/dda/law.py"
    }


def test_two_products_that_start_at_one_place_are_two_mutants() -> None:
    every = [*all_places(["vv/engines/rigid/point/trial.py", "vv/engines/dda/law.py"])]
    assert len({one.what for one in every}) == len(every)


def test_a_mutant_of_an_engine_that_is_known_as_equivalent_is_not_drawn(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    (first, *_), file = engine_mutants.drawn("vv/engines/dda/law.py", 3, 1), "vv/engines/dda/law.py"
    node = [*ast.walk(parsed(file))][first.place]
    key = named(file, node, turned(node))
    monkeypatch.setattr(engine_mutants, "is_equivalent", lambda one: one == key)
    assert first not in engine_mutants.drawn(file, 10**6, 1)


def test_a_mutant_is_asked_of_tests_near_it_first_as_far_as_time_allows() -> None:
    """Those that import its file, then those of its engine, then others."""
    collected: Any = None
    own, far = "tests/engines/dda/test_a.py::", "tests/engines/dem/test_b.py::"
    near = "tests/engines/dda/by_hand/test_law.py::slow"
    seconds = {f"{far}quick": 0.1, f"{own}slow": 3.0, f"{own}quick": 1.0, f"{far}slow": 9.0}
    asked = engine_mutants.Asked(collected, {**seconds, near: 2.0}, 6.5)
    mutant = Mutant("", "vv/engines/dda/law.py", (), 0)
    assert asked.tests(mutant) == [near, f"{own}quick", f"{own}slow", f"{far}quick"]


def test_a_mutant_is_switched_on_for_this_process_and_those_it_starts(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    plain, compiled = SimpleNamespace(ON=0), SimpleNamespace(WORD=SimpleNamespace(value=0))
    monkeypatch.setitem(sys.modules, "vv.switch", plain)
    monkeypatch.setitem(sys.modules, "vv.switch_compiled", compiled)
    monkeypatch.setenv(NUMBER, "0")
    engine_mutants.switch_on(7)
    assert (plain.ON, compiled.WORD.value, os.environ[NUMBER]) == (7, 7, "7")


def test_a_mutant_of_an_engine_is_part_of_the_codes_that_import_it() -> None:
    def codes(file: str) -> list[str]:
        return [*engine_mutants.codes_of(Mutant("", file, (), 0))]

    assert codes("vv/engines/dda/law.py") == ["dda"]
    assert {"dda", "rigid"} <= {*codes("vv/engines/blocks/geometry.py")}


def test_a_mutant_of_a_case_is_put_to_tests_of_its_file_its_page_record_gate_and_tests() -> None:
    (first, *_) = turnable("cases/hard/wedge.py")
    asked = [*case_mutants.questions(first)]
    assert asked[0] == ("page", "wedge")
    assert ("tests", "cases/hard/wedge.py") in asked
    assert [way for way, case in asked if case == "wedge"] == [
        "page", "record", "gate", "tests"
    ]  # fmt: skip
    assert len(asked) <= 1 + 4 * case_mutants.ASKED
    assert "tests/cases/hard/test_wedge.py" in case_mutants.tests_of("wedge")
    least = "tests/cases/impact/test_least_of_largest.py"
    assert case_mutants.tests_of("cases/impact/parts/_oblique.py")[-1] == least
    gas = "tests/cases/bulk/test_homogeneous_cooling.py"
    assert case_mutants.tests_of("cases/bulk/homogeneous_cooling.py") == (gas,)


def test_a_mutant_of_what_statements_of_papers_use_is_put_to_tests_of_the_papers_too() -> None:
    for file in ("cases/papers/_liu_2017.py", "cases/bonds/parts/_quartzite_lattice.py"):
        assert case_mutants.tests_of(file)[:2] == case_mutants.PAPERS


def test_the_gate_is_not_asked_of_a_case_that_it_does_not_run_quickly() -> None:
    (first, *_) = turnable("cases/bulk/hopper.py")
    assert {way for way, case in case_mutants.questions(first) if case == "hopper"} == {
        "page", "record", "tests"
    }  # fmt: skip


def test_a_way_of_asking_that_is_red_without_a_mutant_ends_the_bench(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(case_mutants.WAYS, "page", lambda project, case: True)
    with pytest.raises(SystemExit, match="page of wedge: red without a mutant"):
        case_mutants.seen_by(tmp_path, turnable("cases/hard/wedge.py")[0])


def gate_says(monkeypatch: pytest.MonkeyPatch, said: dict[int, set[Red]]) -> None:
    """Let the gate find this with each mutant on."""
    monkeypatch.setattr(engine_gate, "reds", lambda project, code, number: said[number])
    engine_gate.without_mutant.cache_clear()


def test_a_gate_that_is_wrong_without_a_mutant_ends_the_bench(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for kind in ("accuracy: fail", "regression: gone", engine_gate.HANGS):
        gate_says(monkeypatch, {0: {("bounce", "h", kind)}, 7: set()})
        with pytest.raises(SystemExit, match=f"nothing can be judged: bounce h {kind}"):
            engine_gate.seeing(tmp_path, ["dda"], 7)


def test_a_few_tests_that_are_red_without_a_mutant_are_left_out_and_many_end_the_bench() -> None:
    fine = {f"test_{k}": 1.0 for k in range(38)}
    assert engine_mutants.those_green(fine | {"red": float("inf")}) == fine
    with pytest.raises(SystemExit, match="nothing can be judged: red, too, three"):
        engine_mutants.those_green(fine | dict.fromkeys(["red", "too", "three"], float("inf")))


def test_a_result_that_moves_without_a_mutant_says_nothing_of_one(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    moved, other = ("rocking", "x", "regression: moved"), ("wedge", "d", "regression: moved")
    gate_says(monkeypatch, {0: {moved}, 7: {moved}, 8: {moved, other}})
    assert engine_gate.seeing(tmp_path, ["dda"], 7) == ""
    assert engine_gate.seeing(tmp_path, ["dda"], 8) == "gate of dda"


def test_what_a_gate_calls_red_is_read_from_its_junit_file() -> None:
    said = """<testsuites><testsuite name="wedge">
        <testcase classname="wedge" name="fine"/><testcase classname="wedge" name="not run">
        <skipped/></testcase><testcase classname="wedge" name="d"><failure type="a: b"/></testcase>
        <testcase classname="wedge" name="e"><error type="c"/></testcase></testsuite></testsuites>
    """
    assert engine_gate.told(said) == {("wedge", "d", "a: b"), ("wedge", "e", "c")}


def test_what_cases_share_is_asked_of_those_that_name_it_first() -> None:
    shared = case_mutants.cases_of("cases/bonds/parts/_unit.py")
    assert {*shared[: case_mutants.ASKED]} >= {"tetrahedral-path", "tetrahedral-unit"}
    assert shared.index("close-packed-energy") >= case_mutants.ASKED
    assert case_mutants.cases_of("cases/bonds/tetrahedral_unit.py")[0] == "tetrahedral-unit"


def test_tests_that_never_end_are_red(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "test_spins.py").write_text("def test_spins():\n    while True: pass\n")
    monkeypatch.setattr(forked_tests, "SPENT", 3.0)
    monkeypatch.setattr(forked_tests, "LIMIT", 60)
    before = sum(os.times()[2:4])
    assert not forked_tests.passes(tmp_path, "test_spins.py")
    assert sum(os.times()[2:4]) - before < 6.0  # s of CPU time


def test_tests_that_never_end_without_a_bug_are_neither_green_nor_red(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "test_waits.py").write_text(
        "import time\ndef test_waits(): time.sleep(60)\ndef test_is_red(): assert False\n"
    )
    assert not forked_tests.green(tmp_path, "test_waits.py::test_is_red", False)
    monkeypatch.setattr(forked_tests, "LIMIT", 2)
    with pytest.raises(TimeoutError, match="did not end within 2 s"):
        forked_tests.green(tmp_path, "test_waits.py", False)


def test_what_is_of_no_case_is_put_to_the_tests_of_papers() -> None:
    file = "cases/papers/_li_2018.py"
    (first, *_) = turnable(file)
    assert [*case_mutants.questions(first)] == [("tests", file)]
    assert all((ROOT / one).is_file() for one in case_mutants.tests_of(file))
    assert len(case_mutants.tests_of(file)) >= 2


def test_mutants_of_cases_are_drawn_anew_with_every_seed() -> None:
    first, again, other = (case_mutants.drawn("cases/hard/*", 20, seed) for seed in (1, 1, 2))
    assert first == again
    assert len({*first} & {*other}) < 10
    assert all(one.file.startswith("cases/hard/") for one in first)
