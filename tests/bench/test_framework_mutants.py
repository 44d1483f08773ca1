"""The bench of mutants of the framework: what it turns, what it asks, and how it puts one in."""

import ast
import gc
import os
import re
import signal
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from bench.mutation import framework_mutants
from bench.mutation.collected_tests import Collected, forked
from bench.mutation.covering_tests import Record, digest
from bench.mutation.engine_mutants import _key
from bench.mutation.framework_mutants import LONGEST, Asked, folders
from bench.mutation.framework_sites import (
    EVERY,
    LAYERS,
    Mutant,
    equivalent_kinds,
    equivalents,
    is_equivalent,
    mutants,
    turnable,
    uniform,
)
from bench.mutation.mutants import ROOT, all_places
from vv.gate import judgement

FILE = "vv/gate/judgement.py"


def named(words: str, file: str = FILE) -> Mutant:
    """The one mutant of a file whose change begins with these words."""
    (found,) = (one for one in mutants("vv", file, EVERY) if one.change.startswith(words))
    return found


def known(mutant: Mutant, **of_line: dict[str, float]) -> Asked:
    """What a bench knows; of_line: seconds of tests that run a mutant's line or another."""
    own, other = mutant.lines[0], mutant.lines[-1] + 1
    seconds = {**of_line.get("own", {}), **of_line.get("other", {}), **of_line.get("none", {})}
    lines = {own: [*of_line.get("own", {})], other: [*of_line.get("other", {})]}
    return Asked(Path(), seconds, {mutant.file: lines}, LONGEST)


def asked(mutant: Mutant, **of_line: dict[str, float]) -> list[str]:
    """Tests that a mutant is put to."""
    return known(mutant, **of_line).tests(mutant)


def test_a_sample_of_the_framework_is_drawn_from_every_layer_anew_with_every_seed() -> None:
    first, again, other = (uniform("*", 200, seed) for seed in (1, 1, 2))
    assert first == again
    assert len({*first}) == len({*other}) == 200
    assert len({*first} & {*other}) < 20
    layers = [sum(m.file.startswith(f"{one}/") for m in (*first, *other)) for one in LAYERS]
    assert sum(layers) == 400
    assert sum(n > 0 for n in layers) > 12


def test_every_layer_but_the_engines_has_mutants() -> None:
    layers = {f"vv/{path.parent.name}" for path in (ROOT / "vv").glob("*/__init__.py")}
    assert layers - {"vv/engines"} == {one for one in LAYERS if "/" in one}


def test_a_mutant_that_is_known_as_equivalent_is_there_with_a_reason_and_is_not_drawn() -> None:
    files = {key.partition(" ")[0] for key in equivalents()}
    there = {one.key for file in files for one in turnable(file)}
    there |= {_key(one) for one in all_places(sorted(f for f in files if "/engines/" in f))}
    assert equivalents().keys() <= there
    assert not equivalents().keys() & {one.key for one in uniform("*", EVERY, 1)}
    assert all(why.strip() for why in equivalents().values())


def test_a_kind_of_equivalent_mutants_names_small_constants_of_references_and_nothing_else() -> (
    None
):
    (kind,) = equivalent_kinds()
    files = sorted((ROOT / "reference_solutions").rglob("*.py"))
    every = [one for path in files for one in turnable(path.relative_to(ROOT).as_posix())]
    named_by_it = [one for one in every if re.fullmatch(kind, one.key)]
    assert 100 < len(named_by_it) < 0.03 * len(every)
    assert all(isinstance(one.node, ast.Constant) for one in named_by_it)
    assert all(is_equivalent(one.key) for one in named_by_it)
    assert not {*named_by_it} & {*uniform("*", EVERY, 1, "references")}
    assert not is_equivalent("reference_solutions/a.py f: 2e-09  ->  3e-09")
    assert not is_equivalent("vv/base/a.py f: 1e-09  ->  1.5e-09")


def test_references_are_a_part_of_their_own_that_their_tests_are_asked_of() -> None:
    found = uniform("*", 50, 1, "references")
    assert {one.file.partition("/")[0] for one in found} == {"reference_solutions"}
    references, *of_cases = folders("references")
    assert references == "tests/references"
    assert "tests/cases/stability/test_chain.py" in of_cases  # the only test of its second route
    assert "tests/cases/test_levels.py" not in of_cases
    assert not {"tests/references", "tests/engines"} & {*folders("framework")}
    assert "tests/gate" in folders("framework")


OWN, FAR = "tests/gate/test_judgement.py", "tests/output/test_rows.py"


def test_a_mutant_is_put_to_the_tests_that_run_its_line_those_of_its_folder_first() -> None:
    one = named("one.error / one.tolerance")
    own = {f"{FAR}::a": 1.0, f"{OWN}::slow": 5.0, f"{OWN}::quick": 2.0}
    assert asked(one, own=own) == [f"{OWN}::quick", f"{OWN}::slow", f"{FAR}::a"]
    beside = {f"{OWN}::other": 0.1, "tests/run/test_x.py::far": 0.1}
    assert asked(one, own=own, none=beside)[-1] == f"{OWN}::other"
    assert asked(one, own={f"{OWN}::long": 1.1 * LONGEST}) == []


def test_a_mutant_that_no_test_runs_is_put_to_those_of_its_file() -> None:
    one, constant = named("one.error / one.tolerance"), f"{OWN}::reads_a_constant_alone"
    bench = known(one, own={f"{FAR}::own": 2.0}, other={f"{OWN}::a": 1.0}, none={constant: 0.1})
    assert bench.tests_of_file(one) == [f"{OWN}::a", f"{FAR}::own", constant]


