"""What a gate writes for others: JUnit XML, Markdown, annotations."""

import dataclasses
import json
from pathlib import Path
from typing import Any

import junitparser
import pytest

from tests.conftest import Tiny
from tests.support.fabricated import entry, manifest_of_all, ran, record
from tests.support.fabricated import manifest as manifest_of
from vv.ask import Knobs
from vv.gate.judgement import judgement
from vv.output.export import document
from vv.output.junit import write_junit
from vv.output.markdown import summary, workflow_commands
from vv.records.finding import Aspect, Bit, Finding
from vv.records.manifest import Manifest
from vv.records.recorded import RecordedResult
from vv.store.store import Store


@pytest.fixture
def manifest(tmp_path: Path) -> Manifest:
    made = manifest_of_all(Store(tmp_path))
    worse = Finding(
        Aspect.REGRESSION, "worse", "error 1e-5, now 2e-5 | band", "bounce", "T1", "dem/default",
        "dt=0.001", "y", Bit.ACCURACY, size=1e4,
    )  # fmt: skip
    better = Finding(Aspect.REGRESSION, "better", "error 1e-5", "bounce", "T2", "dem/default",
                     "dt=0.001", "y", size=3.0)  # fmt: skip
    shown = RecordedResult("bounce", "T1", "fate", "z", Knobs(), "", "7", "2025", 12, None, {})
    return dataclasses.replace(made, findings=(better, worse), recorded=(shown,))


def test_a_document_has_what_the_code_gave_and_beside_it_what_is_exact(tmp_path: Path) -> None:
    store = Store(tmp_path)
    made = ran(store, "dem/default", "T1", 4e-3, "pass")
    (told,) = json.loads(document(manifest_of(made), store))["records"]
    kept = store.series(made.key, made.quantities)
    assert kept is not None
    for part in ("value", "reference"):
        series = told["quantities"][0][part]
        assert (series["t"], series["y"]) == (kept["t"].tolist(), kept[f"y.{part}"].tolist())
    assert kept["y.value"].tolist() != kept["y.reference"].tolist()


def suite_of(manifest: Manifest, path: Path, required: tuple[str, ...] = ()) -> list[Any]:
    write_junit(path, manifest, judgement(manifest, required))
    return [test for suite in junitparser.JUnitXml.fromfile(str(path)) for test in suite]


def kinds(test: Any) -> list[str]:
    return [type(result).__name__ for result in test.result]


def test_junit_tells_failures_errors_and_skips_apart(manifest: Manifest, tmp_path: Path) -> None:
    tests = {t.name: t for t in suite_of(manifest, tmp_path / "out.xml", ("nobody",))}
    assert {t.classname for t in tests.values()} == {"bounce", "vv"}
    assert kinds(tests["other/default y T1 dt=0.001"]) == ["Failure"]
    assert kinds(tests["fate/c T1 dt=0.001"]) == ["Error"]
    assert kinds(tests["fate/d T1 dt=0.001"]) == ["Error"]
    assert kinds(tests["fate/a T1 dt=0.001"]) == ["Skipped"]
    assert tests["fate/b T1 dt=0.001"].result[0].message == "not-installed: not-installed it is"
    assert kinds(tests["dem/published y T1 dt=0.001"]) == []  # a known disagreement
    assert kinds(tests["fate/h y T1 dt=0.001"]) == ["Failure"]  # an unexpected pass
    assert kinds(tests["nobody"]) == ["Error"]


def test_junit_carries_figures_and_changes(manifest: Manifest, tmp_path: Path) -> None:
    tests = {t.name: t for t in suite_of(manifest, tmp_path / "out.xml")}
    assert len(tests) == sum(max(1, len(r.quantities)) for r in manifest.records)
    worse = tests["dem/default y T1 dt=0.001"]
    assert worse.result[0].message == "error 1e-5, now 2e-5 | band"
    told = {p.name: p.value for p in next(iter(worse.iterchildren(junitparser.Properties)))}
    assert {"error max", "tolerance", "verdict", "cpu"} <= told.keys()
    better = tests["dem/default y T2 dt=0.001"]
    assert kinds(better) == []
    properties = next(iter(better.iterchildren(junitparser.Properties)))
    assert "regression: better" in {p.name for p in properties}


