"""How far rounding may move an accepted result: as far as ten times a change in the last digit."""

import json

import numpy as np
import pytest

from tests.conftest import Tiny
from tests.support.acceptances import ACCEPTANCE, ran
from tests.support.fabricated import changed, entry
from vv.gate import acceptance, regression
from vv.gate.bands import EXTERNAL, IN_HOUSE, LARGE, widened
from vv.gate.regression import Strictness
from vv.plan.nudged import NUDGES, Nudge, nudged_plan
from vv.plan.plan import Options
from vv.plan.planning import make_plan
from vv.plan.project import find
from vv.records.accepted import AcceptedQuantity, Baseline
from vv.records.job_record import Record
from vv.scene import Vector

PLACE = 1e-10  # faces stay flat enough for a block


def kept(
    record: Record, *nudged: Record, old: Baseline | None = None, codes: tuple[str, ...] = ()
) -> Baseline:
    return acceptance.accepted("bounce", old, [record], ACCEPTANCE, codes, (), nudged)


def roundings(baseline: Baseline) -> set[float | None]:
    results = baseline.results.values()
    return {one.rounding for result in results for one in result.quantities.values()}


@pytest.mark.parametrize(
    ("moved", "codes", "rounding"),
    [
        (0.9e-10, (), None),  # times ten it is less than the band of 1e-9
        (1.26e-10, (), 1.3e-10),
        (1.26e-10, ("dem",), None),  # the band of external codes is 1e-6
        (4.4e-7, ("dem",), 4.4e-7),
        (0.5, (), 0.5),
    ],
)
def test_what_a_last_digit_moves_is_stored_where_it_may_widen_the_band(
    moved: float, codes: tuple[str, ...], rounding: float | None
) -> None:
    found = kept(ran(1e-4), ran(1e-4 + moved), codes=codes)
    assert roundings(found) == {rounding}


def test_figures_move_by_their_scale_and_what_is_lost_by_any_amount() -> None:
    figures = {"final": 3.0, "mean": 1.0}
    moved = entry("pass", {"max": 1e-4}, scale=2.0, figures={**figures, "mean": 1.0 + 4e-6})
    assert roundings(kept(ran(), changed(ran(), quantities=[moved]))) == {2e-6}
    assert roundings(kept(ran(), changed(ran(), quantities=[]))) == {LARGE}
    assert roundings(kept(ran(), ran(None))) == {LARGE}
    assert roundings(kept(ran())) == {None}


def test_a_band_is_ten_times_what_a_last_digit_moves_and_says_so() -> None:
    then = kept(ran(1e-4), ran(1.3e-4))
    strict = Strictness((), True, False)
    within, beyond = (
        regression.compare("bounce", [ran(1e-4 + drift)], then, strict)
        for drift in (2.9e-4, 3.1e-4)
    )
    assert within == []
    (found,) = beyond
    assert found.text == (
        "error 0.0001, now 0.00041; it may move by 0.0003: a change of the scene in the last "
        "digits moved it by 3e-05, and another platform rounds otherwise in every step"
    )


@pytest.mark.parametrize("band", [IN_HOUSE, EXTERNAL])
def test_a_band_is_never_narrower_than_that_of_the_code(band: object) -> None:
    own = IN_HOUSE if band is IN_HOUSE else EXTERNAL
    assert widened(own, AcceptedQuantity(0.1, 1.0, {}), 0.1) == own
    small = AcceptedQuantity(0.1, 1.0, {}, rounding=own.width / 20)
    assert widened(own, small, 0.1) == own
    assert widened(own, small, 3.0).width == 3 * own.width


def test_a_result_that_stays_keeps_the_larger_of_its_movements_by_rounding() -> None:
    first = kept(ran(1e-4), ran(1.2e-4))
    for again, rounding in (([ran(1.1e-4)], 2e-5), ([ran(1.3e-4)], 3e-5), ([], 2e-5)):
        assert roundings(kept(ran(1e-4 + 1e-12), *again, old=first)) == {rounding}
    replaced = kept(ran(5e-3), ran(5e-3 + 1e-6), old=first)
    assert roundings(replaced) == {1e-6}
    assert {result.by for result in replaced.results.values()} == {"2"}


def stands(*counts: float, worst: float = 1e-4, **changes: object) -> Record:
    """A run with counts of blocks that stand, at angles, and the worst error."""
    some = [entry("pass", {"max": worst}, scale=1.0, figures={"value": worst}, name="worst")]
    for angle, count in zip((5, 60.5, 71), counts, strict=True):
        figures = {"value": count}
        one = entry("pass", {}, scale=2.0, figures=figures, name=f"psi={angle:g}", kind="count")
        some.append(one)
    return changed(ran(), quantities=some, **changes)


def test_where_rounding_decides_a_count_all_settings_of_the_scheme_move_alike() -> None:
    """Numbers in names do not count: another platform may decide another place."""
    rungs = [{"dt": dt, "kn": None} for dt in (2e-3, 1e-3)]
    given = [stands(0, 1, 2, rung=rung) for rung in rungs]
    other = stands(0, 1, 2, scheme="published")
    moved = [stands(0, 0, 2, worst=3e-4, rung=rungs[0]), given[1], other]
    found = acceptance.accepted("bounce", None, [*given, other], ACCEPTANCE, (), (), moved)
    alike = {"psi=5": 0.5, "psi=60.5": 0.5, "psi=71": 0.5, "worst": 2e-4}
    for name, result in found.results.items():
        due = dict.fromkeys(alike) if "published" in name else alike
        assert {key: one.rounding for key, one in result.quantities.items()} == pytest.approx(due)


