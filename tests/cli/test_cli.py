"""The command line: names, units, settings and bad input."""

import re

import pytest
from typer.testing import CliRunner

from tests.conftest import Tiny
from vv import cli
from vv.cli import GROUPS, app
from vv.records.finding import Bit

BAD = {
    "run": "give a case or --all",
    "run fal": "no case or family 'fal'; did you mean fall?",
    "run up": "no case or family 'up'; it is a variant: say fall:up",
    "list -k nosuch": "-k 'nosuch' matches no variant; `vv list` shows all",
    "run fall:upp": "fall has no variant 'upp'; did you mean up?",
    "run fall --codes ,": "--codes ',' names no code",
    "run fall --codes fke": "no code 'fke'; did you mean fake",
    "run fall --codes fake/god": "did you mean fake/good",
    "run fall --require nobody": "no code 'nobody'",
    "run fall --all": "not both",
    "run fall --budget soon": "not a duration such as 60s, 5min or 1h",
    "gate --against nowhere": "there is no such folder",
    "gate fall --timeout -1": "it must be positive",
    "accept fall": "--reason is missing",
    "diff x": "there are no runs to compare",
    "history nothing": "no case or family 'nothing'",
    "run fall --set radius=-0.1": "Spheres.radius[0] = -0.1 m; radii must be positive",
    "run fall --set speed=nan": "speed = nan m/s; it must be finite",
    "run fall --set speed=inf": "speed = inf m/s; it must be finite",
    "run fall --set sped=1": "fall has no parameter 'sped'; did you mean speed?",
    "run fall --set speed=5kg": "speed = 5 'kg': not a unit that converts to m/s",
    "run fall --set speed=fast": "speed = 'fast': not a number",
    "run fall --set speed": "expected NAME=VALUE[UNIT]",
    "run fall --rung dt=-1": "dt = -1.0 s; a knob must be positive",
    "run fall --rung dx=1": "expected dt=SECONDS",
    "run fall --rung dt=1kg": "dt = 1 'kg': not a unit that converts to s",
    "run fall --rung dt=1,dt=2": "dt is given twice",
    "run fall --rung dt=0.1,kn=2": "fall:up has a contact stiffness of its own; leave out kn",
    "run fall --level huge": "'huge' is not one of",
    "run fall --timeout 0": "--timeout = 0.0 s; it must be positive",
    "rnu": "No such command 'rnu'",
    "explain nothing": "no case or family 'nothing'",
    "export fall --code fake/good": "'fall' names 2 variants; export takes one",
    "papers": "no paper; a file of cases/papers/ describes each",
    "papers nobody": "no paper 'nobody'; a file of cases/papers/ describes each",
    "report": "there is no run yet",
}


@pytest.mark.parametrize("words", BAD)
def test_bad_input_gets_one_clear_line_and_exit_status_64(tiny: Tiny, words: str) -> None:
    done = tiny.vv(*words.split())
    assert done.returncode == 64
    assert done.stderr.startswith("vv: ")
    assert done.stderr.count("\n") == 1
    assert BAD[words] in done.stderr


def test_an_empty_selection_at_the_level_is_refused(tiny: Tiny) -> None:
    done = tiny.vv("run", "fall:slow", "--level", "quick")
    said = "vv: the selection is empty at level quick; --level default has variants of it\n"
    assert (done.returncode, done.stderr) == (64, said)


def test_a_unit_is_converted(tiny: Tiny) -> None:
    done = tiny.vv("run", "fall:up", "--codes", "fake/good", "--set", "speed=18km/h")
    assert done.returncode == 0
    assert "3 pass" in done.stdout


def test_the_last_line_counts_outcomes_and_says_where_to_look(tiny: Tiny) -> None:
    codes = "fake/good,fake/coarse,fake/refuses"
    done = tiny.vv("run", "fall:up", "--codes", codes, "--level", "quick")
    report = tiny.root / ".vv" / "report" / "index.html"
    counts, run, *rest = done.stdout.splitlines()[-1].split("; ")
    assert counts == "settings: 1 pass, 1 fail, 1 not supported"
    assert (tiny.root / ".vv" / "manifests" / f"{run.removeprefix('run: ')}.json").is_file()
    assert rest == [f"report: {report}", "details: vv explain fall:up --codes fake/coarse"]
    assert report.is_file()
    assert done.returncode == Bit.ACCURACY  # as the gate says


