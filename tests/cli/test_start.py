"""Claims about `vv init` and `vv new`: what they write runs as it stands."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.conftest import Tiny


def test_an_empty_folder_becomes_a_project_with_a_code_and_a_case_that_run(tmp_path: Path) -> None:
    own = Tiny(tmp_path)
    assert "written: vv.toml" in own.vv("init").stdout
    said = own.vv("new", "code", "my-dem", "--language", "sh").stdout
    assert said.splitlines()[:3] == [
        "written: my_dem.sh",
        "written: my_dem.toml",
        "then: vv check my_dem.toml",
    ]
    assert own.vv("check", "my_dem.toml").returncode == 0
    assert "then: vv gate fresh" in own.vv("new", "case", "fresh").stdout
    for name in ("my_dem.toml", "my_dem.sh"):
        shutil.move(tmp_path / name, tmp_path / "adapters")
    done = own.vv("gate", "fresh", "--codes", "my-dem,exact")
    assert done.returncode == 0, done.stderr
    assert "1 pass, 2 shown only" in done.stdout


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("new code My", "'My': a name must be lower-case letters"),
        ("new case Drop-2", "'Drop-2': a name must be lower-case letters, digits, - and _"),
        ("new code ../x", "'../x': a name must be lower-case letters"),
        ("new code --language cobol", "'cobol' is not one of"),
        ("new thing", "'thing' is not one of"),
        ("init", "vv.toml already exists"),
        ("check nobody", "no code 'nobody'; name a TOML file"),
        ("check nobody.toml", "there is no file nobody.toml"),
    ],
)
def test_what_cannot_be_started_is_refused_in_a_line(tiny: Tiny, words: str, message: str) -> None:
    done = tiny.vv(*words.split())
    assert done.returncode == 64
    assert message in done.stderr
    assert done.stderr.count("\n") == 1
