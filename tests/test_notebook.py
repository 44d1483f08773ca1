"""Claims about `verify` in one Python process: it judges by the files as they are, or says so."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

import numpy as np
import pytest

from tests.conftest import Tiny
from vv import notebook
from vv.ask import Knobs
from vv.base.errors import UsageError
from vv.notebook import verify

CALLS = """
from pathlib import Path
from vv.base.errors import UsageError
from vv.notebook import verify

def judged():
    try:
        print(*verify("fall:up", codes="fake/good").verdict.unique())
    except UsageError as error:
        print(error)

judged()
path = Path({file!r})
kept = path.read_text()
path.write_text(kept.replace({old!r}, {new!r}))
judged()
path.write_text(kept)
judged()
"""


def said(tiny: Tiny, file: str, old: str, new: str) -> list[str]:
    """What three calls of `verify` say: before an edit, after it, and after it was undone."""
    assert old in (tiny.root / file).read_text()
    script = CALLS.format(file=file, old=old, new=new)
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=tiny.root, capture_output=True, text=True, check=True
    )
    return done.stdout.splitlines()


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("reference_solutions/fall.py", "- g", "+ g"),
        ("cases/fall.py", "CASE", "# edited\nCASE"),
        ("adapters/fake.py", "ADAPTER", "# edited\nADAPTER"),
    ],
)
def test_a_file_edited_since_it_was_loaded_is_named_and_nothing_is_judged_by_the_old_one(
    file: str, old: str, new: str, tiny: Tiny
) -> None:
    first, edited, undone = said(tiny, file, old, new)
    assert first == undone == "pass shown only"
    assert edited.startswith("files have changed since they were loaded: restart Python (")
    assert edited.endswith(f"{file})")


def test_a_past_run_from_python_shows_the_command_that_does_the_same(tiny: Tiny) -> None:
    asked = 'verify("fall:up", codes="fake/good", settings={"g": "9 m/s2"}, rungs=[1e-2, 5e-3])'
    script = f"from vv.notebook import verify; {asked}; verify(codes='fake/good', level='quick')"
    subprocess.run([sys.executable, "-c", script], cwd=tiny.root, check=True)
    past = tiny.vv("runs").stdout.splitlines()
    every, one = (line.partition("vv run ")[2] for line in past)
    assert every == "--all --codes fake/good --level quick"
    assert one == (
        "fall:up --codes fake/good --level default --set 'g=9 m/s2' --rung dt=0.01 --rung dt=0.005"
    )


@pytest.mark.parametrize(
    "given",
    ["dt=1e-3,kn=1e9", {"dt": 1e-3, "kn": 1e9}, Knobs(1e-3, 1e9), [{"dt": "0.001", "kn": 1e9}]],
)
def test_a_setting_is_a_text_a_mapping_or_knobs_alone_or_among_others(given: Any) -> None:
    assert notebook._rungs(given) == (Knobs(1e-3, 1e9),)
    assert notebook._rungs([1e-3, np.float64(5e-4)]) == (Knobs(1e-3), Knobs(5e-4))
    assert notebook._rungs(1e-3) == (Knobs(1e-3),)


def test_changed_parameters_are_texts_or_a_mapping() -> None:
    assert notebook._settings({"kn": 1e9, "m": "2 g"}) == ("kn=1000000000.0", "m=2 g")
    assert notebook._settings("kn=1e9") == notebook._settings(["kn=1e9"]) == ("kn=1e9",)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"level": "x"}, "level = 'x'; it must be one of quick, default, paper"),
        ({"rungs": [None]}, "rung = None; expected dt=..[,kn=..], a mapping"),
        ({"rungs": [-1e-3]}, "dt = '-0.001'|dt = -0.001 s; a knob must be positive"),
        ({"rungs": {"dx": 1.0}}, "expected dt=SECONDS"),
        ({"settings": [1e9]}, "settings = [1000000000.0]; expected texts NAME=VALUE[UNIT]"),
        ({"settings": 1e9}, "settings = 1000000000.0; expected texts"),
    ],
)
def test_what_cannot_be_read_is_a_usage_error(given: dict[str, Any], said: str) -> None:
    with pytest.raises(UsageError) as refused:
        verify("single-contact:T1", codes="exact", **given)
    assert any(part in str(refused.value) for part in said.split("|"))


def test_what_a_failed_call_has_loaded_counts_too(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", "CASE = ", "CASE = 1 / 0\nOTHER = ")
    first, edited, _ = said(tiny, "reference_solutions/fall.py", "- g", "+ g")
    assert "ZeroDivisionError" in first
    assert edited.endswith("reference_solutions/fall.py)")