def test_a_dry_run_runs_nothing(tiny: Tiny) -> None:
    done = tiny.vv("run", "fall:up", "--codes", "fake/raises", "--dry-run")
    assert done.returncode == 0
    assert "3 jobs, 3 would run" in done.stdout
    assert not (tiny.root / ".vv").exists()


def test_a_variant_s_name_and_its_description_are_apart_in_a_column(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", '"up", "thrown up"', '"' + 20 * "up-" + '", "thrown up"')
    rows = tiny.vv("list").stdout.splitlines()[1:]
    columns = [re.split("  +", row.strip()) for row in rows]
    assert [said for _, said in columns] == ["thrown up", "thrown up slowly"]
    assert len({row.index(said) for row, (_, said) in zip(rows, columns, strict=True)}) == 1


def test_codes_says_what_is_missing_and_how_to_get_it(tiny: Tiny) -> None:
    out = tiny.vv("codes").stdout
    assert re.search(r"missing  not installed\n  to install: apt-get install missing", out)
    assert "fake/good: a scheme that is good" in out


def test_explain_shows_formula_parameters_tolerances_and_the_last_result(tiny: Tiny) -> None:
    tiny.vv("run", "fall:up", "--codes", "fake/coarse")
    out = tiny.vv("explain", "fall:up").stdout
    for words in (
        "y = v t - g t^2/2",
        "Galileo (1638)",
        "speed = 5 m/s  initial velocity",
        "radius = 0.1 m  radius  (inert: not in the exact answer)",
        "second order in dt: 0.001 at dt = 0.1 s, as dt^1: the tiny project says so",
        "fake/coarse: a formula",
        "dt 0.025: fail: y: error 0.01, allowed 0.00025",
        "fake/weightless: does not support: gravity, spheres\n  missing",  # and no result
        "missing/default: not installed: apt-get install missing",
    ):
        assert words in out


def test_export_writes_the_native_input(tiny: Tiny) -> None:
    words = ("export", "fall:up", "--code", "fake", "--rung", "dt=0.5", "--output", "in.txt")
    done = tiny.vv(*words)
    assert (done.returncode, done.stderr) == (0, "written: fall:up fake/good dt=0.5 in in.txt\n")
    assert (tiny.root / "in.txt").read_text() == "fall 0.5\n"


def test_export_takes_the_finest_setting_of_the_first_scheme(tiny: Tiny) -> None:
    done = tiny.vv("export", "fall:up", "--code", "fake")
    assert (done.returncode, done.stderr) == (0, "written: fall:up fake/good dt=0.025\n")


@pytest.mark.parametrize("command", [name for group in GROUPS.values() for name in group])
def test_every_command_has_help(command: str) -> None:
    done = CliRunner().invoke(app, [command, "--help"])
    assert (done.exit_code, done.stderr) == (0, "")
    assert done.stdout.strip()


def test_help_is_grouped_and_shows_the_exit_bits(tiny: Tiny) -> None:
    out = tiny.vv("--help").stdout
    rows = [row for group, names in GROUPS.items() for row in (f"─ {group} ─", *names)]
    places = [out.index(row if row[0] == "─" else f"│ {row} ") for row in rows]
    assert places == sorted(places)
    assert "16 timeout" in out


def test_a_result_goes_where_the_user_says_and_nowhere_else(tiny: Tiny) -> None:
    words = ("run", "fall:up", "--codes", "fake/good", "--level", "quick", "--json")
    (tiny.root / "real.json").write_text("")
    (tiny.root / "link.json").symlink_to("real.json")
    assert tiny.vv(*words, "link.json").returncode == 0
    assert (tiny.root / "link.json").is_symlink()
    assert (tiny.root / "real.json").read_text().startswith('{"records"')
    assert tiny.vv(*words, "/dev/stdout").stdout.startswith('{"records"')
    assert tiny.vv(*words, "-").stdout.startswith('{"records"')
    for bad in (".", "no/such/folder.json"):
        done = tiny.vv(*words, bad)
        assert done.returncode == 64
        assert done.stderr.splitlines()[-1].startswith("vv: ")  # and not the end of a traceback
    assert not (tiny.root / "no").exists()


def test_a_result_folder_that_cannot_be_used_is_named(tiny: Tiny) -> None:
    done = tiny.vv("run", "fall:up", "--codes", "fake/good", VV_DATA="/dev/null")
    assert (done.returncode, done.stderr) == (
        64,
        "vv: cannot use /dev/null/scratch (from VV_DATA): Not a directory\n",
    )


def test_what_fails_is_named_with_its_error_and_its_tolerance(tiny: Tiny) -> None:
    done = tiny.vv("run", "fall:up", "--codes", "fake/first-order", "--level", "quick")
    assert "red: fall:up fake/first-order dt=0.1 y: error 0.01, tolerance 0.001" in done.stdout
    again = "again: vv run fall:up --codes fake/first-order --rung dt=0.1"
    assert f"  {again}" in done.stdout.splitlines()
    assert tiny.vv(*again.split()[2:]).returncode == Bit.ACCURACY


def test_what_is_refused_is_not_exported(tiny: Tiny) -> None:
    done = tiny.vv("export", "fall:up", "--code", "fake/refuses")
    assert (done.returncode, done.stdout) == (64, "")
    assert done.stderr == "vv: fake/refuses refuses fall:up: it does not feel like it\n"


@pytest.mark.parametrize("words", ["fall:up --codes fake", "fall --codes fake/good"])
def test_only_whole_cases_of_whole_codes_are_recorded(tiny: Tiny, words: str) -> None:
    """A file holds one set of circumstances: what a part of it replaced would be lost."""
    done = tiny.vv("record", *words.split())
    assert done.returncode == 64
    assert "record takes whole cases and whole codes, not '" in done.stderr


def test_record_of_nothing_named_is_refused(tiny: Tiny) -> None:
    done = tiny.vv("record")
    assert (done.returncode, done.stdout) == (64, "")
    assert done.stderr == "vv: name the cases or --codes to record\n"


@pytest.mark.parametrize(
    ("file", "old", "new", "told"),
    [
        ("cases/fall.py", 'p["radius"]]', 'p["radios"]]', "KeyError: 'radios'"),
        ("cases/fall.py", "turns = Count(", "turns = Cuont(", "NameError: name 'Cuont'"),
        (
            "adapters/fake.py",
            '    return "it does not',
            '    return 1 / 0 or "',
            "ZeroDivisionError",
        ),
        ("adapters/fake.py", "Found(True,", "Fonud(True,", "NameError: name 'Fonud'"),
    ],
)
def test_an_error_in_a_project_s_own_files_is_told_with_the_calls_in_these(
    tiny: Tiny, file: str, old: str, new: str, told: str
) -> None:
    tiny.edit(file, old, new)
    done = tiny.vv("run", "fall:up", "--codes", "fake/good,fake/refuses")
    assert done.returncode == 64
    assert f"vv: {told}" in done.stderr
    frames = re.findall(r'File "(.*?)", line', done.stderr)
    assert frames[-1] == str(tiny.root / file)
    assert all(name.startswith(str(tiny.root)) for name in frames)


def test_a_run_that_cannot_be_measured_has_failed_and_the_others_go_on(tiny: Tiny) -> None:
    """What never moves has no end to divide by."""
    measured = "observe=lambda run: run.values[BALL][-1, 1]"
    tiny.edit("cases/fall.py", measured, "observe=lambda run: 1 / float(run.values[BALL][-1, 1])")
    done = tiny.vv("run", "fall:up", "--codes", "fake/good,fake/zeros")
    assert done.returncode == Bit.CRASH
    assert "\nsettings: 3 pass, 3 error; run: " in done.stdout
    assert "ZeroDivisionError: float division by zero (fall.py:" in done.stderr


def test_a_fault_of_our_own_is_a_crash_with_its_traceback(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fault(**_: object) -> None:
        raise RuntimeError("ours")

    monkeypatch.setattr(cli, "app", fault)
    with pytest.raises(SystemExit) as stop:
        cli.main()
    assert stop.value.code == Bit.CRASH
    assert "Traceback" in capsys.readouterr().err