def test_junit_has_each_number_of_a_record_under_its_name(tmp_path: Path) -> None:
    errors, figures = {"max": 1e-4, "l2": 2e-4}, {"final": 3.0, "mean": 4.0}
    one = entry("pass", errors, figures=figures, tolerance=5e-3, note="late")
    own = record("a/a", "T1", 1e-3, quantities=[one])
    cost = dataclasses.replace(own.cost, startup=6.0, setup=7.0, solve_cpu=8.0, solve_wall=9.0)
    (test,) = suite_of(manifest_of(dataclasses.replace(own, cost=cost)), tmp_path / "out.xml")
    told = {p.name: p.value for p in next(iter(test.iterchildren(junitparser.Properties)))}
    assert told == {
        "verdict": "pass",
        "tolerance": "0.005",
        "error max": "0.0001",
        "error l2": "0.0002",
        "final": "3.0",
        "mean": "4.0",
        "note": "late",
        "cpu": "8.0",
    }
    assert test.time == 9.0


def test_the_summary_says_what_moved_worst_first_and_stays_short(
    manifest: Manifest,
) -> None:
    text = summary(manifest, judgement(manifest))
    first, *_ = text.splitlines()
    assert first.startswith("### Verification: red (59): accuracy or regression, conservation,")
    assert text.index("**worse**") < text.index("| better |")
    assert "error 1e-5, now 2e-5 \\| band" in text
    assert 'bounce became better: `vv accept bounce --reason "..."`' in text
    assert "fate is not installed: the report shows results of 7 recorded 12 days ago" in text
    many = [record("a/a", f"V{i}", 1e-3, quantities=[entry("fail", {"max": 1e-2 * i})])
            for i in range(1, 200)]  # fmt: skip
    crowd = dataclasses.replace(manifest, records=tuple(many))
    told = summary(crowd, judgement(crowd))
    assert len(told.splitlines()) < 50
    assert told.index("bounce:V199 ") < told.index("bounce:V198 ")
    assert "and 184 more" in told


def test_a_green_summary_says_so(manifest: Manifest) -> None:
    fine = tuple(r for r in manifest.records if r.code == "dem")
    quiet = dataclasses.replace(manifest, records=fine, findings=())
    assert summary(quiet, judgement(quiet)).startswith("### Verification: green\n")


def test_annotations_are_escaped_placed_and_limited() -> None:
    red = [
        Finding(Aspect.RUN, "error", f"100%\nof {i}", "bounce", bit=Bit.CRASH, size=i)
        for i in range(30)
    ]
    note = Finding(Aspect.ACCURACY, "expiring", "soon", "bounce", "T1,T2")
    lines = workflow_commands([note, *red], {"bounce": "cases/bounce.py"})
    assert len(lines) == 11
    assert lines[0] == "::error file=cases/bounce.py,title=run error%3A bounce::100%25%0Aof 29"
    assert lines[-1].startswith("::warning file=cases/bounce.py,title=accuracy expiring%3A bounce")
    assert "T1%2CT2::soon" in lines[-1]
    shown = Finding(Aspect.SPEED, "slower", "slow", "bounce", bit=Bit.SPEED, enforced=False)
    (line,) = workflow_commands([shown], {})
    assert line.startswith("::warning title=")


def test_the_gate_writes_its_files_and_annotates_on_github_only(tiny: Tiny) -> None:
    words = ("gate", "fall:up", "--codes", "fake/coarse", "--junit", "j.xml", "--markdown", "s.md")
    done = tiny.vv(*words, GITHUB_ACTIONS="true")
    assert "::error file=cases/fall.py,title=accuracy fail%3A fall%3Aup fake/coarse" in done.stdout
    assert (tiny.root / "s.md").read_text().startswith("### Verification: red (1)")
    (suite,) = junitparser.JUnitXml.fromfile(str(tiny.root / "j.xml"))
    assert (suite.name, suite.failures) == ("fall", 1)
    assert "::error" not in tiny.vv(*words, GITHUB_ACTIONS="").stdout
