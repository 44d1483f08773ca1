"""How two runs compare, and a case over commits."""

import dataclasses
import math
from pathlib import Path

import pytest

from reports import html
from tests.conftest import Tiny
from tests.support.fabricated import (
    NOWHERE,
    STEPS,
    changed,
    entry,
    manifest,
    manifest_of_all,
    record,
    requantified,
)
from vv.base.errors import UsageError
from vv.insight.compare import changes, manifest_of
from vv.insight.history import history
from vv.records.job_record import Record
from vv.store.store import Store

KINDS = ("outcome", "error", "order")


def ladder(factor: float = 1.0, slope: float = 2.0, cpu: float = 1.0) -> list[Record]:
    made = []
    for dt in STEPS:
        error = factor * 1e-4 * (dt / 1e-3) ** slope
        one = record("dem/default", "T1", dt, quantities=[entry("pass", {"max": error})])
        made.append(changed(one, cost=changed(one.cost, relative=[cpu, 1.1 * cpu])))
    return made


def kinds(one: list[Record], other: list[Record]) -> list[str]:
    return [change.kind for change in changes(manifest(*one), manifest(*other))]


def test_nothing_moved_between_equal_runs() -> None:
    assert kinds(ladder(), ladder()) == []


def test_errors_orders_and_costs_move_by_themselves() -> None:
    assert kinds(ladder(), ladder(1.01)) == ["error"] * 3
    assert set(kinds(ladder(), ladder(slope=1.5))) == {"error", "order"}
    assert kinds(ladder(), ladder(cpu=2.0)) == ["cost"] * 3
    assert kinds(ladder(), ladder(cpu=1.2)) == []  # noise


def test_how_far_errors_and_costs_moved_is_told_with_its_factor() -> None:
    for one, other, text, size in (
        (ladder()[:1], ladder(4.0)[:1], "0.0016 -> 0.0064 (x 4)", 4.0),
        (ladder(4.0)[:1], ladder()[:1], "0.0064 -> 0.0016 (x 0.25)", 4.0),
        (ladder(cpu=2.0)[:1], ladder(cpu=8.0)[:1], "2 -> 8 calibration kernels (x 4)", 4.0),
        (ladder(cpu=8.0)[:1], ladder(cpu=2.0)[:1], "8 -> 2 calibration kernels (x 0.25)", 4.0),
    ):
        (found,) = (c for c in changes(manifest(*one), manifest(*other)) if c.kind != "outcome")
        assert found.text == text
        assert found.size == pytest.approx(math.log(size))


@pytest.mark.parametrize(("was", "now", "text"), [(2.0, 1.5, "2.00 -> 1.50"),
                                                   (1.5, 2.0, "1.50 -> 2.00")])  # fmt: skip
def test_an_order_is_told_as_it_was_and_then_as_it_is(was: float, now: float, text: str) -> None:
    found = changes(manifest(*ladder(slope=was)), manifest(*ladder(slope=now)))
    (order,) = (change for change in found if change.kind == "order")
    assert (order.where, order.text) == ("bounce:T1 dem/default y", text)
    assert order.size == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("was", "now", "count"),
    [(1e-4, 0.0, 1), (0.0, 1e-4, 1), (1e-30, 2e-30, 0), (1e-4, 1.0000001e-4, 0)],
)
def test_an_error_that_comes_or_goes_has_moved_and_rounding_has_not(
    was: float, now: float, count: int
) -> None:
    one, other = (record("dem/default", "T1", 1e-3, quantities=[entry("pass", {"max": error})])
                  for error in (was, now))  # fmt: skip
    assert kinds([one], [other]) == ["error"] * count


def test_outcomes_and_what_one_of_them_lacks_are_told_first() -> None:
    other = requantified(ladder()[0], verdict="fail")
    found = changes(manifest(*ladder()), manifest(other))
    assert [(c.kind, c.text) for c in found] == [
        ("outcome", "pass -> fail"),
        ("only in A", "2 settings"),
    ]


