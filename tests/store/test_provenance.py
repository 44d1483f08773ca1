"""Claims about the circumstances of a result that are kept with it."""

from __future__ import annotations

import platform
from pathlib import Path

import pytest

from vv.store import provenance

LISTED = "processor : 0\nmodel name : Swift 9\nmodel name : Slow 1\n"


@pytest.mark.parametrize(
    ("listed", "told", "name"),
    [
        (LISTED, "x", "Swift 9"),
        ("processor : 0\n", "x", "arm64"),  # as on ARM, where the list has no names
        (None, "Swift 9", "Swift 9"),  # None: there is no list
        (None, "", "arm64"),
    ],
)
def test_a_processor_has_the_name_in_the_list_of_the_system_else_the_best_known(
    listed: str | None, told: str, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def read(path: Path) -> str:
        if listed is None:
            raise FileNotFoundError(path)
        return listed

    monkeypatch.setattr(Path, "read_text", read)
    monkeypatch.setattr(platform, "processor", lambda: told)
    monkeypatch.setattr(platform, "machine", lambda: "arm64")
    assert provenance._processor() == name
