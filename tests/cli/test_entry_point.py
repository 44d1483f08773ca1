"""Claims about how the process of `vv` ends."""

from __future__ import annotations

import gc

import pytest

from vv import __main__, cli


def test_what_was_read_is_not_searched_as_the_process_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "main", lambda: pytest.exit("as typer does"))
    threshold = gc.get_threshold()
    try:
        with pytest.raises(pytest.exit.Exception):
            __main__.main()
        assert gc.get_freeze_count() > 0
    finally:
        gc.unfreeze()
        gc.set_threshold(*threshold)
