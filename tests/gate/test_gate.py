"""The gate on a tiny project: what it never lets pass, baselines, speed, and report-only checks."""

import json
import os
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import Tiny, tiny_project
from tests.support.fabricated import entry, record
from vv.case import Check
from vv.gate.judgement import exit_bits, record_findings
from vv.records.finding import Aspect, Bit

GOOD = ("fall:up", "--codes", "fake/good")
BASELINE = "cases/baselines/fall.json"


def gate(tiny: Tiny, *words: str) -> tuple[int, str]:
    """Exit status and output of a gate run."""
    done = tiny.vv("gate", *(words or GOOD))
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout


def accept(tiny: Tiny, *words: str, reason: str = "it was looked at") -> str:
    done = tiny.vv("accept", "fall", "--reason", reason, *words)
    assert done.returncode == 0, done.stderr
    return done.stdout


def baseline(tiny: Tiny) -> dict[str, Any]:
    return dict(json.loads((tiny.root / BASELINE).read_text()))


def test_a_code_that_is_not_selected_is_not_even_imported(tiny: Tiny) -> None:
    (tiny.root / "adapters" / "slow.py").write_text('raise RuntimeError("it was imported")\n')
    done = tiny.vv("run", *GOOD, "--fresh")
    assert (done.returncode, "it was imported" in done.stdout + done.stderr) == (0, False)


def only_good(tiny: Tiny) -> None:
    """Leave the well-behaved scheme alone, so that accepting a case is quick."""
    tiny.edit("adapters/fake.py", "(*map(scheme, NAMES), Scheme(", "(scheme('good'),) or (Scheme(")


def test_a_gate_without_a_baseline_says_so_and_is_red_where_one_is_demanded(tiny: Tiny) -> None:
    code, said = gate(tiny)
    assert code == 0
    assert "note: fall: no baseline; to accept one: vv accept fall" in said
    (tiny.root / "kept").mkdir()
    code, said = gate(tiny, *GOOD, "--against", "kept")
    assert code == Bit.INCOMPLETE
    assert "gate: red (32): incomplete" in said


def test_a_gate_against_a_folder_takes_no_baseline_from_elsewhere(tiny: Tiny) -> None:
    only_good(tiny)
    assert tiny.vv("accept", "fall", "--reason", "right").returncode == 0
    assert gate(tiny, *GOOD, "--against", "cases/baselines")[0] == 0
    (tiny.root / "kept").mkdir()
    code, said = gate(tiny, *GOOD, "--against", "kept")
    assert (code, "no baseline" in said) == (Bit.INCOMPLETE, True)


def test_a_case_that_reports_nothing_is_incomplete(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", "(height, final, turns))", "())")
    code, said = gate(tiny)
    assert code == Bit.INCOMPLETE
    assert "reported nothing to judge" in said


def test_an_empty_selection_and_one_that_only_refuses_are_not_green(tiny: Tiny) -> None:
    assert gate(tiny, "fall:slow", "--codes", "fake/good")[0] == Bit.USAGE
    code, said = gate(tiny, "fall:up", "--codes", "fake/refuses,missing")
    assert (code, "nothing ran" in said) == (Bit.INCOMPLETE, True)


def test_an_answer_that_is_the_reference_bit_by_bit_fails(tiny: Tiny) -> None:
    code, said = gate(tiny, "fall:up", "--codes", "fake/copies")
    assert code == Bit.ACCURACY
    assert "identical to the reference to the last bit" in said


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("adapters/fake.py", "from reference_solutions import fall as known"),
        ("cases/fall.py", "from adapters import fake"),
    ],
)
def test_a_reference_made_of_the_code_under_test_fails(tiny: Tiny, file: str, text: str) -> None:
    tiny.edit(file, "import numpy as np\n", f"import numpy as np\n{text}\n")
    code, said = gate(tiny)
    assert code == Bit.ACCURACY
    assert re.search(r"the reference and the code share the source file \w+\.py", said)


def test_dissipation_below_zero_is_a_conservation_finding(tiny: Tiny) -> None:
    code, said = gate(tiny, "fall:up", "--codes", "fake/leaks")
    assert code == Bit.CONSERVATION
    assert "energy not conserved: drag dissipation gave 0.001 J, allowed 1e-09 J" in said


