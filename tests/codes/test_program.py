"""Claims about programs that a TOML file declares: what they are asked, and what they answer."""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from tests.support.adapters.live_asks import COARSE
from tests.support.declared_program import ASK, DECLARED
from vv.ask import Ask, Displacement, Run, Status, Velocity
from vv.codes import external, program
from vv.codes.program import question
from vv.scene import Form, Term

HEADER = "t," + ",".join(question.all_columns(ASK))
ROWS = [f"{t},{','.join(str(n + t) for n in range(6))}" for t in (0.0, 1e-3, 2e-3)]
GOOD = "\n".join([HEADER, *ROWS])
WRITE = "cat > series.csv <<'END'\n{}\nEND\n".format


def answer(folder: Path, script: str, ask: Ask = ASK, repeat: float = 0.0) -> Run:
    """What comes of a question to a program that is a shell script."""
    (folder / "program.sh").write_text(script)
    return asked(folder, "sh program.sh", ask, repeat)


def asked(folder: Path, command: str, ask: Ask = ASK, repeat: float = 0.0, used: str = "") -> Run:
    """What comes of a question to a command; used: the folder of an earlier one to ask it in."""
    name = used or f"scratch-{len(list(folder.glob('scratch-*')))}"
    file, scratch = folder / "mine.toml", folder / name
    file.write_text(DECLARED.format(command=command))
    scratch.mkdir(exist_ok=bool(used))
    (run,) = program.load(file).run([ask], "default", scratch, repeat)
    return run


def test_a_program_reads_its_question_and_writes_its_answer(tmp_path: Path) -> None:
    script = "import json; a = json.load(open('ask.json')); print(','.join(a['columns']))\n"
    script += "for t in a['times']: print(t, *[a['scene']['gravity'][1]] * 6, sep=',')"
    (tmp_path / "program.py").write_text(script)
    run = answer(tmp_path, f"'{sys.executable}' '{tmp_path}/program.py' > series.csv")
    assert (run.status, run.reason, run.steps) == (Status.RAN, "", 2)
    assert run.model is not None
    assert run.model.terms == ASK.scene.terms()
    assert (run.values[Displacement(0)] == ASK.scene.gravity[1]).all()
    assert not list((tmp_path / "scratch-0").iterdir()), "what went well leaves nothing behind"


def test_the_header_decides_which_column_is_which_and_others_are_passed_over(
    tmp_path: Path,
) -> None:
    names = ["temperature", *reversed(HEADER.split(","))]
    rows = [["9", *reversed(row.split(","))] for row in ROWS]
    run = answer(tmp_path, WRITE("\n".join(", ".join(row) for row in (names, *rows))))
    straight = answer(tmp_path, WRITE(GOOD))
    for what in ASK.observables:
        assert np.array_equal(run.values[what], straight.values[what])
    assert np.array_equal(straight.values[Velocity(0)][:, 2], [5.0, 5.001, 5.002])


def test_times_may_be_printed_with_few_digits_and_stand_for_those_asked_for(tmp_path: Path) -> None:
    run = answer(tmp_path, WRITE(GOOD.replace("\n0.001,", "\n0.0010000001,")))
    assert np.array_equal(run.times, ASK.goal.times(1e-3))


def test_energy_over_time_is_a_column_too(tmp_path: Path) -> None:
    ask = Ask(ASK.scene, ASK.goal, (Velocity(0),), COARSE, energies=(Form.KINETIC,))
    table = "t,velocity_0_x,velocity_0_y,velocity_0_z,energy_kinetic\n0,1,2,3,4\n.001,1,2,3,5\n"
    run = answer(tmp_path, WRITE(table + ".002,1,2,3,6"), ask)
    assert run.energies[Form.KINETIC].tolist() == [4.0, 5.0, 6.0]


