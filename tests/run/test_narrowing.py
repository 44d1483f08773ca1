"""What a narrowed run holds: what failed, what a change can affect, what fits a budget."""

import dataclasses

import pytest

from tests import ROOT
from tests.conftest import Tiny
from tests.support.fabricated import cost, entry, manifest, record
from vv.base.errors import UsageError
from vv.plan.plan import Options, Plan
from vv.plan.planning import make_plan
from vv.plan.project import Project
from vv.records.manifest import Manifest
from vv.run import narrowing, pace


def jobs(tiny: Tiny, *words: str) -> list[str]:
    """The jobs of a dry run, stored or not."""
    done = tiny.vv("run", *words, "--dry-run")
    assert done.returncode == 0, done.stderr
    rows = [line.split("  ") for line in done.stdout.splitlines()[:-1] if "  " in line]
    return [f"{name} {setting}" for name, settings, *_ in rows for setting in settings.split()]


def test_failed_means_what_did_not_do_well_last_time_at_its_own_rungs(tiny: Tiny) -> None:
    assert tiny.vv("run", "--failed").returncode == 64
    codes = ("--codes", "fake/good,fake/coarse,fake/refuses")
    tiny.vv("run", "fall:up", *codes, "--rung", "dt=0.02", "--rung", "dt=0.1")
    assert jobs(tiny, "--failed") == ["fall:up fake/coarse dt=0.02", "fall:up fake/coarse dt=0.1"]
    tiny.edit("adapters/fake.py", "y = 1.01 * y", "pass")
    assert "2 pass" in tiny.vv("run", "--failed").stdout
    done = tiny.vv("run", "--failed")
    assert (done.returncode, done.stdout) == (0, "nothing to run: nothing failed in the last run\n")


def test_what_failed_with_changed_parameters_is_run_again_with_them(tiny: Tiny) -> None:
    words = ("--set", "speed=4", "--set", "radius=0.2")
    tiny.vv("run", "fall:up", "--codes", "fake/good,fake/coarse", *words)
    done = tiny.vv("run", "--failed")
    assert done.returncode == 1
    assert "fall:up with speed=4, radius=0.2" in done.stdout
    assert "3 fail; " in done.stdout
    assert "fall:up with speed=5.5" in tiny.vv("run", "--failed", "--set", "speed=5.5").stdout
    done = tiny.vv("run", "fall:slow", "--failed")
    assert (done.returncode, done.stdout) == (
        0,
        "nothing to run: what failed is not selected; the last run: "
        "vv run --failed --set speed=5.5\n",
    )


def test_since_means_what_a_change_can_affect(tiny: Tiny) -> None:
    (tiny.root / ".gitignore").write_text(".vv\n__pycache__\n")
    tiny.git("init", "-q")
    tiny.git("add", ".")
    tiny.git("commit", "-qm", "first")
    (tiny.root / "README.md").write_text("words")
    done = tiny.vv("run", "--since", "HEAD")
    assert (done.returncode, "no change since HEAD" in done.stdout) == (0, True)
    tiny.edit("adapters/missing.py", "never runs", "still never runs")
    done = tiny.vv("run", "--since", "HEAD", "--dry-run")
    assert done.stdout.startswith("not installed: missing/default\n")
    tiny.edit("reference_solutions/fall.py", "speed * t", "t * speed")
    assert {job.split()[1] for job in jobs(tiny, "--since", "HEAD")} > {"fake/good"}
    done = tiny.vv("run", "--since", "nothing")
    assert (done.returncode, done.stderr.count("\n")) == (64, 1)
    assert "--since: git says" in done.stderr


@pytest.fixture(scope="module")
def plan() -> Plan:
    return make_plan(Project(ROOT), ["single-contact:T?"], Options())