def test_accepting_writes_a_sorted_file_with_reason_platform_and_versions(
    accepted: Tiny, first: tuple[Path, str]
) -> None:
    assert "fall: no baseline" in first[1]
    text = (accepted.root / BASELINE).read_text()
    lines = re.findall(r'^  "((?:up|slow) .*?)": ', text, re.MULTILINE)
    assert lines == sorted(lines)
    assert len(lines) == 6  # two variants at three rungs, each on its line
    (taken,) = baseline(accepted)["acceptances"].values()
    assert taken["reason"] == "it was looked at"
    assert {"vv", "python", "numpy", "fake"} <= taken["versions"].keys()
    assert taken["machine"]["processor"]
    assert gate(accepted)[0] == 0
    assert accepted.vv("report").returncode == 0
    report = (accepted.root / ".vv" / "report" / "case-fall.html").read_text()
    assert "Reason: it was looked at" in report


def test_accepting_again_what_nothing_changed_says_that_the_reason_is_not_recorded(
    accepted: Tiny,
) -> None:
    before = (accepted.root / BASELINE).read_bytes()
    said = accept(accepted)
    assert "fall.json is unchanged: the reason is not recorded" in said
    assert "results in" not in said
    assert (accepted.root / BASELINE).read_bytes() == before


def test_only_results_that_are_right_are_accepted(tiny: Tiny) -> None:
    assert tiny.vv("accept", "fal", "--reason", "x").returncode == Bit.USAGE
    tiny.edit("adapters/fake.py", '"killed", "hangs", ', "")
    said = accept(tiny)
    assert "not in the baseline: 6 of fake/coarse: fail" in said
    schemes = {name.split()[1] for name in baseline(tiny)["results"]}
    assert "fake/good" in schemes
    assert schemes.isdisjoint({"fake/coarse", "fake/zeros", "fake/nan", "fake/copies"})


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """A tiny project of one good scheme with an accepted baseline, and what accepting said."""
    tiny = tiny_project(tmp_path_factory.mktemp("accepted"))
    only_good(tiny)
    return tiny.root, accept(tiny)


@pytest.fixture
def accepted(first: tuple[Path, str], tmp_path: Path) -> Tiny:
    """A copy of it, with its store."""
    shutil.copytree(first[0], tmp_path, dirs_exist_ok=True)
    return Tiny(tmp_path)


def test_a_perturbed_constant_is_a_regression_though_within_tolerance(accepted: Tiny) -> None:
    accepted.edit("adapters/fake.py", "FACTOR = 1.0", "FACTOR = 1.0 + 1e-7")
    code, said = gate(accepted)
    assert code == Bit.ACCURACY
    assert "red: fall:up fake/good dt=0.1 y: worse than accepted: error" in said
    assert "it may move by 1e-09: our own arithmetic" in said
    assert "red: fall:up fake/good dt=0.1 y_end: moved since it was accepted: value" in said
    before = baseline(accepted)
    done = accepted.vv("accept", "fall", "--dry-run")
    assert "fall:slow fake/good dt=0.025 y: worse than accepted" in done.stdout
    assert baseline(accepted) == before


def test_a_better_result_is_green_and_asks_to_be_accepted(tiny: Tiny) -> None:
    only_good(tiny)
    tiny.edit("adapters/fake.py", "FACTOR = 1.0", "FACTOR = 1.0 + 1e-5")
    tiny.edit("cases/fall.py", "(height, final, turns))", "(height,))")
    accept(tiny)
    tiny.edit("adapters/fake.py", "FACTOR = 1.0 + 1e-5", "FACTOR = 1.0 + 1e-7")
    code, said = gate(tiny, *GOOD, "--markdown", "summary.md")
    assert code == 0
    assert "fake/good dt=0.1 y: better than accepted: error 1e-05, now 1e-07" in said
    assert 'vv accept fall --reason "..."' in (tiny.root / "summary.md").read_text()
    assert "y: better than accepted" in accept(tiny, reason="the factor was too large")
    assert len(baseline(tiny)["acceptances"]) == 1
    assert "regression better" not in gate(tiny)[1]


def test_rounding_is_no_regression_and_keeps_the_old_acceptance(accepted: Tiny) -> None:
    before = baseline(accepted)
    accepted.edit("adapters/fake.py", "FACTOR = 1.0", "FACTOR = 1.0 + 1e-11")
    assert gate(accepted)[0] == 0
    assert "fall: no change since its baseline" in accept(accepted, reason="again")
    assert baseline(accepted) == before


def test_a_baseline_of_other_parameters_is_red(accepted: Tiny) -> None:
    accepted.edit("cases/fall.py", '"speed", 5.0', '"speed", 5.5')
    code, said = gate(accepted)
    assert code == Bit.INCOMPLETE
    assert "the baseline was taken with speed = 5.0, now 5.5" in said


