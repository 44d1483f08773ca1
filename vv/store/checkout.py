"""Asks git for the commit of a project's checkout, and for the files that changed."""

from __future__ import annotations

import subprocess
from pathlib import Path

from vv.base.errors import UsageError


class GitError(Exception):
    """Git cannot be run, or reports an error."""


def commit(root: Path) -> tuple[str, bool]:
    """The commit of a checkout and whether files differ from it; ('', False) outside one."""
    try:
        revision = _git(root, "rev-parse", "HEAD").strip()
        return revision, bool(_git(root, "status", "--porcelain", "-z"))
    except GitError:
        return "", False


def named(root: Path, revision: str) -> str:
    """The commit of a name that git knows, such as HEAD~1 or a tag; empty if there is none."""
    try:
        return _resolved(root, revision)
    except GitError:
        return ""


def changed_since(root: Path, revision: str) -> frozenset[Path]:
    """The files that differ from a revision, new and deleted ones too.

    Raises UsageError if git does not know the revision or this is no checkout.
    """
    differing = ("diff", "--name-only", "--no-renames", "--relative", "-z")
    new = ("ls-files", "--others", "--exclude-standard", "-z")
    try:
        listed = (_git(root, *differing, _resolved(root, revision), "--") + _git(root, *new)).split(
            "\0"
        )
    except GitError as error:
        raise UsageError(f"--since: {error}") from error
    return frozenset((root / name).resolve() for name in listed if name)


def _resolved(root: Path, revision: str) -> str:
    """The commit that a revision names; the text is never taken for an option of git."""
    if "\0" in revision:
        raise GitError("git says: a revision holds no zero byte")
    words = ("rev-parse", "--verify", "--end-of-options", f"{revision}^{{commit}}")
    return _git(root, *words).strip()


def _git(root: Path, *words: str) -> str:
    """The output of a git command; with -z, git does not quote file names."""
    command = ["git", "-C", str(root), *words]
    try:
        done = subprocess.run(
            command, capture_output=True, check=False, encoding="utf-8", errors="surrogateescape"
        )
    except OSError as error:
        raise GitError(f"git cannot be run: {error}") from error
    if done.returncode:
        raise GitError(f"git says: {done.stderr.strip().partition(chr(10))[0]}")
    return done.stdout
