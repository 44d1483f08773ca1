"""Claims about `verify` in one Python process: it judges by the files as they are, or says so."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.conftest import Tiny

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
    assert first == undone == "pass no-reference"
    assert edited.startswith("files have changed since they were loaded: restart Python (")
    assert edited.endswith(f"{file})")


def test_what_a_failed_call_has_loaded_counts_too(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", "CASE = ", "CASE = 1 / 0\nOTHER = ")
    first, edited, _ = said(tiny, "reference_solutions/fall.py", "- g", "+ g")
    assert "ZeroDivisionError" in first
    assert edited.endswith("reference_solutions/fall.py)")
