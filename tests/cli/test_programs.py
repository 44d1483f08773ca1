"""Claims about `--code FILE.toml`: a stranger's program runs beside all codes, good or bad."""

from __future__ import annotations

import json
import shlex
import shutil
from pathlib import Path

import pytest

from tests.conftest import Tiny
from vv.base import processes

DECLARED = """
command = "sh {script}"
[scheme.default]
method = "first-order"
terms = ["sphere", "gravity"]
"""
EULER = """
awk '
function take(name,    text) {
    text = substr(ask, index(ask, "\\"" name "\\": ") + length(name) + 4)
    match(text, /^[][0-9eE+., -]*/)
    text = substr(text, 1, RLENGTH)
    gsub(/[][,]/, " ", text)
    return split(text, found, " ")
}
{ ask = ask $0 "\\n" }
END {
    take("gravity"); g = found[2]; take("velocity"); v = found[2]; take("dt"); late = found[1] / 1e3
    print "displacement_0_x,displacement_0_z,displacement_0_y,t"
    for (n = take("times"); i++ < n;)
        printf "0,0,%.17g,%.17g\\n", v * found[i] + g * found[i] * (found[i] - late) / 2, found[i]
}' ask.json > series.csv
"""
BAD = {
    "hangs": ("setsid sleep 71 & sleep 60", "timeout: no answer in time"),
    "crashes": ("setsid sleep 72 & kill -ABRT $$", "error: signal SIGABRT"),
    "silent": ("true", "error: the program ended well, but wrote no series.csv"),
    "garbage": ("head -c 999 /dev/urandom > series.csv", "error: series.csv has no column 't'"),
    "columns": ("echo 't,y' > series.csv", "error: series.csv has no column 'displacement_0_x'"),
    "nan": (
        EULER + "sed -i s/^0,/nan,/ series.csv",
        "diverged: displacement of body 0 is not finite",
    ),
    "refuses": ("echo 'not today' >&2; exit 3", "refused: not today"),
}


def declare(folder: Path, name: str, script: str) -> Path:
    """A program that is a shell script, and its TOML file."""
    (folder / f"{name}.sh").write_text(script)
    file = folder / f"{name}.toml"
    file.write_text(DECLARED.format(script=f"{name}.sh"))
    return file


@pytest.fixture
def mine(tiny: Tiny) -> Path:
    return declare(tiny.root, "mine", EULER)


def test_a_program_is_named_by_its_file_and_told_its_order(tiny: Tiny, mine: Path) -> None:
    done = tiny.vv("run", "fall:up", "--code", "./mine.toml")
    assert done.returncode == 0, done.stderr
    (row,) = (line for line in done.stdout.splitlines() if line.startswith("  mine/default "))
    assert "1.00 of 1 " in row
    assert done.stdout.splitlines()[-1].startswith("settings: 3 pass; run: ")


def test_a_cost_that_holds_start_and_output_is_marked_wherever_it_is_shown(
    tiny: Tiny, mine: Path
) -> None:
    words = ("speed", "fall:up", "--codes", "mine.toml,fake/good", "--json", "cost.json")
    said = tiny.vv(*words).stdout
    assert said.count("its costs are those of whole processes, start and output included") == 1
    assert "mine/default: its costs are" in said
    tiny.vv("run", "fall:up", "--codes", "mine.toml,fake/good", "--json", "all.json")
    records = json.loads((tiny.root / "all.json").read_text())["records"]
    assert {one["code"] for one in records if one["cost"].get("whole")} == {"mine"}


def test_it_runs_beside_the_others_and_in_a_scheme_of_its_own(tiny: Tiny, mine: Path) -> None:
    done = tiny.vv("run", "fall:up", "--codes", f"{mine}/default,fake/good", "--level", "quick")
    assert done.returncode == 0, done.stderr
    assert "2 pass; run: " in done.stdout


def test_its_result_stands_until_one_of_its_files_changes(tiny: Tiny, mine: Path) -> None:
    words = ("run", "fall:up", "--code", "mine.toml", "--level", "quick")
    tiny.vv(*words)
    assert "0 would run, 1 are stored" in tiny.vv(*words, "--dry-run").stdout
    for name in ("mine.toml", "mine.sh"):
        then = (tiny.root / name).read_text()
        (tiny.root / name).write_text(f"{then}\n")
        assert "1 would run, 0 are stored" in tiny.vv(*words, "--dry-run").stdout
        (tiny.root / name).write_text(then)


def test_bad_programs_are_told_what_is_wrong_and_lose_nothing_else(tiny: Tiny, mine: Path) -> None:
    files = [declare(tiny.root, name, script).name for name, (script, _) in BAD.items()]
    codes = ",".join((*files, mine.name, "fake/good"))
    limits = ("--level", "quick", "--timeout", "1", "--json", "all.json")
    done = tiny.vv("run", "fall:up", *limits, "--codes", codes)
    assert done.returncode == 8 + 16 + 32  # crashes; one hangs; one that is meant to run refuses
    assert "2 pass, " in done.stdout
    records = json.loads((tiny.root / "all.json").read_text())["records"]
    said = {one["code"]: f"{one['status']}: {one['reason']}" for one in records}
    assert {name: said[name][: len(reason)] for name, (_, reason) in BAD.items()} == {
        name: reason for name, (_, reason) in BAD.items()
    }


def test_what_runs_a_red_line_again_names_the_file_of_its_program(tiny: Tiny) -> None:
    declare(tiny.root, "odd", "echo odd >&2; exit 1")
    said = tiny.vv("run", "fall:up", "--level", "quick", "--code", "odd.toml").stdout
    (again,) = (line for line in said.splitlines() if line.startswith("  again: vv "))
    words = shlex.split(again)[2:]
    assert words[:4] == ["run", "fall:up", "--codes", f"{tiny.root}/odd.toml/default"]
    assert "error: exit code 1; last output: odd" in tiny.vv(*words).stdout
    assert "/odd.toml/default" in tiny.vv("gate", "fall:up", "--code", "odd.toml").stdout