@pytest.mark.parametrize(
    ("script", "status", "reason"),
    [
        ("echo a; echo why >&2; echo 'no blocks here' >&2; exit 3", "refused", "no blocks here"),
        ("exit 3", "refused", "exit code 3, and no reason on stderr"),
        ("echo out; echo 'dt is odd' >&2; exit 1", "error", "exit code 1; last output: dt is odd"),
        ("kill -SEGV $$", "error", "signal SIGSEGV; no output"),
        ("true", "error", "the program ended well, but wrote no series.csv"),
        ("touch series.csv", "error", "series.csv has no column 't'; its header is "),
        ("head -c 999 /dev/urandom > series.csv", "error", "series.csv has no column 't'"),
        (WRITE("t,ux\n0,1"), "error", "no column 'displacement_0_x'; its header is t,ux"),
        (WRITE(HEADER), "error", "series.csv has a header and nothing else"),
        (WRITE("\n".join([HEADER, *ROWS[:2]])), "error", "has 2 rows; `times` in ask.json has 3"),
        (WRITE(GOOD.replace("\n0.001,", "\n0.1,")), "error", "line 3: t = 0.1 s; `times` in ask"),
        (WRITE(GOOD.replace(",5.0\n", ",much\n")), "error", "line 2, column velocity_0_z: much is"),
        (WRITE(GOOD.replace(",5.0\n", "\n")), "error", "line 2: 6 numbers where the header has 7"),
        ("echo '{' > result.json", "error", "result.json: Expecting property name"),
        ("echo '[1]' > result.json", "error", "result.json holds [1]; it must be an object"),
        ("""echo '{"cpu": 1}' > result.json""", "error", "no entry 'cpu'"),
        ("""echo '{"status": "well"}' > result.json""", "error", "status = 'well'; it must be"),
        ("""echo '{"status": ["ran"]}' > result.json""", "error", "status = ['ran']; it must be"),
        ("""echo '{"terms": [{}]}' > result.json""", "error", "terms[0] = {}; unknown"),
        (WRITE(GOOD.replace("_x,", "_y,")), "error", "has no column 'displacement_0_x'"),
        (WRITE(f"{HEADER},t\n0,1"), "error", "series.csv has 2 columns 't'; its header is"),
        (
            "head -c 99999 /dev/zero | tr '\\0' y >&2; exit 1",
            "error",
            "exit code 1; last output: yy",
        ),
        ("""echo '{"steps": -1}' > result.json""", "error", "steps = -1; it must be a whole"),
        ("""echo '{"terms": ["drg"]}' > result.json""", "error", "terms[0] = 'drg'; unknown; did"),
        ("""echo '{"energies": {}}' > result.json""", "error", "energies = {}; its entries are"),
        ("""echo '{"solve_cpu": NaN}' > result.json""", "error", "solve_cpu = nan; it must be"),
        ("""echo '{"status": "diverged", "reason": "up"}' > result.json""", "diverged", "up"),
        ("""echo '{"status": "refused"}' > result.json""", "refused", "gives no reason"),
    ],
)
def test_a_bad_answer_is_told_in_words(
    tmp_path: Path, script: str, status: str, reason: str
) -> None:
    run = answer(tmp_path, script)
    assert run.status.value == status
    assert reason in run.reason
    assert len(run.reason) < 350


def test_a_program_that_writes_without_end_is_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(external, "LARGEST_LOG", 1_000_000)
    endless = "timeout 10 yes"
    for script in (endless, f"{endless} > series.csv", f"mkdir deep; {endless} > deep/down"):
        run = answer(tmp_path, script)
        assert run.status is Status.ERROR
        assert "it wrote more than 1 MB of output" in run.reason
    assert all(f.stat().st_size <= 1_000_000 for f in tmp_path.rglob("*") if f.is_file())


def test_a_file_that_no_folder_shows_has_an_end_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(external, "LARGEST_LOG", 1_000_000)
    writes = "exec 3> gone; rm gone; ulimit -c 0"
    for script in (f"{writes}; exec timeout 10 yes >&3", f"{writes}; timeout 10 yes >&3; exit $?"):
        run = answer(tmp_path, script)
        assert run.status is Status.ERROR
        assert "stopped because a file that it wrote exceeded 2 MB" in run.reason


def test_links_and_files_that_come_and_go_do_no_harm(tmp_path: Path) -> None:
    mess = "ln -s nowhere link; for i in $(seq 40); do touch $i; mv $i a; rm a; done; "
    assert answer(tmp_path, mess + WRITE(GOOD)).status is Status.RAN


@pytest.mark.parametrize("kind", ["rm -f {}", "rm -f {}; mkfifo {}", "rm -f {}; mkdir {}",
                                  "ln -sf /dev/zero {}"])  # fmt: skip
@pytest.mark.parametrize("code", [1, 3])
def test_a_program_that_spoils_its_logs_is_waited_for_no_longer(
    tmp_path: Path, kind: str, code: int
) -> None:
    spoils = "; ".join(kind.replace("{}", log) for log in ("stderr.log", "program-0.log"))
    run = answer(tmp_path, f"{spoils}; exit {code}")
    assert run.status is (Status.REFUSED if code == 3 else Status.ERROR)
    assert run.reason.startswith(f"exit code {code}")
    assert run.reason.endswith("no output" if code == 1 else "no reason on stderr")


