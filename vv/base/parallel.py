"""Calls a function for each of many items, in several processes if that takes long."""

from __future__ import annotations

import contextlib
import multiprocessing
import signal
import time
from collections.abc import Callable, Mapping, Sequence
from multiprocessing.connection import Connection
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")
ALONE = 0.3  # CPU s after which the rest is distributed, which takes a tenth of that


def parallel_map(work: Callable[[T], R], items: Sequence[T], processes: int) -> list[R]:
    """The results of work(item) for each item, in order; they must be picklable."""
    found: dict[int, R] = {}
    begun = time.process_time()
    for place, item in enumerate(items):
        if processes > 1 and time.process_time() - begun > ALONE:
            rest = {later: items[later] for later in range(place, len(items))}
            found.update(_shared(work, rest, processes))
            break
        found[place] = work(item)
    return [found[place] for place in range(len(items))]


def _shared(work: Callable[[T], R], items: Mapping[int, T], processes: int) -> dict[int, R]:
    """The results from this process and forked ones, among which the items are distributed.

    Items that a lost process did not finish, or for which it raised an error, are done here at the
    end.
    """
    context = multiprocessing.get_context("fork")
    own, *others = ([*items][first::processes] for first in range(processes))
    helpers = []
    for share in others:
        receiver, sender = context.Pipe(duplex=False)
        given = work, {place: items[place] for place in share}, sender
        helper = context.Process(target=_help, args=given, daemon=True)
        helper.start()
        sender.close()
        helpers.append((receiver, helper))
    found = {place: work(items[place]) for place in own}
    for receiver, helper in helpers:
        with contextlib.suppress(EOFError, OSError), receiver:
            found.update(receiver.recv())
        helper.join()
    left = items.keys() - found.keys()
    return found | {place: work(items[place]) for place in sorted(left)}


def _help(work: Callable[[T], R], items: Mapping[int, T], sender: Connection) -> None:
    """Send the results of a forked process, up to the first error."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends it
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    found = {}
    with sender:
        with contextlib.suppress(Exception):
            for place, item in items.items():
                found[place] = work(item)
        sender.send(found)