@pytest.mark.parametrize(
    ("file", "codes"),
    [
        ("vv/engines/exact/roots.py", {"exact"}),
        ("adapters/dem.py", {"dem"}),
        ("README.md", set()),
        ("tests/conftest.py", set()),
        ("reference_solutions/checks/contact/single_contact.py", set()),
    ],
)
def test_a_change_affects_the_codes_that_are_made_of_it(
    plan: Plan, file: str, codes: set[str]
) -> None:
    found = narrowing.affected(Project(ROOT), plan, [ROOT / file])
    assert {job.code for job in found.jobs} == codes


@pytest.mark.parametrize("file", ["reference_solutions/contact/single_contact.py",
                                  "vv/scene/scene.py", "requirements.lock",
                                  "vv/records/record.py", "vv/records/checking.py"])  # fmt: skip
def test_a_change_of_what_all_are_made_of_affects_all(plan: Plan, file: str) -> None:
    found = narrowing.affected(Project(ROOT), plan, [ROOT / "README.md", ROOT / file])
    assert len(found.jobs) == len(plan.jobs)


def test_a_deleted_file_affects_what_lies_beside_it(plan: Plan) -> None:
    found = narrowing.affected(Project(ROOT), plan, [ROOT / "adapters" / "yade" / "gone.py"])
    assert {job.code for job in found.jobs} == {"yade"}


def past(plan: Plan, seconds: float) -> Manifest:
    """A manifest in which every job took so long and passed with ease, but exact closely.

    By its size the error of exact is the smaller one: how close it is its tolerance decides.
    """
    close, far = (entry("pass", {"max": e}, tolerance=t) for e, t in ((0.09, 0.1), (0.3, 1.0)))
    spent = dataclasses.replace(cost(), startup=0.0, setup=0.0, solve_wall=seconds, output=0.0)
    return manifest(
        *(
            record(
                f"{job.code}/{job.scheme}",
                job.variant,
                None,
                case=job.case,
                rung=job.ask.knobs,
                quantities=[close if job.code == "exact" else far],
                cost=spent,
            )
            for job in plan.jobs
        )
    )


def test_a_budget_takes_the_closest_first_and_two_rungs_of_all_before_a_third(plan: Plan) -> None:
    runnable = [job for job in plan.jobs if job.settled is None]
    schemes = {pace.key(job)[:3] for job in runnable}
    four = narrowing.within_budget(plan, 4.5, [past(plan, 1.0)])
    assert {job.code for job in four.jobs if job.settled is None} == {"exact"}
    wide = narrowing.within_budget(plan, 2.0 * len(schemes), [past(plan, 1.0)])
    assert {pace.key(job)[:3] for job in wide.jobs if job.settled is None} == schemes
    assert len(narrowing.within_budget(plan, 1e9, []).jobs) == len(plan.jobs)


def test_a_budget_takes_the_coarsest_rungs_which_are_the_cheapest(plan: Plan) -> None:
    """Each took as long as its step is fine."""
    whole = past(plan, 0.0)
    records = tuple(
        dataclasses.replace(one, cost=dataclasses.replace(one.cost, solve_wall=1e-3 / one.rung.dt))
        if one.rung.dt
        else one
        for one in whole.records
    )
    steps = sorted({one.rung.dt for one in records if one.rung.dt})
    dearest = max(one.cost.solve_wall for one in records if one.rung.dt == steps[-2])
    some = narrowing.within_budget(
        plan, 4.0 * dearest, [dataclasses.replace(whole, records=records)]
    )
    left = {job.ask.knobs.dt for job in some.jobs if job.settled is None and job.ask.knobs.dt}
    assert left
    assert min(left) >= steps[-2]


@pytest.mark.parametrize(("text", "value"), [("60s", 60), ("1.5min", 90), ("2 h", 7200), ("7", 7)])
def test_budgets_read_as_typed(text: str, value: float) -> None:
    assert narrowing.budget_seconds(text) == value


@pytest.mark.parametrize("text", ["", "-1s", "0s", "1 day", "s"])
def test_a_budget_that_makes_no_sense_is_refused(text: str) -> None:
    with pytest.raises(UsageError, match="not a duration such as 60s"):
        narrowing.budget_seconds(text)