def test_a_mutant_is_seen_on_import_if_tests_pass_without_it_and_not_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one, original = named("one.error / one.tolerance"), (ROOT / FILE).read_text()
    (tmp_path / "vv" / "gate").mkdir(parents=True)
    bench = Asked(tmp_path, {"a": 1.0}, {FILE: {one.lines[0]: ["a"]}}, LONGEST)
    for fails, seen in (
        ({one.text()}, "when imported"), ({one.text(), original}, None), ({*()}, None)
    ):  # fmt: skip
        monkeypatch.setattr(
            framework_mutants, "passes",
            lambda project, *tests, fails=fails: (project / FILE).read_text() not in fails,
        )  # fmt: skip
        bench._green_on_import.clear()
        assert bench.red_on_import(one) == seen
        assert (tmp_path / FILE).read_text() == original


@pytest.mark.parametrize(("red_with", "seen"), [("y.py::b", "when imported"), ("x.py::a", None)])
def test_a_test_that_is_red_without_a_mutant_does_not_hide_what_other_files_detect(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, red_with: str, seen: str | None
) -> None:
    """The test of x.py is red with the mutant and without it."""
    one, original = named("one.error / one.tolerance"), (ROOT / FILE).read_text()
    (tmp_path / "vv" / "gate").mkdir(parents=True)
    (tmp_path / FILE).write_text(original)

    def passes(project: Path, *tests: str) -> bool:
        mutated = (project / FILE).read_text() != original
        return "x.py::a" not in tests and not (mutated and red_with in tests)

    monkeypatch.setattr(framework_mutants, "passes", passes)
    seconds, lines = {"x.py::a": 0.5, "y.py::b": 1.0}, {one.lines[0]: ["x.py::a", "y.py::b"]}
    assert Asked(tmp_path, seconds, {FILE: lines}, LONGEST).red_on_import(one) == seen


def test_a_mutant_that_no_test_runs_at_all_survives() -> None:
    one = named("one.error / one.tolerance")
    assert Asked(Path("nowhere"), {}, {}, LONGEST).red_on_import(one) is None


def test_what_runs_on_import_is_told_from_what_runs_when_called() -> None:
    every = list(mutants("vv", "vv/scene/*", EVERY))
    on_import = {one.what for one in every if not one.when_called}
    assert 0 < len(on_import) < 0.2 * len(every)
    assert named("one.error / one.tolerance").when_called


def test_what_a_function_does_on_import_alone_is_asked_of_an_import() -> None:
    one = named("one.error / one.tolerance")
    at, beside = one.lines[0], one.lines[-1] + 1
    for lines, called in (({at: ["a"]}, True), ({at: []}, False), ({beside: ["a"]}, False)):
        assert Asked(Path(), {"a": 1.0}, {one.file: lines}, LONGEST).when_called(one) is called


def test_the_lines_of_a_mutant_are_its_statement_s_without_the_body() -> None:
    one = named("one.value is not None and one.printed is not None")
    assert len(one.lines) == 1
    assert one.lines[0] == one.node.lineno


def test_a_mutant_is_put_into_functions_that_are_loaded() -> None:
    whole = Collected(ROOT, lambda _: None)
    whole.pytest_runtestloop(cast(pytest.Session, SimpleNamespace(items=[])))
    gc.unfreeze()
    row: Any = SimpleNamespace(
        error=None, tolerance=None, value=None, measurement=None, printed=None, note=""
    )
    assert judgement._in_words(row) == "not finite"

    def told(mutant: Mutant | None) -> None:
        if mutant:
            whole._put_in(mutant)
        assert judgement._in_words(row) == "not finite"

    assert forked(lambda: told(None), 60.0) == 0
    assert forked(lambda: told(named("one.error is not None and one.tol")), 60.0) == 0
    assert forked(lambda: told(named("one.value is not None  ->")), 60.0) != 0


def test_a_record_holds_if_a_test_passed_as_long_as_the_files_are_those_of_its_copy(
    tmp_path: Path,
) -> None:
    (tmp_path / "vv" / "gate").mkdir(parents=True)
    (tmp_path / FILE).write_bytes((ROOT / FILE).read_bytes())
    assert Record({"passed": 0.1}, {}, {FILE: digest(FILE, tmp_path)}).holds
    assert not Record({}, {}, {FILE: digest(FILE, tmp_path)}).holds
    (tmp_path / FILE).write_text("edited while it was recorded")
    assert not Record({"passed": 0.1}, {}, {FILE: digest(FILE, tmp_path)}).holds


def test_each_test_has_a_time_of_its_own_after_which_it_hangs() -> None:
    """Slow tests before it leave one without end no more than its own."""
    spent = {"slow": 0.3, "endless": 600.0, "never": 0.0}
    whole = Collected(ROOT, lambda _: None)

    def run(item: Any, nextitem: Any) -> None:
        until = time.process_time() + spent[item.name]
        while time.process_time() < until:
            pass

    config = SimpleNamespace(hook=SimpleNamespace(pytest_runtest_protocol=run))
    whole.tests = {
        name: cast(pytest.Item, SimpleNamespace(name=name, config=config)) for name in spent
    }
    assert whole.red_with({"slow": 0.6, "never": 0.1}, lambda: None) is None
    before = sum(os.times()[2:4])
    limits = {"slow": 5.0, "endless": 0.2, "never": 5.0}
    assert whole.red_with(limits, lambda: None) == f"ends with {signal.SIGPROF}"
    assert sum(os.times()[2:4]) - before < 1.0
