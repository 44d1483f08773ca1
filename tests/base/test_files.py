"""Claims about files that are written whole or not at all, and about which files are read."""

from __future__ import annotations

import errno
import os
import stat
import sys
from pathlib import Path

import pytest

from vv.base import files
from vv.base.files import check_output, opened, read_whole, write_output, write_whole


def test_a_file_is_written_with_all_folders_above_it_and_everybody_may_read_it(
    tmp_path: Path,
) -> None:
    place = tmp_path / "a" / "b" / "file"
    before = os.umask(0o077)
    try:
        write_whole(place, b"whole")
    finally:
        os.umask(before)
    assert place.read_bytes() == b"whole"
    assert stat.S_IMODE(place.stat().st_mode) == 0o644


def test_it_comes_under_its_name_from_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file cannot be renamed from another disk, where the folder of temporary files may lie."""
    came_from: list[Path] = []
    rename = os.replace

    def noted(source: str, target: Path) -> None:
        came_from.append(Path(source).parent)
        rename(source, target)

    monkeypatch.setattr(os, "replace", noted)
    write_whole(tmp_path / "file", b"whole")
    assert came_from == [tmp_path]


def test_what_cannot_be_written_names_the_file_and_leaves_nothing(tmp_path: Path) -> None:
    place = tmp_path / "file"
    place.mkdir()
    (place / "inner").touch()
    with pytest.raises(OSError, match="file") as told:
        write_whole(place, b"whole")
    assert told.value.filename == str(place)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_file_of_a_gibibyte_is_opened_and_a_larger_one_is_not(tmp_path: Path) -> None:
    place = tmp_path / "sparse"
    for size, fits in ((1 << 30, True), ((1 << 30) + 1, False)):
        with place.open("wb") as file:
            file.truncate(size)
        if fits:
            opened(place).close()
        else:
            with pytest.raises(OSError, match=f"it has {size} bytes, more than are read"):
                opened(place)


def test_what_is_not_read_is_closed_again(tmp_path: Path) -> None:
    before = os.listdir("/proc/self/fd") if Path("/proc/self/fd").is_dir() else []
    for _ in range(3):
        with pytest.raises(OSError, match="it is not a regular file"):
            read_whole(tmp_path)
    after = os.listdir("/proc/self/fd") if Path("/proc/self/fd").is_dir() else []
    assert len(after) == len(before)


def test_a_regular_file_is_replaced_and_who_reads_the_old_one_reads_on(tmp_path: Path) -> None:
    place, link = tmp_path / "file", tmp_path / "link"
    place.write_bytes(b"old")
    link.symlink_to(place)
    with place.open("rb") as reader:
        write_output(link, b"new and longer")
        assert reader.read() == b"old"
    assert link.is_symlink()
    assert place.read_bytes() == b"new and longer"


def test_output_is_told_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    reading, writing = os.pipe()
    with os.fdopen(reading, "rb") as reader, os.fdopen(writing, "w") as writer:
        monkeypatch.setattr(sys, "stdout", writer)
        os.set_blocking(reading, False)
        write_output(Path("-"), b"told")
        assert reader.read(4) == b"told"


def test_a_mistyped_folder_is_not_made_also_behind_a_link(tmp_path: Path) -> None:
    link = tmp_path / "link"
    link.symlink_to(tmp_path / "nowhere" / "file")
    for place in (tmp_path / "nowhere" / "file", link):
        with pytest.raises(FileNotFoundError) as told:
            write_output(place, b"lost")
        assert told.value.filename == str(tmp_path / "nowhere")
    assert not (tmp_path / "nowhere").exists()


def test_a_folder_is_no_place_for_output_and_is_named(tmp_path: Path) -> None:
    with pytest.raises(IsADirectoryError) as told:
        check_output(tmp_path)
    assert told.value.filename == str(tmp_path)


def test_a_device_must_be_open_to_writing_and_a_file_s_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As for a user who may write to the pipe, and not to the folder in which it lies."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    monkeypatch.setattr(os, "access", lambda place, mode: place == pipe and mode == os.W_OK)
    check_output(pipe)
    with pytest.raises(PermissionError) as told:
        check_output(tmp_path / "new")
    assert told.value.filename == str(tmp_path / "new")
    monkeypatch.setattr(os, "access", lambda place, mode: mode == os.R_OK)
    with pytest.raises(PermissionError):
        check_output(tmp_path / "new")


def test_an_error_without_a_place_gets_one() -> None:
    with pytest.raises(OSError, match="full") as told, files.with_path("here"):
        raise OSError(errno.ENOSPC, "full")
    assert (told.value.errno, told.value.filename) == (errno.ENOSPC, "here")
