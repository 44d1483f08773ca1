"""An invocation is answered whole only while nothing that goes into it has changed."""

import json
import os
import shutil
import subprocess
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest import mock

import pytest

from tests.conftest import Tiny
from tests.support.fabricated import record
from vv.ask import Status
from vv.records.finding import Bit
from vv.run import reuse
from vv.run.reuse import is_reusable

SELECTION = ("run", "fall:up", "--codes", "fake/good")
SAYS = "nothing has changed since"


def stands(tiny: Tiny, *words: str, **environment: str) -> bool:
    done = tiny.vv(*(words or SELECTION), **environment)
    assert done.returncode == 0, done.stderr
    return SAYS in done.stderr


def test_the_same_again_stands_and_says_so_and_counts_alike(tiny: Tiny) -> None:
    first, again = tiny.vv(*SELECTION), tiny.vv(*SELECTION)
    assert SAYS not in first.stderr
    assert SAYS in again.stderr
    assert first.stdout.splitlines()[-1] == again.stdout.splitlines()[-1]
    assert len(list((tiny.root / ".vv" / "manifests").iterdir())) == 1


def test_the_same_again_tells_the_same_and_exits_alike(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", "Tolerance(1e-3", "Tolerance(1e-30")
    first, again = tiny.vv(*SELECTION), tiny.vv(*SELECTION)
    assert first.returncode == again.returncode == Bit.ACCURACY
    assert first.stdout == again.stdout
    assert "FAIL" in again.stdout


def test_what_was_printed_is_kept_for_the_same_again_and_only_then(tiny: Tiny) -> None:
    def printed() -> list[bool]:
        answers = (tiny.root / ".vv" / "answers").rglob("*")
        kept = [json.loads(path.read_text())["kept"] for path in answers if path.is_file()]
        return ["printed" in one for one in kept if "manifest" in one]

    assert SAYS not in tiny.vv(*SELECTION, "--fresh").stderr
    assert printed() == []
    stands(tiny)
    assert printed() == [True]


def heads(tiny: Tiny) -> list[str]:
    """The first lines of the manifests that are kept, oldest first."""
    found = sorted((tiny.root / ".vv" / "manifests").iterdir())
    return [path.read_text().partition("\n")[0] for path in found]


def test_a_commit_of_the_same_files_stands_and_is_kept_under_its_own_name(tiny: Tiny) -> None:
    tiny.git("init", "-q")
    (tiny.root / ".gitignore").write_text(".vv\n__pycache__\n")
    tiny.git("add", "-A")
    tiny.git("commit", "-q", "-m", "first")
    stands(tiny)
    tiny.git("commit", "-q", "--allow-empty", "-m", "second")
    assert stands(tiny)
    assert stands(tiny)
    before, after = heads(tiny)
    now = subprocess.check_output(["git", "rev-parse", "HEAD"], cwd=tiny.root, text=True).strip()
    assert now in after
    assert now not in before
    gate = tiny.vv("report")
    assert gate.returncode == 0, gate.stderr
    assert now[:7] in (tiny.root / ".vv" / "report" / "index.html").read_text()


@pytest.mark.parametrize("file", ["records/*/*.npz", "manifests/*.json"])
def test_what_was_told_is_not_told_again_where_a_file_was_damaged(tiny: Tiny, file: str) -> None:
    stands(tiny)
    damaged = next((tiny.root / ".vv").glob(file))
    damaged.write_bytes(damaged.read_bytes()[:-20])
    assert not stands(tiny)
    assert stands(tiny)


def test_a_report_that_was_touched_is_written_again(tiny: Tiny) -> None:
    stands(tiny)
    page = tiny.root / ".vv" / "report" / "index.html"
    page.write_text("")
    assert stands(tiny)
    assert "</html>" in page.read_text()


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("adapters/fake.py", "FACTOR = 1.0", "FACTOR = 1.0 + 1e-9"),
        ("cases/fall.py", "Tolerance(1e-3", "Tolerance(1e-2"),
        ("reference_solutions/fall.py", "g * t**2 / 2", "t**2 * g / 2"),
    ],
)
def test_a_change_of_a_source_ends_it(tiny: Tiny, file: str, old: str, new: str) -> None:
    stands(tiny)
    tiny.edit(file, old, new)
    assert not stands(tiny)
    assert stands(tiny)


@pytest.mark.parametrize(
    "more",
    [
        ("--fresh",),
        ("--level", "quick"),
        ("--set", "g=9"),
        ("--rung", "dt=0.01"),
        ("--codes", "fake/coarse"),
        ("fall:slow",),
    ],
)
def test_whoever_asks_for_something_else_is_not_answered_with_the_same(
    tiny: Tiny, more: tuple[str, ...]
) -> None:
    stands(tiny)
    assert SAYS not in tiny.vv(*SELECTION, *more).stderr


def test_another_environment_makes_another_invocation(tiny: Tiny) -> None:
    stands(tiny)
    assert not stands(tiny, *SELECTION, PATH="/usr/bin:/bin:/nowhere")


def test_where_and_how_results_are_written_does_not_change_them(tiny: Tiny, tmp_path: Path) -> None:
    stands(tiny)
    assert stands(tiny, *SELECTION, "--jobs", "1", "--json", str(tmp_path / "records.json"))
    assert stands(tiny, *SELECTION, "--require", "fake")
    gate = ("gate", "fall:up", "--codes", "fake/good")
    stands(tiny, *gate)
    assert stands(tiny, *gate, "--markdown", str(tmp_path / "gate.md"))
    assert "fall" in (tmp_path / "gate.md").read_text()


def test_a_folder_of_baselines_that_changed_judges_anew(tiny: Tiny) -> None:
    folder = tiny.root / "accepted"
    gate = ("gate", "fall:up", "--codes", "fake/good", "--against", str(folder))
    names = (tiny.root / "adapters/fake.py").read_text().partition("NAMES = (")[2].partition(")")
    tiny.edit("adapters/fake.py", names[0], '"good", "refuses"')
    assert tiny.vv("accept", "fall", "--reason", "first").returncode == 0
    shutil.copytree(tiny.root / "cases" / "baselines", folder)
    assert not stands(tiny, *gate)
    assert stands(tiny, *gate)
    (file,) = folder.glob("fall.json")
    file.write_text(file.read_text() + "\n")
    assert SAYS not in tiny.vv(*gate).stderr


def test_what_is_required_is_looked_at_though_all_stands(tiny: Tiny) -> None:
    stands(tiny)
    assert tiny.vv(*SELECTION, "--require", "none").returncode == Bit.USAGE
    done = tiny.vv(*SELECTION, "--require", "fake/coarse")
    assert SAYS in done.stderr
    assert "fake/coarse: required, but none of its jobs ran" in done.stdout
    assert done.returncode == Bit.INCOMPLETE


def test_a_report_that_was_touched_or_removed_is_written_again(tiny: Tiny) -> None:
    stands(tiny)
    report = tiny.root / ".vv" / "report" / "index.html"
    whole = report.read_bytes()
    report.write_bytes(b"cut off")
    assert stands(tiny)
    assert report.read_bytes() == whole
    for page in (report, report.with_name("case-fall.html")):
        page.unlink()
        assert stands(tiny)
        assert page.is_file()


def test_the_report_is_that_of_the_last_invocation_though_it_stood_before(tiny: Tiny) -> None:
    report = tiny.root / ".vv" / "report" / "index.html"
    stands(tiny)
    (own,) = (path.stem for path in (tiny.root / ".vv" / "manifests").iterdir())
    tiny.vv("run", "fall:up", "--codes", "fake/coarse")
    assert own not in report.read_text()
    assert stands(tiny)
    assert own in report.read_text()


def test_a_manifest_that_is_damaged_answers_nothing(tiny: Tiny) -> None:
    stands(tiny)
    (manifest,) = (tiny.root / ".vv" / "manifests").glob("*.json")
    manifest.write_text(manifest.read_text()[:100])
    assert not stands(tiny)


def test_a_failure_does_not_stand(tiny: Tiny) -> None:
    words = ("run", "fall:up", "--codes", "fake/raises")
    assert tiny.vv(*words).returncode == tiny.vv(*words).returncode != 0
    assert SAYS not in tiny.vv(*words).stderr


def test_files_asked_for_are_written_though_nothing_runs(tiny: Tiny, tmp_path: Path) -> None:
    target = tmp_path / "records.json"
    words = (*SELECTION, "--json", str(target))
    stands(tiny, *words)
    first = target.read_text()
    target.unlink()
    assert stands(tiny, *words)
    assert json.loads(target.read_text()) == json.loads(first)


def test_the_gate_judges_what_stands_as_it_did(tiny: Tiny) -> None:
    words = ("gate", "fall:up", "--codes", "fake/coarse,fake/leaks")
    first, again = tiny.vv(*words), tiny.vv(*words)
    assert SAYS in again.stderr
    assert first.returncode == again.returncode != 0


def test_baselines_of_another_folder_are_part_of_what_was_judged(
    tiny: Tiny, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("base")
    words = ("gate", "fall:up", "--codes", "fake/good", "--against", str(folder))
    tiny.vv(*words)
    assert SAYS in tiny.vv(*words).stderr
    (folder / "another.json").write_text("{}")
    assert SAYS not in tiny.vv(*words).stderr


def test_a_source_that_moved_to_another_folder_ends_it(tiny: Tiny) -> None:
    stands(tiny)
    (tiny.root / "cases" / "family").mkdir()
    (tiny.root / "cases" / "fall.py").rename(tiny.root / "cases" / "family" / "fall.py")
    assert not stands(tiny)


def test_a_change_behind_a_link_to_a_folder_ends_it(tiny: Tiny) -> None:
    """An adapter in a folder of its own elsewhere, with a link back in it that leads nowhere."""
    elsewhere = tiny.root / "elsewhere"
    elsewhere.mkdir()
    (tiny.root / "adapters" / "fake.py").rename(elsewhere / "__init__.py")
    (tiny.root / "adapters" / "fake").symlink_to(elsewhere)
    (elsewhere / "round").symlink_to(elsewhere)
    stands(tiny)
    assert stands(tiny)
    tiny.edit("elsewhere/__init__.py", "FACTOR = 1.0", "FACTOR = 1.0 + 1e-9")
    assert not stands(tiny)


def test_another_version_of_anything_installed_ends_it(tiny: Tiny) -> None:
    metadata = tiny.root / "lib" / "some.dist-info" / "METADATA"
    metadata.parent.mkdir(parents=True)
    path = os.pathsep.join([str(tiny.root / "lib"), os.environ.get("PYTHONPATH", "")])
    metadata.write_text("Metadata-Version: 2.1\nName: some\nVersion: 1.0\n")
    stands(tiny, PYTHONPATH=path)
    assert stands(tiny, PYTHONPATH=path)
    metadata.write_text("Metadata-Version: 2.1\nName: some\nVersion: 1.1\n")
    assert not stands(tiny, PYTHONPATH=path)


def test_without_the_series_of_a_record_nothing_stands(tiny: Tiny) -> None:
    stands(tiny)
    next((tiny.root / ".vv" / "records").rglob("*.npz")).unlink()
    assert not stands(tiny)


def test_a_timing_session_with_gaps_does_not_stand_and_names_them(tiny: Tiny) -> None:
    words = ("run", "--all", "--codes", "fake/good")
    whole = 'if scheme == "raises":'
    tiny.edit("adapters/fake.py", whole, "if repeat and ask.knobs.dt == 0.05:")
    assert not stands(tiny, *words)
    assert not stands(tiny, *words)
    assert "not timed, it failed: fall:up fake/good dt=0.05" in tiny.vv("speed", *words[2:]).stdout
    tiny.edit("adapters/fake.py", "if repeat and ask.knobs.dt == 0.05:", whole)
    stands(tiny, *words)
    assert stands(tiny, *words)


@pytest.mark.parametrize(
    ("study", "status", "lasting"),
    [
        ("grid", Status.DIVERGED, True),
        ("ladder", Status.DIVERGED, False),
        ("ladder", Status.RAN, True),
        ("grid", Status.TOO_LONG, True),
        ("grid", Status.TIMEOUT, False),
        ("ladder", Status.ERROR, False),
        ("ladder", Status.NOT_INSTALLED, True),  # what is installed is part of the identity
    ],
)
def test_only_what_no_second_try_would_change_lets_an_invocation_stand(
    study: str, status: Status, lasting: bool
) -> None:
    word = status.value.replace(" ", "-")
    assert is_reusable(record("a/b", "v", 1.0, study=study, status=word)) is lasting


def test_a_gate_leaves_the_report_to_its_command_and_says_so(tiny: Tiny) -> None:
    report = tiny.root / ".vv" / "report" / "index.html"
    done = tiny.vv("gate", "fall:up", "--codes", "fake/good")
    assert "; report: vv report; details: vv explain fall" in done.stdout
    assert not report.exists()
    assert tiny.vv("report").stdout == f"{report}\n"
    (own,) = (path.stem for path in (tiny.root / ".vv" / "manifests").iterdir())
    assert own in report.read_text()


@pytest.mark.parametrize(
    ("fates", "untimed", "kept"),
    [
        (["ran", "refused"], (), True),
        (["ran", "error"], (), False),
        (["error", "ran"], (), False),
        (["ran"], ("a gap",), False),
    ],
)
def test_an_answer_is_remembered_unless_a_job_crashed_or_was_to_be_timed(
    fates: list[str], untimed: tuple[str, ...], kept: bool
) -> None:
    remembered: list[str] = []
    store: Any = SimpleNamespace(
        state=lambda: "state", keep_answer=lambda key, answer: remembered.append(answer.manifest)
    )
    records = [record("a/a", "T1", 1e-3, status=fate) for fate in fates]
    manifest: Any = SimpleNamespace(records=records, untimed=untimed, name="run")
    with mock.patch.object(reuse, "_key", return_value="key"):
        reuse.remember(store, "identity", manifest)
    assert remembered == ["run"] * kept
