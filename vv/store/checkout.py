"""What git says of the checkout that a project lies in: its commit, and what differs from one."""

from __future__ import annotations

import subprocess
from pathlib import Path

from vv.base.errors import UsageError


class GitError(Exception):
    """Git cannot be run, or objects to what it is asked."""


def commit(root: Path) -> tuple[str, bool]:
    """The commit of a checkout and whether files differ from it; ('', False) outside one."""
    try:
        return _git(root, "rev-parse", "HEAD")[0], bool(_git(root, "status", "--porcelain"))
    except GitError:
        return "", False


def named(root: Path, revision: str) -> str:
    """The commit that git knows by a name such as HEAD~1 or a tag; empty if there is none."""
    try:
        return _git(root, "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}")[0]
    except GitError:
        return ""


def changed_since(root: Path, revision: str) -> frozenset[Path]:
    """The files that differ from a revision, new and deleted ones too.

    Raises UsageError if git does not know the revision or this is no checkout.
    """
    words = ("diff", "--name-only", "--no-renames", "--relative", revision, "--")
    try:
        listed = [*_git(root, *words), *_git(root, "ls-files", "--others", "--exclude-standard")]
    except GitError as error:
        raise UsageError(f"--since: {error}") from error
    return frozenset((root / name).resolve() for name in listed)


def _git(root: Path, *words: str) -> list[str]:
    """The lines that git prints."""
    try:
        done = subprocess.run(
            ["git", "-C", str(root), *words], capture_output=True, text=True, check=False
        )
    except OSError as error:
        raise GitError(f"git cannot be run: {error}") from error
    if done.returncode:
        raise GitError(f"git says: {done.stderr.strip().partition(chr(10))[0]}")
    return done.stdout.splitlines()
