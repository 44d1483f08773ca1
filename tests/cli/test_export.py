"""Claims about `vv export`: one setting of one scheme, as it was asked for, and where it went."""

from __future__ import annotations

import json

from tests.conftest import Tiny
from vv.records.finding import Bit


def test_a_question_to_a_scheme_names_the_scheme_and_its_own_knobs(tiny: Tiny) -> None:
    words = ("--code", "fake/coarse", "--format", "json", "--set", "g=2", "--output", "ask.json")
    done = tiny.vv("export", "fall:up", *words)
    told = json.loads((tiny.root / "ask.json").read_text())
    assert (told["scheme"], told["knobs"]) == ("coarse", {"dt": 0.025})
    assert told["scene"]["gravity"] == [0.0, -2.0, 0.0]
    assert (done.stdout, done.stderr) == ("", "written: fall:up fake/coarse dt=0.025 in ask.json\n")


def test_a_question_to_nobody_goes_where_it_is_to_go(tiny: Tiny) -> None:
    done = tiny.vv("export", "fall:up", "--format", "json", "--output", "ask.json")
    assert (done.stdout, done.stderr) == ("", "written: fall:up in ask.json\n")
    assert json.loads((tiny.root / "ask.json").read_text())["scheme"] == "default"


def test_one_setting_is_exported_and_not_two(tiny: Tiny) -> None:
    done = tiny.vv("export", "fall:up", "--code", "fake", "--rung", "dt=0.1", "--rung", "dt=0.2")
    assert (done.returncode, done.stdout) == (Bit.USAGE, "")
    assert "export takes one --rung, not 2" in done.stderr
