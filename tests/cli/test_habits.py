"""Claims about what people type who know other test runners: -k, -x, --version, filters."""

from __future__ import annotations

import pytest

from tests.conftest import Tiny
from vv import __version__
from vv.cli.options import MOST, completed_cases, completed_codes
from vv.records.finding import Bit


def test_k_selects_by_words_in_the_names_of_jobs(tiny: Tiny) -> None:
    done = tiny.vv("run", "-k", "up and (good or coarse)", "--level", "quick")
    assert done.returncode == Bit.ACCURACY
    schemes = [line.split()[0] for line in done.stdout.splitlines() if line.startswith("  fake/")]
    assert schemes == ["fake/good", "fake/coarse"]
    done = tiny.vv("run", "-k", "sideways")
    assert (done.returncode, "-k 'sideways' matches none of" in done.stderr) == (Bit.USAGE, True)


def test_x_stops_at_the_first_result_out_of_bounds(tiny: Tiny) -> None:
    words = ("run", "fall:up", "--codes", "fake/good,fake/coarse", "--jobs", "1")
    done = tiny.vv(*words, "-x")
    assert done.returncode == Bit.ACCURACY
    assert "1 fail" in done.stdout
    assert "3 fail" in tiny.vv(*words).stdout


def test_x_runs_everything_where_nothing_fails(tiny: Tiny) -> None:
    done = tiny.vv("run", "fall:up", "--codes", "fake/good", "-x")
    assert (done.returncode, "3 pass" in done.stdout) == (0, True)


def test_the_version_is_told(tiny: Tiny) -> None:
    assert tiny.vv("--version").stdout == f"vv {__version__}\n"


def test_list_filters_by_family_code_and_words(tiny: Tiny) -> None:
    family = tiny.root / "cases" / "drops"
    family.mkdir()
    (family / "__init__.py").write_text('"""A family."""\n')
    text = (tiny.root / "cases" / "fall.py").read_text()
    (family / "drop.py").write_text(text.replace('name="fall"', 'name="drop"'))
    out = tiny.vv("list").stdout
    assert "family drops\ndrop  Free fall" in out
    assert "fall:slow" in out
    assert "fall:" not in tiny.vv("list", "--family", "drops").stdout
    assert "no family 'drip'; did you mean drops?" in tiny.vv("list", "--family", "drip").stderr
    slow = tiny.vv("list", "-k", "slow and not drop").stdout
    assert ("fall:slow" in slow, "fall:up" in slow, "drop" in slow) == (True, False, False)
    assert "fall:up" in tiny.vv("list", "--code", "fake/good").stdout
    assert tiny.vv("list", "--code", "fake/weightless").stdout == ""


def test_list_and_codes_take_names(tiny: Tiny) -> None:
    out = tiny.vv("list", "fall:sl*").stdout
    assert ("fall:slow" in out, "fall:up" in out) == (True, False)
    assert tiny.vv("list", "fall", "-k", "slowly").stdout.count("  fall:") == 1
    assert "no case or family 'fell'; did you mean fall?" in tiny.vv("list", "fell").stderr
    schemes = tiny.vv("codes", "fake").stdout.splitlines()
    assert all("fake" in line for line in schemes if not line.startswith("  to install"))
    assert "no code 'fakd'" in tiny.vv("codes", "fakd").stderr


def test_explain_can_be_asked_about_one_code(tiny: Tiny) -> None:
    out = tiny.vv("explain", "fall:up", "--codes", "fake/good").stdout
    assert ("fake/good" in out, "fake/coarse" in out) == (True, False)


def test_what_explains_a_red_run_shows_it_at_its_own_parameters(tiny: Tiny) -> None:
    words = ("--codes", "fake/good,fake/coarse", "--set", "speed=4")
    done = tiny.vv("run", "fall:up", *words)
    explain = done.stdout.splitlines()[-1].partition("details: ")[2]
    assert explain == "vv explain fall:up --codes fake/coarse --set speed=4"
    assert "last result: none yet" in tiny.vv("explain", "fall:up", "--codes", "fake").stdout
    told = tiny.vv(*explain.split()[1:]).stdout
    assert "speed = 4 m/s  initial velocity  (changed)" in told
    assert told.count(": fail: y: error 0.0") == 3


@pytest.mark.parametrize("option", ["--set", "--rung", "name"])
def test_more_words_than_anybody_types_are_refused_at_once(tiny: Tiny, option: str) -> None:
    words = {"--set": "speed=1", "--rung": "dt=0.1", "name": "fall"}
    more = [words[option]] if option == "name" else [option, words[option]]
    done = tiny.vv("run", "fall", *(MOST + 1) * more)
    assert (done.returncode, done.stderr.count("\n")) == (Bit.USAGE, 1)
    assert f"at most {MOST} are accepted" in done.stderr


def test_a_gallery_is_not_written_over_the_cases_of_a_project(tiny: Tiny) -> None:
    own = sorted(path.name for path in (tiny.root / "cases").iterdir())
    done = tiny.vv("docs", "--output", ".")
    assert done.returncode == Bit.USAGE
    assert "is not a gallery page" in done.stderr
    assert sorted(path.name for path in (tiny.root / "cases").iterdir()) == own
    assert "it applies to --picture only" in tiny.vv("docs", "--codes", "fake").stderr


def test_a_commit_without_results_is_told_how_to_make_them(tiny: Tiny) -> None:
    assert "git switch --detach HEAD~1 && vv run CASE" in tiny.vv("diff", "HEAD~1").stderr
    tiny.git("init", "-q")
    tiny.git("add", ".")
    tiny.git("commit", "-qm", "first")
    tiny.vv("run", "fall:up", "--codes", "fake/good")
    tiny.git("commit", "--allow-empty", "-qm", "second")
    done = tiny.vv("diff", "HEAD")
    assert "nothing was run at HEAD; to get results for a commit: git switch" in done.stderr


def test_a_shell_is_offered_families_cases_variants_and_codes() -> None:
    assert {"contact", "single-contact"} <= {*completed_cases("")}
    assert completed_cases("single-c") == ["single-contact"]
    assert "single-contact:T4-rotated" in completed_cases("single-contact:T4")
    assert completed_codes("dem,ya") == ["dem,yade"]