def test_where_no_count_moves_each_setting_has_its_own_movement() -> None:
    rungs = [{"dt": dt, "kn": None} for dt in (2e-3, 1e-3)]
    given = [stands(0, 1, 2, rung=rung) for rung in rungs]
    moved = [stands(0, 1, 2, worst=3e-4, rung=rungs[0]), given[1]]
    found = acceptance.accepted("bounce", None, given, ACCEPTANCE, (), (), moved)
    worst = [result.quantities["worst"].rounding for result in found.results.values()]
    assert worst == [pytest.approx(2e-4), None]


def test_what_is_lost_in_a_nudged_run_widens_no_other_setting() -> None:
    rungs = [{"dt": dt, "kn": None} for dt in (2e-3, 1e-3)]
    given = [stands(0, 1, 2, rung=rung) for rung in rungs]
    moved = [changed(given[0], quantities=[]), stands(0, 0, 2, rung=rungs[1])]
    found = acceptance.accepted("bounce", None, given, ACCEPTANCE, (), (), moved)
    lost, kept_one = found.results.values()
    assert {one.rounding for one in lost.quantities.values()} == {LARGE}
    assert kept_one.quantities["psi=5"].rounding == 0.5
    assert kept_one.quantities["worst"].rounding is None


def test_of_several_runs_the_one_that_moved_farthest_counts() -> None:
    assert roundings(kept(ran(1e-4), ran(1.1e-4), ran(1.4e-4), ran(1.2e-4))) == {4e-5}


def test_nudged_jobs_differ_in_last_digits_alone() -> None:
    options = Options(codes=("exact", "dem"))
    plan = make_plan(find(), ("responding-block:1d", "bounce:floor"), options)
    nudge = Nudge(0.5, 0.25, PLACE)
    nudged = nudged_plan(plan, nudge)
    assert len(nudged.jobs) == len(plan.jobs) > 2
    for job, other in zip(plan.jobs, nudged.jobs, strict=True):
        assert (other.label, other.parameters) == (job.label, job.parameters)
        was, now = job.ask.scene, other.ask.scene
        np.testing.assert_array_equal(now.gravity, 1.25 * was.gravity)
        for one, heavier in zip(was.blocks, now.blocks, strict=True):
            assert heavier.mass == 1.5 * one.mass
            np.testing.assert_array_equal(heavier.inertia, 1.5 * one.inertia)
            check_moved(one.vertices, heavier.vertices)
            np.testing.assert_array_equal(heavier.velocity, one.velocity)
        for wall, moved in zip(was.walls, now.walls, strict=True):
            np.testing.assert_array_equal(moved.point, wall.point)
        np.testing.assert_array_equal(now.spheres.mass, 1.5 * was.spheres.mass)
        np.testing.assert_array_equal(now.spheres.inertia, 1.5 * was.spheres.inertia)
        np.testing.assert_array_equal(now.spheres.position, was.spheres.position)
        np.testing.assert_array_equal(now.spheres.radius, was.spheres.radius)


def check_moved(was: Vector, now: Vector) -> None:
    """Whether each coordinate that is not zero has moved by a share of its own, at most PLACE."""
    shares = (now / np.where(was == 0.0, 1.0, was) - 1.0)[was != 0.0]
    assert np.abs(shares).max(initial=0.0) <= PLACE
    assert len(set(shares.tolist())) == len(shares)
    np.testing.assert_array_equal(now[was == 0.0], 0.0)


def test_nudges_change_masses_gravity_and_positions_by_few_of_the_smallest_steps() -> None:
    assert len({nudge.seed for nudge in NUDGES}) == len(NUDGES)
    for name in ("mass", "gravity", "place"):
        sizes = [abs(getattr(nudge, name)) / np.finfo(float).eps for nudge in NUDGES]
        assert 1.0 < max(sizes) <= 16.0


def test_accepting_measures_what_a_last_digit_moves(tiny: Tiny) -> None:
    tiny.edit("adapters/fake.py", "(*map(scheme, NAMES), Scheme(", "(scheme('good'),) or (Scheme(")
    grown = "y = FACTOR * (1 + ROUNDING) * (1 + 1e8 * (ball.mass[0] - 1)) * y"
    tiny.edit("adapters/fake.py", "y = FACTOR * (1 + ROUNDING) * y", grown)
    done = tiny.vv("accept", "fall", "--reason", "it was looked at")
    assert done.returncode == 0, done.stderr
    stored = json.loads((tiny.root / "cases" / "baselines" / "fall.json").read_text())
    up = stored["results"]["up fake/good dt=0.1"]
    largest = max(abs(nudge.mass) for nudge in NUDGES)
    assert 0.5 < up["y"]["rounding"] / (1e8 * largest) < 2.0
    assert "rounding" not in up["turns"]
