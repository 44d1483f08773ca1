"""Ends processes with all their descendants, also those that left their process group.

Without /proc, as on systems other than Linux, only process groups are ended.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
from collections.abc import Iterable, Iterator
from pathlib import Path

PROC = Path("/proc")
SUBREAPER = 36  # Linux: PR_SET_CHILD_SUBREAPER
ROUNDS = 20  # rounds of killing: a killed process may just have started another


def name_of_signal(number: int) -> str:
    """The name of a signal, such as SIGKILL; most real-time signals have only a number."""
    try:
        return signal.Signals(number).name
    except ValueError:
        return str(number)


def adopt_orphans() -> None:
    """Make this process the parent of orphaned descendants; works on Linux only."""
    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(SUBREAPER, 1)


def end_children() -> None:
    """End all processes that this one has started or adopted; almost free if there are none.

    Call it only if the process no longer waits for any child.
    """
    with contextlib.suppress(ChildProcessError):  # there is none
        while True:
            ended, _ = os.waitpid(-1, os.WNOHANG)
            if ended == 0:
                end_descendants(os.getpid())
                os.waitpid(-1, 0)


def end_with_descendants(pid: int) -> None:
    """End a running process and its descendants; it is stopped first, so it starts no more.

    If a signal to this process interrupts this, the process is not left stopped, since it could
    then not be asked to end.
    """
    try:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.kill(pid, signal.SIGSTOP)
            end_descendants(pid)
    finally:
        _kill([pid])


def end_descendants(pid: int) -> None:
    """End all processes that a process started, and those which these started."""
    for _ in range(ROUNDS):
        found = _descendants(pid) if _has_children(pid) else []
        if not found:
            return
        _kill(found)


def end_those_in(folder: Path) -> None:
    """End all processes of this user whose home or working folder lies in a folder."""
    for _ in range(ROUNDS):
        found = [pid for pid in _pids() if _is_in(pid, folder)]
        if not found:
            return
        _kill(found)


def _kill(pids: Iterable[int]) -> None:
    for pid in pids:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.kill(pid, signal.SIGKILL)


def _pids() -> Iterator[int]:
    names = os.listdir(PROC) if PROC.is_dir() else []
    return (int(name) for name in names if name.isdecimal())


def _has_children(pid: int) -> bool:
    """Whether a process has children, zombies included; true where the system does not tell."""
    try:
        tasks = [*(PROC / str(pid) / "task").iterdir()]
        return any((task / "children").read_text() for task in tasks)
    except OSError:
        return True


def _descendants(pid: int) -> list[int]:
    """The processes below a process that still run, outer ones first."""
    children: dict[int, list[int]] = {}
    for one in _pids():
        parent = _parent(one)
        if parent is not None:
            children.setdefault(parent, []).append(one)
    found = list(children.get(pid, ()))
    for one in found:
        found += children.get(one, ())
    return found


def _parent(pid: int) -> int | None:
    """The parent of a process; None if it has ended, or is a zombie that no signal reaches."""
    try:
        text = (PROC / str(pid) / "stat").read_text(errors="replace")
    except OSError:
        return None
    state, parent = text.rpartition(")")[2].split()[:2]
    return None if state in "ZX" else int(parent)


def _is_in(pid: int, folder: Path) -> bool:
    """Whether a process runs whose home or working folder is a folder or lies in it."""
    place = PROC / str(pid)
    try:
        homes = [
            entry.removeprefix(b"HOME=")
            for entry in (place / "environ").read_bytes().split(b"\0")
            if entry.startswith(b"HOME=")
        ]
        here = os.fsencode(os.readlink(place / "cwd"))
    except OSError:  # it has ended, or belongs to another user
        return False
    own = os.fsencode(folder)
    inside = any(one == own or one.startswith(own + b"/") for one in (*homes, here))
    return inside and pid != os.getpid() and _parent(pid) is not None