def test_results_that_vanish_are_red(accepted: Tiny) -> None:
    accepted.edit("adapters/fake.py", 'scheme == "refuses" else None', "True else None")
    code, said = gate(accepted)
    assert code == Bit.ACCURACY | Bit.INCOMPLETE
    assert "has a baseline, but now: refused" in said
    accepted.edit("adapters/fake.py", "(scheme('good'),)", "(scheme('other'),)")
    accepted.edit("adapters/fake.py", '"it does not feel like it" if True else None', "None")
    code, said = gate(accepted, "fall:up", "--codes", "fake")
    assert code == Bit.ACCURACY
    assert "fake/good: has a baseline, but is no longer there" in said


def test_checks_that_a_case_does_not_enforce_are_reported_only(accepted: Tiny) -> None:
    accepted.edit("cases/fall.py", "    declare=declare,\n",
                  "    declare=declare, enforced=frozenset(),\n")  # fmt: skip
    accepted.edit("adapters/fake.py", "FACTOR = 1.0", "FACTOR = 1.01")
    code, said = gate(accepted)
    assert code == 0
    assert "reported only: fall:up fake/good dt=0.1 y: error" in said
    assert "reported only: fall:up fake/good dt=0.1 y: worse than accepted" in said


def test_a_law_that_a_case_does_not_enforce_is_reported_only() -> None:
    gained = {"terms": {}, "unaccounted": 1.0, "peak": 1.0, "bound": 1e-9, "audits": {}}
    broken = record("fake/good", "up", 0.1, ledger=gained, quantities=[entry("pass", {})])
    for checks, red in (([Check.ACCURACY, Check.CONSERVATION], True), ([Check.ACCURACY], False)):
        (found,) = record_findings([broken], enforced={"bounce": checks})
        assert found.check is Aspect.CONSERVATION
        assert found.red is red
    assert exit_bits([broken]) == Bit.CONSERVATION


def test_a_slower_solve_is_red_only_in_a_new_timing_session(tiny: Tiny) -> None:
    only_good(tiny)
    accept(tiny, "--timing")
    assert all(low <= high for low, high in
               (r["cost"] for r in baseline(tiny)["results"].values() if "cost" in r))  # fmt: skip
    tiny.edit("adapters/fake.py", "WORK = 2000", "WORK = 40000")
    assert "speed slower" not in gate(tiny)[1]  # its last session timed other code
    code, said = gate(tiny, *GOOD, "--timing")
    assert code == Bit.SPEED
    assert "red: fall:up fake/good dt=0.1: slower than accepted: solve takes" in said
    code, said = gate(tiny)
    assert code == 0
    assert "reported only: fall:up fake/good dt=0.1: slower" in said
    tiny.edit("adapters/fake.py", "WORK = 40000", "WORK = 100")
    code, said = gate(tiny, *GOOD, "--timing")
    assert (code, "dt=0.1: faster than accepted" in said) == (0, True)


def test_timing_that_times_nothing_is_incomplete(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", "timed=RUNGS[:2]", "timed=()")
    code, said = gate(tiny, *GOOD, "--timing")
    assert (code, "nothing was timed" in said) == (Bit.INCOMPLETE, True)


def test_an_executable_that_changed_in_secret_is_run_again(tiny: Tiny) -> None:
    program = tiny.root / "program"
    program.write_text("one")
    tiny.edit(
        "adapters/fake.py", 'version="1.0"', f"version='1.0', files=(Path({str(program)!r}),)"
    )
    log = tiny.root / "log"
    state = program.stat()
    for text in ("one", "two"):
        program.write_text(text)
        os.utime(program, ns=(state.st_atime_ns, state.st_mtime_ns))
        assert tiny.vv("gate", *GOOD, FAKE_LOG=str(log)).returncode == 0
    assert len(log.read_text().splitlines()) == 2


def test_a_stored_result_in_the_wrong_place_answers_nothing(tiny: Tiny) -> None:
    gate(tiny)
    tiny.edit("adapters/fake.py", "FACTOR = 1.0", "FACTOR = 1.1")
    records = tiny.root / ".vv" / "records"
    (old,) = records.rglob("*.json")
    content = old.read_text()
    assert gate(tiny)[0] == Bit.ACCURACY
    for path in records.rglob("*.json"):  # a store that was put together wrongly
        path.write_text(content)
    assert gate(tiny)[0] == Bit.ACCURACY


def test_a_broken_baseline_is_a_usage_error_that_names_the_file(accepted: Tiny) -> None:
    path: Path = accepted.root / BASELINE
    whole = path.read_text()
    for text in (whole[:200], whole.replace('"case": "fall"', '"case": "rise"')):
        path.write_text(text)
        done = accepted.vv("gate", *GOOD)
        assert (done.returncode, BASELINE in done.stderr) == (Bit.USAGE, True)