@pytest.mark.parametrize("file", ["series.csv", "result.json"])
def test_an_answer_beyond_all_measure_is_not_read(tmp_path: Path, file: str) -> None:
    os.truncate(os.open(tmp_path / "giant", os.O_CREAT | os.O_WRONLY), 1 << 40)
    run = answer(tmp_path, f"{WRITE(GOOD)}\nln -sf {tmp_path}/giant {file}")
    assert run.status is Status.ERROR
    assert run.reason == f"{file}: it has {1 << 40} bytes, more than are read"


def test_what_a_spreadsheet_writes_is_read(tmp_path: Path) -> None:
    table = "\ufeff" + GOOD.replace("\n", "\r\n")
    assert answer(tmp_path, WRITE(table)).status is Status.RAN


def test_a_program_that_cannot_be_started_is_named(tmp_path: Path) -> None:
    (tmp_path / "program").write_text("?")
    run = asked(tmp_path, "./program")
    assert run.status is Status.ERROR
    assert run.reason == f"{tmp_path}/program cannot be started: Permission denied"


def test_what_is_missing_or_not_executable_is_not_installed_and_says_how_to_build_it(
    tmp_path: Path,
) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('install = "make mine"\n' + DECLARED.format(command="./mine"))
    found = program.load(file).found()
    assert not found.installed
    assert f"no {tmp_path}/mine, which {file} names as its command; to build it: make mine" in (
        found.how_to_install
    )
    (tmp_path / "mine").write_text("")
    assert "mine is not executable" in program.load(file).found().how_to_install


def test_a_program_that_states_the_cost_of_its_steps_is_taken_at_its_word(tmp_path: Path) -> None:
    stated = WRITE(GOOD) + """echo '{"solve_cpu": 1e-3, "steps": 7, "note": "hm"}' > result.json"""
    run = answer(tmp_path, stated)
    assert (run.cost.solve_cpu, run.cost.whole, run.steps) == (1e-3, False, 7)
    assert run.model is not None
    assert run.model.note == "hm"


def test_without_it_the_cost_is_that_of_the_whole_process_and_marked_so(tmp_path: Path) -> None:
    begun = time.perf_counter()
    run = answer(tmp_path, "sleep 0.1\n" + WRITE(GOOD))
    assert run.cost.whole
    assert 0 < run.cost.solve_cpu < 1
    assert 0.1 <= run.cost.solve_wall <= time.perf_counter() - begun
    assert run.model is not None
    assert run.model.note == "its cost is that of the whole process, start and output included"


def test_of_a_reason_without_end_the_beginning_is_told(tmp_path: Path) -> None:
    (tmp_path / "result.json").write_text(json.dumps({"status": "refused", "reason": "x" * 10**6}))
    run = answer(tmp_path, f"cp {tmp_path}/result.json .")
    assert (run.status, run.reason) == (Status.REFUSED, "x" * 1000 + "...")


def test_a_cost_that_cannot_be_is_refused(tmp_path: Path) -> None:
    run = answer(tmp_path, WRITE(GOOD) + """echo '{"solve_cpu": 30}' > result.json""")
    assert run.status is Status.ERROR
    assert "result.json: solve_cpu = 30 s; the whole process took" in run.reason


def test_a_timed_program_runs_again_and_again_and_the_least_counts(tmp_path: Path) -> None:
    run = answer(tmp_path, WRITE(GOOD), repeat=0.02)
    assert run.cost.repeats > 1
    assert run.cost.spread >= 0


def test_terms_that_a_program_says_it_left_out_are_not_taken_for_modelled(tmp_path: Path) -> None:
    run = answer(tmp_path, WRITE(GOOD) + """echo '{"terms": ["sphere"]}' > result.json""")
    assert run.model is not None
    assert run.model.terms == {Term.SPHERE}


def test_a_balance_of_energy_becomes_a_ledger(tmp_path: Path) -> None:
    forms = '{"forms": {"kinetic": 1, "drag": 0.5, "impact": 2}, "unaccounted": 0, "peak": 3}'
    run = answer(tmp_path, WRITE(GOOD) + f"""echo '{{"energies": {forms}}}' > result.json""")
    assert run.ledger is not None
    assert run.ledger.terms == {"kinetic": 1, "drag dissipation": 0.5, "impact dissipation": 2}
    assert run.ledger.bound is None


def test_what_a_failed_run_left_in_a_folder_is_not_the_answer_to_a_later_question(
    tmp_path: Path,
) -> None:
    failed = answer(tmp_path, WRITE(GOOD) + "exit 5")
    assert "exit code 5" in failed.reason
    assert list((tmp_path / "scratch-0").glob("*/series.csv")), "what failed is kept"
    run = asked(tmp_path, "true", used="scratch-0")
    assert (run.status, run.reason) == (
        Status.ERROR, "the program ended well, but wrote no series.csv",
    )  # fmt: skip