def test_changes_of_a_kind_are_told_largest_first() -> None:
    errors = {"T1": (1e-4, 2e-4), "T2": (1e-4, 1e-2), "T3": (1e-4, 1e-5)}
    one, other = (
        [record("a/a", v, 1e-3, quantities=[entry("pass", {"max": own[k]})])
         for v, own in errors.items()]
        for k in (0, 1)
    )  # fmt: skip
    found = changes(manifest(*one), manifest(*other))
    assert [(c.where.split()[0], c.text) for c in found] == [
        ("bounce:T2", "0.0001 -> 0.01 (x 100)"),
        ("bounce:T3", "0.0001 -> 1e-05 (x 0.1)"),
        ("bounce:T1", "0.0001 -> 0.0002 (x 2)"),
    ]


def kept(store: Store, name: str, commit: str, records: list[Record], dirty: bool = False) -> None:
    utc = f"2025-01-{name}T00:00:00+00:00"
    circumstances = dataclasses.replace(NOWHERE, utc=utc, commit=commit, dirty=dirty)
    store.manifests.keep(manifest(*records, provenance=circumstances, name=name))


def test_a_run_is_found_by_its_name_or_the_beginning_of_its_commit(tmp_path: Path) -> None:
    store = Store(tmp_path)
    kept(store, "01", "abcdef", ladder())
    kept(store, "02", "abcdef", ladder(2.0))
    known = {"HEAD": "abcdef"}

    def found(name: str) -> list[Record]:
        return [*manifest_of(store, name, lambda asked: known.get(asked, "")).records]

    assert found("01") == ladder()
    assert found("abcd") == found("HEAD") == ladder(2.0)
    kept(store, "03", "abcdef", ladder(3.0), dirty=True)
    kept(store, "04", "123456", ladder(4.0), dirty=True)
    assert found("HEAD") == ladder(2.0)  # of the commit's own files
    assert found("1234") == ladder(4.0)  # there is no other
    with pytest.raises(
        UsageError, match="no commit 'ffff' in the store; the last runs are 04, 03, 02"
    ):
        found("ffff")


def test_history_has_the_newest_run_of_each_commit_over_shared_rungs(tmp_path: Path) -> None:
    store = Store(tmp_path)
    kept(store, "01", "a" * 40, ladder(2.0, cpu=4.0))
    kept(store, "02", "b" * 40, ladder(9.0))
    kept(store, "03", "b" * 40, ladder(1.0)[1:])  # without its coarsest rung
    modified = [changed(one, modified=True) for one in ladder(50.0)]
    kept(store, "04", "b" * 40, modified)
    kept(store, "05", "b" * 40, ladder(3.0), dirty=True)
    points = history(store, "bounce", pytest.fail)
    assert [point.name for point in points] == ["a" * 9, "b" * 9, "b" * 9 + "+"]
    near = [point.closeness["dem/default"] for point in points]
    assert near == pytest.approx([0.8, 0.4, 1.2])  # at 2e-3, the coarsest they share
    assert points[0].cost["dem/default"] == pytest.approx(4 * 1.1**0.5)
    assert history(store, "other", pytest.fail) == []


def test_the_report_shows_a_case_over_commits(tmp_path: Path) -> None:
    store = Store(tmp_path)
    kept(store, "01", "a" * 40, ladder(2.0))
    kept(store, "02", "b" * 40, ladder())
    whole = manifest_of_all(store)
    page = (html.build(whole, store, tmp_path / "r").parent / "case-bounce.html").read_text()
    assert "Over commits" in page
    assert page.index("aaaaaaaaa</code>") < page.index("bbbbbbbbb</code>")


def test_runs_are_also_called_by_their_age(tmp_path: Path) -> None:
    store = Store(tmp_path)
    for name in ("01", "02", "03"):
        kept(store, name, "abcdef", ladder())
    (tmp_path / "manifests" / "02.json").write_text("damaged")
    names = {word: manifest_of(store, word, lambda _: "").name for word in ("last", "last~1")}
    assert names == {"last": "03", "last~1": "01"}
    with pytest.raises(UsageError, match="not so many runs"):
        manifest_of(store, "last~2", lambda _: "")


