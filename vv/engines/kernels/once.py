"""Lets one process compile a kernel while others that need the same wait, and then load it."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
from collections.abc import Callable, Iterator
from pathlib import Path


def once(compile_it: Callable[[object], object], place: Path) -> Callable[[object], object]:
    """How a kernel is compiled for a signature, or loaded where another process has done so.

    place: where locks are kept, beside the cache; their names begin with its name.
    """

    def compile_or_wait(signature: object) -> object:
        name = hashlib.sha256(str(signature).encode()).hexdigest()[:16]
        with lock(place.with_name(f"{place.name}-{name}.lock")):
            return compile_it(signature)

    return compile_or_wait


@contextlib.contextmanager
def lock(path: Path) -> Iterator[None]:
    """Hold a lock among processes, which its holder's end frees; none where none can be had."""
    with contextlib.ExitStack() as held:
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            fcntl.flock(held.enter_context(path.open("w")), fcntl.LOCK_EX)
        yield
