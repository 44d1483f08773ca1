"""Compiled code is only loaded from a folder to which nobody else could have written it."""

import os
from pathlib import Path

import pytest

from tests.conftest import Tiny
from vv.base import notices
from vv.base.private_folder import cache_root


@pytest.fixture(autouse=True)
def homeless(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "user"))
    monkeypatch.setenv("VV_CACHE", str(tmp_path / "chosen"))
    notices.notice.cache_clear()


def test_a_folder_is_made_for_its_owner_alone(tmp_path: Path) -> None:
    assert cache_root("numba") == tmp_path / "chosen" / "numba"
    assert (tmp_path / "chosen").stat().st_mode & 0o777 == 0o700
    assert (tmp_path / "chosen" / "numba").stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize("mode", [0o770, 0o707])
@pytest.mark.parametrize("place", ["chosen", "chosen/numba"])
def test_what_others_may_write_to_is_not_used_and_a_word_says_so(
    tmp_path: Path, mode: int, place: str, capsys: pytest.CaptureFixture[str]
) -> None:
    cache_root("numba")
    (tmp_path / place).chmod(mode)
    assert cache_root("numba") == tmp_path / "user" / "vv" / "numba"
    said = f"vv: {tmp_path / place} is not used for compiled code: others may write to it\n"
    assert capsys.readouterr().err == said


@pytest.mark.skipif(os.geteuid() != 0, reason="only root gives files away")
def test_what_another_owns_is_not_used(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cache_root("numba")
    os.chown(tmp_path / "chosen", 12345, 12345)
    assert cache_root("numba").is_relative_to(tmp_path / "user")
    assert "another user owns it" in capsys.readouterr().err


def test_a_folder_of_results_is_never_chosen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("VV_CACHE")
    assert cache_root("numba") == tmp_path / "user" / "vv" / "numba"


def test_a_report_leaves_no_code_among_the_results(tiny: Tiny) -> None:
    assert tiny.vv("run", "fall:up", "--codes", "fake/good").returncode == 0
    assert (tiny.root / ".vv" / "report" / "index.html").is_file()
    kinds = {path.suffix for path in (tiny.root / ".vv").rglob("*") if path.is_file()}
    assert kinds == {".json", ".npz", ".html", ".css", ".js", ".csv"}
