"""Reads and writes the manifests of past invocations, whole or in parts.

Reading a damaged one raises OSError; where several are read it is skipped with a notice.
"""

from __future__ import annotations

import errno
import functools
import hashlib
import io
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO, TypeVar

from vv.base.files import opened, write_whole
from vv.base.notices import notice
from vv.records.job_record import Record
from vv.records.manifest import Manifest, Provenance
from vv.store import manifest_text

Found = TypeVar("Found")
DAY = 86400.0  # s, the largest difference between the clocks of machines


@dataclass(frozen=True)
class Manifests:
    """The folder of manifests. Their names sort by time."""

    folder: Path

    def keep(self, what: Manifest) -> None:
        """Store the manifest of an invocation under its name."""
        write_whole(self.file(what.name), manifest_text.render(what).encode())

    def keep_renamed(self, old: str, name: str, provenance: Provenance) -> None:
        """Store a past invocation again under a new name and provenance; raises OSError."""
        text = self._of(old, lambda file: manifest_text.renamed(file.read(), old, name, provenance))
        write_whole(self.file(name), text.encode())

    def names(self) -> list[str]:
        """The names of past invocations, oldest first.

        A run dated in the future is skipped, since it would stay the latest until then.
        """
        names = sorted(path.stem for path in self.folder.glob("*.json"))
        tomorrow = time.strftime("%Y%m%dT%H%M%S", time.gmtime(time.time() + DAY))
        for name in names:
            if name > tomorrow:
                notice(f"past run {name}: it is dated in the future; skipped")
        return [name for name in names if name <= tomorrow]

    def read(self, name: str) -> Manifest:
        """A past invocation; raises FileNotFoundError with the name, OSError if it is damaged."""
        return self._of(name, lambda file: manifest_text.whole(file.read(), name))

    def file(self, name: str) -> Path:
        """Where a past invocation is stored."""
        return self.folder / f"{name}.json"

    def latest(self) -> Manifest | None:
        """The newest readable past invocation, or None; damaged ones are reported."""
        for name in reversed(self.names()):
            if found := self.newest_of([name], notice):
                return found[0]
        return None

    def newest(self, most: int, passed_over: Callable[[str], None]) -> list[Manifest]:
        """The newest past invocations, newest first; `passed_over` is called for damaged ones."""
        return self.newest_of(self.names()[-most:], passed_over)

    def newest_of(self, names: Sequence[str], passed_over: Callable[[str], None]) -> list[Manifest]:
        """The readable past invocations among these, newest first; names: oldest first."""
        found = []
        for name in reversed(names):
            try:
                found.append(self.read(name))
            except OSError as error:
                passed_over(f"past run {name}: {error.strerror}; skipped")
        return found

    def head(self, name: str) -> tuple[tuple[str, ...], Provenance]:
        """The cases a past invocation holds, and its provenance; raises as `read`."""
        return self._of(name, lambda file: manifest_text.head(file, name))

    def records_of(self, name: str, case: str) -> tuple[Record, ...]:
        """The records of one case in a past invocation; raises as `read`."""
        return self.reader(name)(case)

    def digests_of(self, name: str) -> dict[str, str]:
        """Case -> digest of its records in a past invocation; empty if it cannot be read.

        For callers that have read the whole manifest and know that it is undamaged.
        """
        path = self.file(name)
        try:
            return dict(_digests_in(path, path.stat().st_mtime_ns))
        except OSError:
            return {}

    def reader(self, name: str) -> Callable[[str], tuple[Record, ...]]:
        """A function that reads the records of a case in a past invocation; raises as `read`."""
        lines = self._of(name, list)
        path = self.file(name)
        return lambda case: _undamaged(path, lambda: manifest_text.records(iter(lines), case, name))

    def _of(self, name: str, read: Callable[[TextIO], Found]) -> Found:
        path = self.file(name)
        if not path.exists() and not path.is_symlink():
            raise FileNotFoundError(f"no run '{name}' in {path.parent}")
        with io.TextIOWrapper(opened(path), encoding="utf-8") as file:
            return _undamaged(path, lambda: read(file))


@functools.lru_cache(maxsize=4)
def _digests_in(path: Path, changed: int) -> dict[str, str]:
    """Case -> digest of its records. changed: change time of the file; a key of the cache."""
    with io.TextIOWrapper(opened(path), encoding="utf-8") as file:
        lines = _undamaged(path, lambda: manifest_text.lines_of(file))
    return {case: hashlib.sha256(line.encode()).hexdigest() for case, line in lines.items()}


def _undamaged(path: Path, read: Callable[[], Found]) -> Found:
    """The result of `read`; raises OSError if the manifest is damaged."""
    try:
        return read()
    except (ValueError, TypeError) as error:
        raise OSError(errno.EIO, f"not a complete manifest: {error}", str(path)) from error
