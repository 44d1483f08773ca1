"""Claims about the table that ends a run, and about findings that are told as one."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.fabricated import STEPS, changed, cost, entry, manifest_of_all, ran, record
from vv.case import Level
from vv.gate.judgement import breach_in_words, judgement
from vv.output import explain, finding_lines
from vv.output.results_table import ROWS, rows, table, unsupported
from vv.output.wording import duration
from vv.records.finding import Aspect, Bit, Finding
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.store.store import Store


@pytest.fixture
def manifest(tmp_path: Path) -> Manifest:
    return manifest_of_all(Store(tmp_path))


def test_each_scheme_is_shown_at_its_finest_setting_with_order_and_bound(tmp_path: Path) -> None:
    store = Store(tmp_path)
    records = [ran(store, "dem/default", "T1", dt, "pass") for dt in STEPS]
    (row,) = rows(records, [])
    assert (row.place, row.setting) == (("bounce", "T1", "dem/default"), "dt=0.001")
    assert row.order == pytest.approx(2.0, abs=0.02)
    assert (row.claimed, row.allowed, row.verdict) == (2, 1e-3, "pass")


def test_the_order_is_that_in_dt_at_the_stiffest_springs() -> None:
    errors = {1e6: (1e-3, 1e-3, 1e-3), 1e7: (16e-5, 4e-5, 1e-5)}  # soft springs cost 1e-3
    records = [
        record("a/a", "T1", dt, rung={"dt": dt, "kn": kn}, quantities=[entry("pass", {"max": e})])
        for kn, own in errors.items()
        for dt, e in zip(STEPS, own, strict=True)
    ]
    (row,) = rows(records, [])
    assert row.setting == "dt=0.001,kn=1e+07"
    assert row.order == pytest.approx(2.0, abs=1e-9)


def test_a_setting_is_told_with_every_knob_also_with_one_that_is_nil() -> None:
    for dd, said in ((0.97, "dt=0.001,kn=1e+07,dd=0.97"), (0.0, "dt=0.001,kn=1e+07,dd=0")):
        known = [entry("pass", {"max": 1e-5})]
        rung = {"dt": 1e-3, "kn": 1e7, "dd": dd}
        (row,) = rows([record("a/a", "T1", 1e-3, rung=rung, quantities=known)], [])
        assert row.setting == said


def test_a_search_is_told_with_the_largest_stable_step_that_it_found() -> None:
    known = [entry("pass", {"max": 4e-4})]
    rung = {"dt": 0.05, "kn": 1e7}
    sought = record("a/a", "T1", 0.05, rung=rung, study="search", largest_step=0.125507314,
                    quantities=known)  # fmt: skip
    *_, line, legend = table([sought], [])
    assert "stable to dt=0.125507,kn=1e+07" in line
    assert legend.strip().startswith("(the largest step that was stable; ~")
    assert explain._in_words(sought).startswith("stable to dt 0.125507 kn 1e+07: pass")


def test_errors_of_rounding_have_no_order_and_larger_ones_have() -> None:
    def order(least: float) -> float | None:
        runs = [
            record("a/a", "T1", dt, steps=100, quantities=[entry("pass", {"max": error})])
            for dt, error in zip(STEPS, (least * 4, least * 2, least), strict=True)
        ]
        return rows(runs, [])[0].order

    assert order(5e-15) is None  # 100 steps round by 2.2e-14 at most
    assert order(1e-14) == pytest.approx(1.0)  # the coarsest error exceeds that


def test_the_quantity_that_is_closest_to_its_bound_is_shown() -> None:
    near = entry("pass", {"max": 9e-5}, name="near", tolerance=1e-4)
    large = entry("pass", {"max": 5e-3}, name="large", tolerance=1e-1)
    for quantities in ([near, large], [large, near]):
        (row,) = rows([record("a/a", "T1", 1e-3, quantities=quantities)], [])
        assert (row.error, row.allowed) == (9e-5, 1e-4)


def test_the_cost_of_a_whole_process_is_marked_and_explained(tmp_path: Path) -> None:
    steps = ran(Store(tmp_path), "dem/default", "T1", 1e-3, "pass")
    process = changed(steps, code="mine", cost=changed(steps.cost, whole=True))
    lines = list(table([steps, process], []))
    assert ["*" in line for line in lines if "dt=0.001" in line] == [False, True]
    assert "*: of the whole process" in lines[-1]
    assert "*" not in "".join(table([steps], []))


def test_the_verdict_of_a_row_is_that_of_the_gate(manifest: Manifest) -> None:
    found = judgement(manifest)
    verdicts = {row.place[1:]: row.verdict for row in rows(manifest.records, found)}
    red = {(one.variant, one.label) for one in found if one.red and one.case}
    assert {place for place, verdict in verdicts.items() if verdict == "FAIL"} == red
    assert verdicts["T1", "dem/published"] == "known disagreement"


def test_what_was_not_taken_on_is_one_line(manifest: Manifest) -> None:
    said = unsupported(manifest.records)
    assert said == "not supported: fate/a; not installed: fate/b; too long: fate/l"[: len(said)]


def test_many_variants_are_counted_by_scheme(tmp_path: Path) -> None:
    good = [entry("pass", {"max": 1e-5})]
    many = [record("a/a", f"V{i}", 1e-3, quantities=good) for i in range(ROWS + 1)]
    lines = [line.split() for line in table(many, [])]
    assert ["a/a", str(ROWS + 1), "-", "-", "-", "-", str(ROWS + 1), "-", "1.0e-05"] in lines
    assert not any("changed" in line for line in lines)
    (*_, last) = table([changed(one, modified=True, changed=["m"]) for one in many], [])
    assert last == "  (with changed parameters: m=1)"


def test_a_table_of_changed_parameters_is_headed_by_what_was_changed_alone() -> None:
    own = record("a/a", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-5})])
    wide = changed(own, parameters={"m": 2.0, "g": 9.81, "mu": 1 / 3})
    heads = [
        list(table([changed(wide, modified=True, changed=names)], []))[1]
        for names in (["m"], ["mu", "m"])
    ]
    assert heads == ["bounce:T1 with m=2", "bounce:T1 with mu=0.3333333333333333, m=2"]
    assert list(table([own], []))[1] == "bounce:T1"


def test_findings_at_several_settings_are_one_line_with_the_command_that_shows_it() -> None:
    bad = [record("a/a", "T1", dt, quantities=[entry("fail", {"max": 1e-2})]) for dt in STEPS]
    found = [
        Finding(Aspect.ACCURACY, "fail", "error 0.01", "bounce", "T1", "a/a", f"dt={dt:g}", "y",
                Bit.ACCURACY, size=dt)
        for dt in STEPS
    ]  # fmt: skip
    assert [*finding_lines.lines(found, bad, Level.DEFAULT)] == [
        "red: bounce:T1 a/a dt=0.004 y: error 0.01 (and at 2 more settings)",
        "  again: vv run bounce:T1 --codes a/a --rung dt=0.004",
    ]
    values = {"m": 1e9, "g": 9.81}
    other = [changed(one, modified=True, parameters=values, changed=["m"]) for one in bad]
    (_, again) = finding_lines.lines(found, other, Level.PAPER)
    assert again.endswith("--rung dt=0.004 --level paper --set m=1e+09")


def test_a_broken_law_is_told_with_the_number_beside_its_bound() -> None:
    assert breach_in_words(("energy created [J]", 1390.4, 2e-10)) == (
        "energy not conserved: created 1390 J, allowed 2e-10 J"
    )
    assert breach_in_words(("penetration [m]", 1e-3, 1e-4)) == (
        "penetration: 0.001 m, allowed 0.0001 m"
    )
    assert breach_in_words(("clause", 2.0, 1.0)) == "clause: 2, allowed 1"


@pytest.mark.parametrize(
    ("seconds", "told"),
    [
        (0.0, "0 s"), (4.27e-9, "0.0043 us"), (2.44e-6, "2.4 us"), (0.0916, "92 ms"),
        (0.9999, "1 s"), (75.0, "75 s"),
    ],
)  # fmt: skip
def test_a_duration_is_told_in_the_unit_that_suits_it(seconds: float, told: str) -> None:
    assert duration(seconds) == told


def test_a_row_has_the_cpu_time_of_its_steps_and_the_worst_of_what_it_came_to() -> None:
    def run(dt: float, verdict: str, cpu: float) -> Record:
        made = record("a/a", "T1", dt, quantities=[entry(verdict, {"max": 1e-4})])
        return changed(made, cost=changed(made.cost, solve_cpu=cpu, solve_wall=9 * cpu))

    (row,) = rows([run(1e-3, "pass", 0.25), run(2e-3, "xfail", 0.5)], [])
    assert (row.cpu, row.verdict) == (0.25, "known disagreement")
    blown = record("a/a", "T1", 4e-3, study="grid", status="diverged")
    (row,) = rows([run(1e-3, "no-reference", 0.25), blown], [])
    assert row.verdict == "blow-up to show"


def test_the_error_of_many_variants_is_their_median() -> None:
    errors = [1e-5] * 20 + [3e-5] * 21 + [0.8] * 20
    many = [record("a/a", f"V{i}", 1e-3, quantities=[entry("pass", {"max": error})])
            for i, error in enumerate(errors)]  # fmt: skip
    (line,) = [line for line in table(many, []) if line.startswith("  a/a")]
    assert line.split()[-1] == "3.0e-05"


def test_a_table_has_each_number_in_its_column_and_explains_the_marks_that_it_has() -> None:
    def run(label: str, dt: float | None, error: float, seconds: float, **of: bool) -> Record:
        made = record(label, "T1", dt, quantities=[entry("pass", {"max": error}, tolerance=4e-2)])
        return changed(
            made, cost=changed(cost(of.get("timed", False), seconds), whole="whole" in of)
        )

    first = [run("a/second", dt, 100 * dt * dt, 0.25, timed=True) for dt in (2e-3, 1e-3)]
    claims = [changed(one, scheme="first", method="first-order") for one in first]
    exact = run("b/b", None, 2e-9, 0.0)
    slow = run("c/long-name", None, 3e-5, 2.5, whole=True)
    lost = record("d/d", "T1", 1e-3, status="diverged", reason="it blew up")
    red = Finding(Aspect.RUN, "diverged", "it", "bounce", "T1", "d/d", bit=Bit.CRASH)
    _, title, head, *lines, legend = table([*first, *claims, exact, slow, lost], [red])
    assert title == "bounce:T1"
    assert head.split() == ["scheme", "setting", "error", "allowed", "order", "CPU", "verdict"]
    assert [line.split() for line in lines] == [
        ["a/second", "dt=0.001", "1.0e-04", "4.0e-02", "2.00", "of", "2", "250", "ms", "pass"],
        ["a/first", "dt=0.001", "1.0e-04", "4.0e-02", "2.00", "of", "1", "250", "ms", "pass"],
        ["b/b", "-", "2.0e-09", "4.0e-02", "-", "-", "pass"],
        ["c/long-name", "-", "3.0e-05", "4.0e-02", "-", "~2.5", "s*", "pass"],
        ["d/d", "-", "-", "-", "-", "-", "FAIL"],
    ]
    assert legend.strip() == (
        "(finest setting; order in dt: observed of claimed; ~: timed while other jobs ran; "
        "*: of the whole process)"
    )
    *_, bare = table([*first[:1], exact], [])
    assert bare.strip() == "(finest setting)"


def test_a_verdict_is_red_before_it_is_reported_and_reported_before_it_is_passed() -> None:
    one = record("a/a", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-5})])
    place = "bounce", "T1", "a/a", "dt=0.001"
    red, shown, note = (
        Finding(Aspect.SPEED, "slower", "slow", *place, bit=bit, enforced=enforced)
        for bit, enforced in ((Bit.SPEED, True), (Bit.SPEED, False), (Bit(0), True))
    )
    for found, verdict in (
        ([shown, red], "FAIL"), ([shown], "reported only"), ([note], "pass"), ([], "pass")
    ):  # fmt: skip
        assert [row.verdict for row in rows([one], found)] == [verdict]
    other = Finding(Aspect.SPEED, "slower", "slow", "bounce", "T2", "a/a", bit=Bit.SPEED)
    assert [row.verdict for row in rows([one], [other])] == ["pass"]


@pytest.mark.parametrize(
    ("verdicts", "told"),
    [(("pass", "no-reference"), "pass"), (("no-reference",), "shown only"),
     (("xfail", "pass", "blow-up"), "known disagreement"),
     (("blow-up", "pass"), "blow-up to show")],
)  # fmt: skip
def test_the_worst_that_a_scheme_came_to_stands_for_it(
    verdicts: tuple[str, ...], told: str
) -> None:
    blown = record("a/a", "T1", 1e-3, study="grid", status="diverged")
    every = [
        blown
        if one == "blow-up"
        else record("a/a", "T1", dt, quantities=[entry(one, {"max": 0.1})])
        for one, dt in zip(verdicts, STEPS, strict=False)
    ]
    assert [row.verdict for row in rows(every, [])] == [told]


def test_verdicts_of_many_variants_are_counted_and_sixty_rows_are_all_shown() -> None:
    def one(scheme: str, number: int, verdict: str) -> Record:
        judged = entry(verdict, {"max": 1e-5})
        return record(f"a/{scheme}", f"V{number}", 1e-3, quantities=[judged])

    many = [one("x", n, verdict) for n, verdict in enumerate(["pass"] * 3 + ["xfail"] * 2)]
    many += [one("y", n, "no-reference") for n in range(ROWS - 5)]
    assert "bounce:V0" in [*table(many, [])]
    red = Finding(Aspect.RUN, "error", "it", "bounce", "V0", "a/x", bit=Bit.CRASH)
    _, head, first, second, _ = table([*many, one("y", 99, "no-reference")], [red])
    names = "scheme variants FAIL reported only known disagreement shown only pass other error"
    assert " ".join(head.split()) == names
    assert first.split() == ["a/x", "5", "1", "-", "2", "-", "2", "-", "1.0e-05"]
    assert second.split() == [
        "a/y",
        str(ROWS - 4),
        "-",
        "-",
        "-",
        str(ROWS - 4),
        "-",
        "-",
        "1.0e-05",
    ]


def test_what_is_not_judged_is_shown_with_its_largest_error_unless_another_is_judged() -> None:
    loose = {"tolerance": None, "norm": None, "judge": "shown"}
    seen = [entry("no-reference", {"max": e}, name=f"y{e}", **loose) for e in (4e-6, 2e-6)]
    (row,) = rows([record("a/a", "T1", 1e-3, quantities=seen)], [])
    assert (row.error, row.allowed, row.verdict) == (4e-6, None, "shown only")
    judged = entry("pass", {"max": 1e-9})
    (row,) = rows([record("a/a", "T1", 1e-3, quantities=[*seen, judged])], [])
    assert (row.error, row.allowed) == (1e-9, 1e-3)


def test_schemes_are_told_by_code_and_outcome_two_by_name_and_more_by_number() -> None:
    def none(label: str, status: str) -> Record:
        return record(label, "T1", 1e-3, status=status, reason="no")

    refused = [none(label, "refused") for label in ("a/x", "a/y", "b/y", "b/z", "b/v", "c/w")]
    ran_too = record("c/w", "T2", 1e-3, quantities=[entry("pass", {"max": 0.0})])
    said = unsupported([*refused, ran_too, none("d/v", "not-installed"), none("b/u", "too-long")])
    assert said == "not supported: a/x, a/y, b (3 schemes); not installed: d/v; too long: b/u"
