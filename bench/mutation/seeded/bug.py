"""Defines a seeded bug."""

from typing import NamedTuple


class Bug(NamedTuple):
    """A bug: a description, the file, the texts before and after, and what should detect it.

    code, cases: for a bug in a solver or an adapter, the code whose gate must detect it, and the
    cases that are run first. tests: files or folders of tests, separated by spaces, which are run
    if no gate can detect the bug, or none does.
    """

    what: str
    file: str
    old: str
    new: str
    code: str = ""
    cases: str = ""
    tests: str = ""
