"""Writes a text as a unified diff from one that the page already shows."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Sequence

WORTH = 0.85  # of the length of a text: a difference that is longer saves too little


def difference(base: str, text: str) -> str:
    """The hunks that make `text` of `base`, without lines in common; empty if that is not shorter.

    The format is that of `diff -U0`, so that `patch` understands it. Both texts end a line.
    """
    if not base.endswith("\n") or not text.endswith("\n"):
        return ""
    hunks = "".join(_hunks(base.splitlines(keepends=True), text.splitlines(keepends=True)))
    return hunks if 0 < len(hunks) < WORTH * len(text) else ""


def nearest(bases: Sequence[str], text: str) -> int:
    """Which of some texts has most lines in common with a text."""
    lines = set(text.splitlines())
    shared = [len(lines.intersection(base.splitlines())) for base in bases]
    return shared.index(max(shared))


def _hunks(old: Sequence[str], new: Sequence[str]) -> Iterator[str]:
    start = next((i for i, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), 0)
    matcher = difflib.SequenceMatcher(None, old[start:], new[start:], autojunk=False)
    for tag, *places in matcher.get_opcodes():
        if tag != "equal":
            i, j, k, m = (start + place for place in places)
            yield f"@@ -{_range(i, j)} +{_range(k, m)} @@\n"
            yield from (f"-{line}" for line in old[i:j])
            yield from (f"+{line}" for line in new[k:m])


def _range(first: int, end: int) -> str:
    """Lines as a hunk's head counts them: of none, the one before."""
    count = end - first
    return f"{first + (count > 0)}{f',{count}' if count != 1 else ''}"