def test_nothing_that_a_program_started_outlives_its_run(tiny: Tiny) -> None:
    left = "setsid sleep 73 & (setsid sleep 74 &)"
    for name, script in (("good", EULER + left), ("bad", left), ("slow", f"{left}; sleep 75")):
        declare(tiny.root, name, script)
    limits = ("--level", "quick", "--timeout", "1")
    tiny.vv("run", "fall:up", *limits, "--codes", "good.toml,bad.toml,slow.toml")
    assert not [pid for pid in processes._pids() if processes._is_in(pid, tiny.root)]


def test_a_program_that_is_not_there_is_missed(tiny: Tiny) -> None:
    (tiny.root / "mine.toml").write_text(DECLARED.format(script="x").replace("sh x", "./dem"))
    done = tiny.vv("run", "fall:up", "--code", "mine.toml", "--level", "quick")
    assert done.returncode == 32
    assert f"not installed: no {tiny.root}/dem, which {tiny.root}/mine.toml names" in done.stderr
    assert "mine: required, but none of its jobs ran" in done.stdout + done.stderr


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("run fall --code nowhere.toml", "there is no file nowhere.toml"),
        ("run fall --code Mine.toml", "a name must be lower-case letters, digits and _"),
        ("run fall --code fake.toml", "a code's name must be unique"),
        ("run fall --code mine.toml/fast", "no code 'mine/fast'"),
        ("export fall:up", "name a --code, or use --format json"),
    ],
)
def test_what_names_no_program_is_refused_in_a_line(
    tiny: Tiny, mine: Path, words: str, message: str
) -> None:
    for name in ("Mine", "fake"):
        (tiny.root / f"{name}.toml").write_text(mine.read_text())
    done = tiny.vv(*words.split())
    assert done.returncode == 64
    assert message in done.stderr
    assert done.stderr.count("\n") == 1


def test_what_a_program_is_asked_can_be_written(tiny: Tiny, mine: Path) -> None:
    asked = json.loads(tiny.vv("export", "fall:up", "--code", "mine.toml").stdout)
    free = json.loads(tiny.vv("export", "fall:up", "--format", "json").stdout)
    assert asked == free
    assert free["knobs"] == {"dt": 0.025}
    coarse = tiny.vv("export", "fall:up", "--format", "json", "--rung", "dt=0.1", "--set", "g=2")
    assert json.loads(coarse.stdout)["scene"]["gravity"] == [0.0, -2.0, 0.0]


def test_a_toml_among_the_adapters_is_a_code_of_the_project(tiny: Tiny, mine: Path) -> None:
    for file in (mine, mine.with_suffix(".sh")):
        file.rename(tiny.root / "adapters" / file.name)
    assert "mine/default: the program mine.toml [first order in dt; knobs: dt]" in (
        tiny.vv("codes").stdout
    )
    done = tiny.vv("gate", "fall:up", "--codes", "mine")
    assert done.returncode == 0, done.stderr


def test_a_check_says_what_is_right_and_what_is_wrong(tiny: Tiny, mine: Path) -> None:
    done = tiny.vv("check", "mine.toml")  # it knows of motion along y alone
    assert done.returncode == 1, done.stderr
    flight, lock = done.stdout.splitlines()[-2:]
    assert flight == "  free flight: wrong by 1 of the largest value"
    assert lock.startswith("  lock: right, error ")
    (tiny.root / "mine.sh").write_text("echo 'dt is odd' >&2; exit 1")
    done = tiny.vv("check", "mine.toml")
    assert done.returncode == 8
    assert "  free flight: error: exit code 1; last output: dt is odd" in done.stdout
    assert done.stdout.splitlines()[-1] == "  lock: failed in the same way"
    folder = Path(done.stderr.removeprefix("questions and answers of what failed: ").strip())
    assert len(list(folder.rglob("ask.json"))) == 6
    shutil.rmtree(folder)


def test_a_check_is_incomplete_where_a_declared_term_is_refused(tiny: Tiny, mine: Path) -> None:
    (tiny.root / "mine.sh").write_text("echo 'it has no locks' >&2; exit 3")
    done = tiny.vv("check", "mine.toml")
    assert done.returncode == 32
    *_, said, advice = done.stdout.splitlines()
    assert said == "  lock: refused: it has no locks"
    assert advice.startswith("    remove from its terms what it refuses; this scene has ")


def test_a_program_that_hangs_is_asked_once(tiny: Tiny, mine: Path) -> None:
    (tiny.root / "mine.sh").write_text("sleep 60")
    done = tiny.vv("check", "mine.toml", "--timeout", "0.5")
    assert done.returncode == 8
    assert done.stdout.splitlines()[-1] == "  1 not tested, since it gave no answer in 0.5 s"
    folder = Path(done.stderr.removeprefix("questions and answers of what failed: ").strip())
    assert len(list(folder.rglob("ask.json"))) == 1
    shutil.rmtree(folder)


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("slurm", "--executor 'slurm': it must be local or dask://HOST:PORT"),
        ("dask://nowhere", "it must be local or dask://HOST:PORT"),
    ],
)
def test_an_executor_that_there_is_not_is_refused(
    tiny: Tiny, mine: Path, address: str, message: str
) -> None:
    done = tiny.vv("run", "fall:up", "--code", "mine.toml", "--executor", address)
    assert done.returncode == 64
    assert message in done.stderr
