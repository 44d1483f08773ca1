"""Lets one process compile a kernel while others that need it wait, and then load it."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
from collections.abc import Callable, Iterator
from pathlib import Path


def once(compile_it: Callable[[object], object], place: Path) -> Callable[[object], object]:
    """A function that compiles a kernel for a signature, or loads it if another process did so.

    place: a path beside the cache, with whose name those of the lock files begin.
    """

    def compile_or_wait(signature: object) -> object:
        name = hashlib.sha256(str(signature).encode()).hexdigest()[:16]
        with lock(place.with_name(f"{place.name}-{name}.lock")):
            return compile_it(signature)

    return compile_or_wait


@contextlib.contextmanager
def lock(path: Path) -> Iterator[None]:
    """Hold a lock between processes, which ends with its holder; none if locks are not possible."""
    with contextlib.ExitStack() as held:
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            fcntl.flock(held.enter_context(path.open("w")), fcntl.LOCK_EX)
        yield
