"""Pipes, devices, folders, links and giants in a store are named, and what they hide made again."""

from __future__ import annotations

import io
import os
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tests.support.acceptances import ran
from tests.support.fabricated import entry, manifest, record
from vv.ask import Cost, Run, Status
from vv.base import files
from vv.records.job_record import RunSummary
from vv.store.provenance import file_digests
from vv.store.run_arrays import arrays_of
from vv.store.seal import sealed_bytes
from vv.store.store import Store, _Kept

KEY = "ab" * 32
SERIES = {"t": np.arange(3.0), "y.value": np.arange(3.0)}
MEASURED = (entry("no-reference", {}),)
Spoil = Callable[[Path], object]


def giant(path: Path) -> None:
    """A file of more than can be read, which takes no room."""
    with path.open("wb") as file:
        file.truncate(files.LARGEST + 1)


SPOILS: dict[str, tuple[Spoil, str]] = {
    "pipe": (os.mkfifo, "it is not a regular file"),
    "device": (lambda path: path.symlink_to("/dev/zero"), "it is not a regular file"),
    "folder": (lambda path: path.mkdir(), "it is not a regular file"),
    "loop": (lambda path: path.symlink_to(path), "Too many levels of symbolic links"),
    "giant": (giant, f"it has {files.LARGEST + 1} bytes, more than are read"),
}
each = pytest.mark.parametrize(("spoil", "said"), SPOILS.values(), ids=list(SPOILS))


def summary() -> RunSummary:
    """What is kept of a run."""
    return RunSummary(**{name: getattr(ran(), name) for name in RunSummary.__dataclass_fields__})


@each
def test_it_is_named_passed_over_and_written_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], spoil: Spoil, said: str
) -> None:
    store = Store(tmp_path)
    store.keep_summary(KEY, summary(), SERIES)
    for suffix in ("json", "npz"):
        path = tmp_path / "records" / KEY[:2] / f"{KEY}.{suffix}"
        path.unlink()
        spoil(path)
    assert (store.summary(KEY), store.series(KEY, MEASURED)) == (None, None)
    told = capsys.readouterr().err
    assert told.count(f"{said}; it is ignored and made again\n") == 2
    store.keep_summary(KEY, summary(), SERIES)
    assert store.summary(KEY) == summary()
    assert store.series(KEY, MEASURED) is not None


@each
def test_a_manifest_that_is_none_is_named(tmp_path: Path, spoil: Spoil, said: str) -> None:
    store, told = Store(tmp_path), list[str]()
    store.manifests.keep(manifest(record("dem/default", "T1", 1e-3), name="01"))
    spoil(tmp_path / "manifests" / "02.json")
    assert [one.name for one in store.manifests.newest(5, told.append)] == ["01"]
    assert [one.startswith("past run 02: ") for one in told] == [True]
    assert said in told[0]


@pytest.mark.parametrize("how", sorted(SPOILS.keys() - {"folder"}))  # which nothing can replace
def test_digests_that_cannot_be_read_are_taken_anew(tmp_path: Path, how: str) -> None:
    program, memory = tmp_path / "program", tmp_path / "digests.json"
    program.write_text("x")
    known = file_digests([program], memory)
    memory.unlink()
    SPOILS[how][0](memory)
    assert file_digests([program], memory) == known


def test_a_link_that_leads_nowhere_among_results_does_no_harm(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.keep_summary(KEY, summary(), {})
    before = store.state()
    (tmp_path / "records" / KEY[:2] / "gone").symlink_to("/nowhere")
    (tmp_path / "records" / "file").write_text("")
    assert store.state() != before
    (tmp_path / "timings" / "aa").mkdir(parents=True)
    (tmp_path / "timings" / "aa" / "old.json").symlink_to("/nowhere")
    assert store.last_session() == "old"


def zipped(content: bytes, method: int = zipfile.ZIP_STORED) -> bytes:
    """A zip file of one array."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", method) as file:
        file.writestr("t.npy", content)
    return buffer.getvalue()


def headed(text: str) -> bytes:
    """An array whose head is this text, and which has no content."""
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text.encode()


PLAIN = b"\x14\x00\x00\x00\x00\x00"  # a version, no flags, and no compression
PACKED = zipped(bytes(range(256)) * 9, zipfile.ZIP_DEFLATED)
HUGE = "{'descr': '<f8', 'fortran_order': %s, 'shape': (999999999999999999,), }\n"
FORGED = {
    "of an unknown compression": zipped(b"abc").replace(PLAIN, PLAIN[:4] + b"\x63\x00"),
    "encrypted": zipped(b"abc").replace(PLAIN, PLAIN[:2] + b"\x01\x00\x00\x00"),
    "of a broken compression": PACKED.replace(b"\x04\x05\x06", b"\xff\xff\xff"),
    "of more than memory": zipped(headed(HUGE % "True")),
    "of less than it says": zipped(headed(HUGE % "False")),
    "with code for a head": zipped(headed("__import__('os').abort()\n")),
    "of a head without end": zipped(headed("(" * 9000)),
    "no zip file": b"PK\x03\x04" * 40,
}  # fmt: skip


@pytest.mark.parametrize("content", FORGED.values(), ids=list(FORGED))
def test_what_is_sealed_and_no_arrays_is_named_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], content: bytes
) -> None:
    path = tmp_path / "runs" / KEY[:2] / f"{KEY}.npz"
    path.parent.mkdir(parents=True)
    path.write_bytes(sealed_bytes(f"runs/{KEY}", content))
    assert Store(tmp_path).run(KEY) is None
    assert "; it is ignored and made again\n" in capsys.readouterr().err


def test_what_unpacks_to_more_than_fits_is_not_unpacked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("vv.store.array_files.LARGEST", 1 << 16)
    path = tmp_path / "runs" / KEY[:2] / f"{KEY}.npz"
    path.parent.mkdir(parents=True)
    bomb = zipped(bytes(1 << 17), zipfile.ZIP_DEFLATED)
    path.write_bytes(sealed_bytes(f"runs/{KEY}", bomb))
    assert Store(tmp_path).run(KEY) is None
    assert "its unpacked size exceeds the limit" in capsys.readouterr().err


def test_what_is_of_another_key_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store, other = Store(tmp_path), KEY[::-1]
    store._write("records", KEY, _Kept(summary(), other))
    run = Run(Status.RAN, times=np.arange(3.0), cost=Cost(), steps=2)
    store._keep_arrays("runs", KEY, arrays_of(run, other))
    assert (store.summary(KEY), store.run(KEY)) == (None, None)
    said = f"it is of the key {other}; it is ignored and made again"
    assert capsys.readouterr().err.count(said) == 2