def test_of_results_at_other_parameters_only_outcomes_are_compared() -> None:
    one = [changed(own, parameters={"m": 1.0, "g": 9.81}) for own in ladder()]
    other = [
        changed(own, parameters={"m": 2.0, "g": 9.81}, modified=True, changed=["m"])
        for own in ladder(3.0)
    ]
    other[0] = requantified(other[0], verdict="fail")
    beside = [[changed(own, variant="T2") for own in ladder(k, 2.0 * k)] for k in (1.0, 1.2)]
    first, *rest = changes(manifest(*one, *beside[0]), manifest(*other, *beside[1]))
    assert (first.kind, first.where, first.text) == (
        "parameters",
        "bounce:T1",
        "m = 1 -> 2; numbers of different problems are not compared",
    )
    told = {kind: {c.where.split()[0] for c in rest if c.kind == kind} for kind in KINDS}
    assert told == {"outcome": {"bounce:T1"}, "error": {"bounce:T2"}, "order": {"bounce:T2"}}


def test_history_has_the_newest_result_of_each_scheme_at_a_commit(tmp_path: Path) -> None:
    store = Store(tmp_path)
    absent = [record("kratos/default", "T1", 1e-3, status="not-installed", reason="none")]
    failed = [requantified(one, verdict="fail", tolerance=None) for one in ladder()]
    others = [changed(one, scheme="other") for one in ladder(5.0)]
    for number, records in enumerate(([*ladder(2.0), *others], failed, absent)):
        kept(store, f"0{number}", "a" * 40, records)
    for _ in ("computed", "kept"):
        (point,) = history(store, "bounce", pytest.fail)
        assert point.utc.startswith("2025-01-02")
        assert set(point.outcomes) == {"dem/default", "dem/other", "kratos/default"}
        assert set(point.closeness) == {"dem/other"}  # none of the newest, which is not judged
        assert {one.value for one in point.outcomes["dem/default"]} == {"fail"}


def test_diff_and_history_on_the_command_line(tiny: Tiny) -> None:
    tiny.git("init", "-q")
    tiny.git("add", "cases")
    tiny.git("commit", "-qm", "first")
    words = ("run", "fall:up", "--codes", "fake/good,fake/first-order")
    assert tiny.vv("runs").returncode == 64
    tiny.vv(*words)
    tiny.edit("adapters/fake.py", "0.1 * ask", "0.2 * ask")
    done = tiny.vv(*words)
    first = min((tiny.root / ".vv" / "manifests").iterdir()).stem
    latest = max((tiny.root / ".vv" / "manifests").iterdir()).stem
    assert f"; run: {latest}; report: " in done.stdout.splitlines()[-1]
    assert f"HEAD and last are the same run, {latest}; `vv diff`" in tiny.vv("diff", "HEAD").stderr
    said = tiny.vv("diff", first).stdout
    assert tiny.vv("diff").stdout == tiny.vv("diff", "last~1", "last").stdout == said
    assert [line.rpartition(": ")[2] for line in said.splitlines()[:2]] == [
        "vv " + " ".join(words)
    ] * 2
    listed = tiny.vv("runs").stdout.splitlines()
    assert [line.split()[0] for line in listed] == [latest, first]
    assert listed[0].endswith("+  fall  vv run fall:up --codes fake/good,fake/first-order")
    assert tiny.vv("runs", "--rows", "1").stdout.splitlines() == listed[:1]
    assert said.count("error: fall:up fake/first-order dt=") == 3
    assert "0.01 -> 0.02 (x 2)" in said
    assert "fake/good" not in "".join(said.splitlines()[2:])
    said = tiny.vv("history", "fall").stdout
    assert "fake/first-order: 3 fail, error 20 times the tolerance" in said
